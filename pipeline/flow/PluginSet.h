// The plugins that a caller has allowed. Opening a document never runs code: what it names must be here already, or lie
// in a folder that the caller named.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/Files.h"
#include "flow/Plugin.h"
#include "plan/PipelineAsset.h"

namespace crevice {

class PluginSet {
public:
    /// Opens a plugin and registers its classes; one that is open already is left alone. Throws Error.
    void load(const std::filesystem::path& file, StageRegistry& registry);
    /// Documents may load plugins of this folder by name from now on. Throws Error when there is no such folder.
    void allowFolder(const std::filesystem::path& folder);
    /// Makes sure of everything that a document and its ancestors list in "plugins". Throws Error that says which flag
    /// to add.
    void loadNeeded(const AssetRoots& roots, const PipelineRequest& request, StageRegistry& registry);

    const std::vector<std::filesystem::path>& files() const { return files_; }

private:
    void loadNamed(const std::string& plugin, const SourceLoc& where, StageRegistry& registry);

    std::vector<std::filesystem::path> folders_;
    std::vector<std::filesystem::path> files_;  ///< As they were named; one per plugin.
    std::vector<Plugin> plugins_;
};

}  // namespace crevice
