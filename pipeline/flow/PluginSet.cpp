// Finds plugins by name in allowed folders only.
#include "flow/PluginSet.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/Text.h"
#include "plan/PipelineAssetFiles.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

/// "outline" for "outline.so" and "liboutline.so".
std::string pluginName(const fs::path& file) {
    const std::string stem = file.stem().string();
    return stem.starts_with("lib") ? stem.substr(3) : stem;
}

}  // namespace

void PluginSet::load(const fs::path& file, StageRegistry& registry) {
    const auto isSame = [&](const fs::path& other) {
        std::error_code failed;
        return fs::equivalent(file, other, failed);
    };
    if (std::any_of(files_.begin(), files_.end(), isSame)) return;
    plugins_.emplace_back(file, registry);
    files_.push_back(file);
}

void PluginSet::allowFolder(const fs::path& folder) {
    std::error_code failed;
    if (!fs::is_directory(folder, failed)) {
        throw Error(fmt::format("--plugin-path: folder '{}' does not exist", folder.string()),
                    "name an existing folder");
    }
    folders_.push_back(folder);
}

void PluginSet::loadNeeded(const AssetRoots& roots, const PipelineRequest& request, StageRegistry& registry) {
    Problems problems;  // reported by loadPipeline()
    for (const PipelineSource& source : readPipelineChain(roots, request, problems)) {
        const Value* plugins = source.tree.isObject() ? source.tree.find("plugins") : nullptr;
        if (!plugins || !plugins->isArray()) continue;
        for (const Value& plugin : plugins->items()) {
            if (plugin.isString()) loadNamed(plugin.string(), plugin.where(), registry);
        }
    }
}

void PluginSet::loadNamed(const std::string& plugin, const SourceLoc& where, StageRegistry& registry) {
    const auto isLoaded = [&](const fs::path& file) { return pluginName(file) == plugin; };
    if (std::any_of(files_.begin(), files_.end(), isLoaded)) return;
    if (plugin.find('/') != std::string::npos) {
        throw Error(where, fmt::format("plugin '{}' is a path", plugin),
                    "write its name only; --plugin-path DIR says where it lies");
    }
    std::vector<std::string> searched;
    for (const fs::path& folder : folders_) {
        searched.push_back(folder.string());
        for (const std::string& name : {plugin, plugin + ".so", "lib" + plugin + ".so"}) {
            std::error_code failed;
            if (fs::is_regular_file(folder / name, failed)) return load(folder / name, registry);
        }
    }
    throw Error(where,
                fmt::format("the pipeline needs plugin '{}', {}", plugin,
                            folders_.empty() ? "which the caller has not allowed" : "which was not found"),
                folders_.empty()
                    ? fmt::format("add --plugin DIR/lib{}.so, or --plugin-path DIR with its folder", plugin)
                    : fmt::format("looked for lib{}.so in: {}", plugin, join(searched)));
}

}  // namespace crevice
