// Effects by name, variants by defines: parses once, compiles per variant, caches SPIR-V on disk by content.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/Document.h"
#include "core/Files.h"
#include "core/Log.h"
#include "core/RenderState.h"
#include "effect/Defines.h"
#include "effect/EffectAsset.h"
#include "effect/ShaderInfo.h"

namespace crevice {

/// One compiled pass of an effect with one set of macros. Immutable, lives as long as the library.
struct EffectVariant {
    std::string name;  ///< "ssao|fullscreen-vs|ssao-fs"
    std::string effect;
    const EffectPass* pass = nullptr;                      ///< State, properties, phase.
    std::vector<std::uint32_t> vertex, fragment, compute;  ///< SPIR-V; empty where absent.
    ShaderInfo info;
    std::uint64_t id = 0;  ///< Unique in the library.
};

/// What to compile: effect by name or path, technique and pass by index.
struct VariantRequest {
    std::string effect;
    std::size_t technique = 0;
    std::size_t pass = 0;
    Defines defines;
    SourceLoc where;             ///< Who asked, for "no effect named" errors.
    Defines constants{};         ///< Front ends: macros of the pipeline that an effect need not know.
    bool rebindLiterals = true;  ///< Front ends: names decide over numbers of sets 0 and 2 that the author wrote out.
    /// Nothing will be drawn with it: its SPIR-V is validated, and resources that Crevice does not bind are no error.
    /// What a front end rewrites for drawing (subpass inputs) stays as it is.
    bool checkOnly = false;
};

class EffectFrontEnd;
class ShaderCompiler;

class EffectLibrary {
public:
    struct Options {
        bool useDiskCache = true;
        std::shared_ptr<ShaderCompiler> compiler{};  ///< Of several libraries, which read GLSL's own names once.
    };
    EffectLibrary(AssetRoots roots, const Log& log, Options options);
    EffectLibrary(AssetRoots roots, const Log& log);
    ~EffectLibrary();

    /// Effects are looked up there from now on, before all that is known so far (see EffectFrontEnd.h).
    void addFrontEnd(std::unique_ptr<EffectFrontEnd> frontEnd);
    /// Full names of all effects: the front ends' and our own, sorted.
    std::vector<std::string> names() const;

    /// The parsed effect. Throws Error: no such effect (with near names), header and GLSL structure errors.
    const EffectAsset& asset(const std::string& effect, const SourceLoc& where = {});
    /// Compiles or fetches. Throws Error with the author's file:line for GLSL errors, unknown programs, clashing
    /// numbers, unknown defines.
    const EffectVariant& get(const VariantRequest& request, const BindingMap& bindings);
    /// A generated chunk that `#include <name>` finds before files (the kernel bake). Variants made before keep their
    /// code.
    void setChunk(const std::string& name, std::string text);

    /// The macros a pass understands, in order of first appearance (vertex, then fragment). Throws as asset() does.
    std::vector<DefineInfo> discoverDefines(const std::string& effect, std::size_t technique = 0, std::size_t pass = 0);
    /// The text handed to glslang for a stage, for `effects compile --text`; empty when the pass lacks the stage.
    std::string text(const VariantRequest& request, ShaderStageBits stage);
    const AssetRoots& roots() const;
    /// Names are looked up here from now on (another document, another folder). Variants made before stay valid.
    void setRoots(AssetRoots roots);

    struct Counters {
        std::size_t compiled = 0, fromDisk = 0, fromMemory = 0;
    };
    const Counters& counters() const;
    /// Gives the memory of all variants back; what get() returned is gone. Disk and parsed effects stay.
    void dropVariants();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace crevice
