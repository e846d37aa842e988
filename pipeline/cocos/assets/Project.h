// A project and the engine it was made with, as one place to look assets up in.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "cocos/assets/Mtl.h"
#include "cocos/files/MetaIndex.h"
#include "cocos/files/Roots.h"
#include "effect/EffectAsset.h"

namespace crevice::cocos {

/// The folder that holds `assets/` and `package.json`, at or above a file; nothing when there is none.
std::optional<std::filesystem::path> findProjectFolder(const std::filesystem::path& file);

/// Parses an effect for its passes, properties and embedded macros. Throws Error or collects.
using EffectReader =
    std::function<EffectAsset(const std::filesystem::path& path, const std::string& name, Problems& problems)>;

class Project {
public:
    /// Reads all metas; what is wrong with them goes to `problems` as warnings.
    Project(Roots roots, EffectReader effects, Problems& problems);

    const Roots& roots() const { return roots_; }
    const MetaIndex& metas() const { return metas_; }

    /// The asset that a reference names, with an error at its place when there is none. `what` names the reference:
    /// "the effect of material 'x'".
    const MetaAsset* find(const AssetRef& ref, const std::string& what, Problems& problems) const;

    /// A material; null after errors. Read once.
    const Mtl* material(const AssetRef& ref, const std::string& what, Problems& problems);
    /// The .effect file of a material; null after errors: it names none, or something else.
    const MetaAsset* effectFile(const Mtl& mtl, Problems& problems) const;
    /// An effect by the name that effectName() gives, or by reference; null after errors. Read once.
    const EffectAsset* effect(const std::filesystem::path& path, Problems& problems);

    /// What pipelines and materials call an effect: its path below `effects/` or an assets folder, without ending.
    std::string effectName(const std::filesystem::path& path) const;
    /// The file of a built-in effect such as "pipeline/deferred-lighting" or "builtin-standard"; project before engine.
    std::optional<std::filesystem::path> findEffect(const std::string& name) const;

private:
    Roots roots_;
    EffectReader effects_;
    MetaIndex metas_;
    std::map<std::filesystem::path, std::unique_ptr<Mtl>> materials_;
    std::map<std::filesystem::path, std::unique_ptr<EffectAsset>> effectAssets_;
};

}  // namespace crevice::cocos
