// A Cocos Creator project and engine on the command line: --project, --engine, --chunks, --cocos-version.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cocos/import/Import.h"
#include "core/Log.h"
#include "effect/EffectLibrary.h"
#include "flow/StageRegistry.h"

namespace CLI {
class App;
}

namespace crevice {

struct CocosProjectOptions {
    std::string project, engine, version;  ///< Empty = not given.
    std::vector<std::string> chunks;
};
void addCocosProjectOptions(CLI::App& command, CocosProjectOptions& options);

/// "X.rpp"
bool isCocosPipeline(const std::string& nameOrPath);
/// "X.scene", but not "X.scene.json"
bool isCocosScene(const std::string& nameOrPath);

/// The project in use. Throws Error for folders that do not exist. Without --project the folder is looked for above
/// `file`.
class CocosProject {
public:
    CocosProject(const CocosProjectOptions& options, const std::string& file);

    const cocos::Roots& roots() const { return roots_; }
    /// All metas are read when first asked for; warnings about them go to `log`, once.
    cocos::Project& assets(const Log& log);
    /// The library finds the project's and the engine's effects from now on.
    void addEffects(EffectLibrary& library) const;
    /// The document that a .rpp becomes. Throws Error; notes go to `log`.
    cocos::ImportedPipeline importPipeline(const std::string& rpp, const StageRegistry& classes, const Log& log);

private:
    cocos::Roots roots_;
    std::string version_;
    std::unique_ptr<cocos::Project> assets_;
};

/// Nothing when neither the options nor the files' endings speak of Cocos.
std::shared_ptr<CocosProject> openCocosProject(const CocosProjectOptions& options,
                                               const std::vector<std::string>& files);

}  // namespace crevice
