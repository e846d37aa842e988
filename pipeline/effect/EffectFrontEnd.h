// Reads effects of another dialect: from its files to the one effect model and to texts that the compiler takes as they
// are.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "effect/EffectLibrary.h"
#include "effect/ShaderCompiler.h"

namespace crevice {

/// An EffectLibrary asks its front ends for a name before it looks among its own effects; everything behind the texts
/// (compiling, reflection, caches, materials) is shared. Mistakes of the author are collected in `problems`; what a
/// function returns beside an error is not used.
class EffectFrontEnd {
public:
    EffectFrontEnd() = default;
    virtual ~EffectFrontEnd() = default;
    EffectFrontEnd(const EffectFrontEnd&) = delete;
    EffectFrontEnd& operator=(const EffectFrontEnd&) = delete;

    /// The file behind an effect's full name or path, or nothing when this front end does not read it.
    virtual std::optional<std::filesystem::path> find(const std::string& effect) const = 0;
    /// As find(), for shortened names. Asked only for a name that nobody has in full, Crevice's own effects included.
    virtual std::optional<std::filesystem::path> findShort(const std::string& effect) const {
        (void)effect;
        return std::nullopt;
    }
    /// Full names of all effects it finds, sorted.
    virtual std::vector<std::string> names() const = 0;

    virtual EffectAsset parse(const std::filesystem::path& path, const std::string& name, Problems& problems) = 0;
    /// The macros of a pass that a request may set, in order of first appearance (vertex, then fragment).
    virtual std::vector<DefineInfo> defines(const EffectAsset& effect, const EffectPass& pass, Problems& problems) = 0;
    /// Changes whenever stages() may answer otherwise to the same request: a hash over all that it reads. Empty:
    /// unknown, and nothing is cached by request.
    virtual std::string fingerprint() { return {}; }
    /// The final texts of a pass: head, then GLSL 4.50 in which every location, set and binding is written out
    /// (`StageSource::numbered`). Names in `bindings` get those numbers; others go to set 1.
    virtual std::vector<StageSource> stages(const EffectAsset& effect, const EffectPass& pass,
                                            const VariantRequest& request, const BindingMap& bindings,
                                            Problems& problems) = 0;
};

}  // namespace crevice
