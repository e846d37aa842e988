// Which pipeline, and what is changed in it: the options that all commands with a pipeline share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/CocosOptions.h"
#include "core/Files.h"
#include "core/Log.h"
#include "flow/FrameProgram.h"
#include "flow/PluginSet.h"
#include "flow/StageRegistry.h"
#include "plan/PipelineAsset.h"

namespace CLI {
class App;
}

namespace crevice {

inline constexpr const char* kDefaultPipeline = "ssao-deferred";

struct PluginOptions {
    std::vector<std::string> plugins;      ///< --plugin FILE.so
    std::vector<std::string> pluginPaths;  ///< --plugin-path DIR: where documents' plugins are looked up.
};
void addPluginOptions(CLI::App& command, PluginOptions& options);

struct PipelineOptions {
    std::vector<std::string> options;  ///< NAME=VALUE
    std::vector<std::string> sets;     ///< STAGE.path=VALUE
    std::string seed;                  ///< Empty = not given.
    PluginOptions plugins;
    CocosProjectOptions cocos;
};
void addPipelineOptions(CLI::App& command, PipelineOptions& options);

/// The stage classes that documents can name, without a device.
class StageClasses {
public:
    /// Builtin classes and the --plugin files. Throws Error.
    explicit StageClasses(const PluginOptions& options);
    /// Loads what the documents name in "plugins" from --plugin-path. Throws Error.
    void loadNeeded(const AssetRoots& roots, const PipelineRequest& request) {
        plugins_.loadNeeded(roots, request, registry_);
    }

    const StageRegistry& registry() const { return registry_; }
    const std::vector<std::filesystem::path>& pluginFiles() const { return plugins_.files(); }

private:
    PluginSet plugins_;  // before the registry: code outlives the factories made from it
    StageRegistry registry_;
};

/// A pipeline read from its document with everything the command line changes in it.
class PipelineChoice {
public:
    /// A .rpp is translated first; what its translation leaves out is said to `log`. `scenes` are asked for the project
    /// they lie in. Throws Error.
    PipelineChoice(const std::string& nameOrPath, const PipelineOptions& options, const Log& log = Log(),
                   const std::vector<std::string>& scenes = {});
    PipelineChoice(const PipelineChoice&) = delete;  // the request refers to the classes
    PipelineChoice& operator=(const PipelineChoice&) = delete;

    const PipelineRequest& request() const { return request_; }
    const PipelineDesc& desc() const { return desc_; }
    const AssetRoots& roots() const { return roots_; }
    const StageClasses& classes() const { return classes_; }
    /// The Cocos project in use, or null.
    const std::shared_ptr<CocosProject>& cocos() const { return cocos_; }
    /// Effects of the Cocos project in use, if any, are found by the library from now on.
    void addEffects(EffectLibrary& library) const {
        if (cocos_) cocos_->addEffects(library);
    }

private:
    void setSeed(const std::string& seed);

    AssetRoots roots_;
    StageClasses classes_;
    PipelineRequest request_;
    std::shared_ptr<CocosProject> cocos_;
    PipelineDesc desc_;
};

/// The standard roots, and the folder tree around a document that is given by path.
AssetRoots rootsFor(const std::string& nameOrPath);

}  // namespace crevice
