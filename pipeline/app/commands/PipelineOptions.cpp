// Command line → PipelineRequest: plugins first, since a document's classes may come from them; then options, seed,
// sets.
#include "app/commands/PipelineOptions.h"

#include <algorithm>
#include <limits>
#include <system_error>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/ArgumentText.h"
#include "core/Params.h"
#include "core/Text.h"
#include "flow/RenderStage.h"
#include "plan/PipelineAssetFiles.h"
#include "stages/Builtin.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

/// "outline" for "outline.so" and "liboutline.so".
std::string pluginName(const fs::path& file) {
    const std::string stem = file.stem().string();
    return stem.starts_with("lib") ? stem.substr(3) : stem;
}

bool hasSeed(const StageRegistry& registry, const StageDesc& stage) {
    const StageClass* stageClass = registry.find(stage.stageClass);
    if (!stageClass) return false;
    ParamTable table;
    stageClass->make()->params(table);
    return std::any_of(table.rows().begin(), table.rows().end(), [](const ParamRow& row) { return row.key == "seed"; });
}

}  // namespace

void addPluginOptions(CLI::App& command, PluginOptions& options) {
    command.add_option("--plugin", options.plugins, "Shared library with stages (repeatable)")
        ->type_name("FILE.so")
        ->allow_extra_args(false);
    command.add_option("--plugin-path", options.pluginPaths, "Folder of plugins that documents name (repeatable)")
        ->type_name("DIR")
        ->allow_extra_args(false);
}

void addPipelineOptions(CLI::App& command, PipelineOptions& options) {
    command.add_option("--option", options.options, "Value of an option of the pipeline (repeatable)")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    command.add_option("--set", options.sets, "Value of a stage's or target's field (repeatable)")
        ->type_name("STAGE.path=VALUE")
        ->allow_extra_args(false);
    command.add_option("--seed", options.seed, "Sets 'seed' on every stage that has one")->type_name("N");
    addPluginOptions(command, options.plugins);
}

StageClasses::StageClasses(const PluginOptions& options) : folders_(options.pluginPaths) {
    registerBuiltinStages(registry_);
    for (const std::string& folder : folders_) {
        std::error_code failed;
        if (!fs::is_directory(folder, failed)) {
            throw Error(fmt::format("--plugin-path: folder '{}' does not exist", folder), "name an existing folder");
        }
    }
    for (const std::string& file : options.plugins) load(file);
}

void StageClasses::load(const fs::path& file) {
    plugins_.emplace_back(file, registry_);
    files_.push_back(file);
}

void StageClasses::loadNeeded(const std::string& plugin, const SourceLoc& where) {
    const auto isLoaded = [&](const fs::path& file) { return pluginName(file) == plugin; };
    if (std::any_of(files_.begin(), files_.end(), isLoaded)) return;
    if (plugin.find('/') != std::string::npos) {
        throw Error(where, fmt::format("plugin '{}' is a path", plugin),
                    "write its name only; --plugin-path DIR says where it lies");
    }
    for (const fs::path folder : folders_) {
        for (const std::string& name : {plugin, plugin + ".so", "lib" + plugin + ".so"}) {
            std::error_code failed;
            if (fs::is_regular_file(folder / name, failed)) return load(folder / name);
        }
    }
    throw Error(where, fmt::format("the pipeline needs plugin '{}', and it was not found", plugin),
                folders_.empty() ? "say where it lies: --plugin-path DIR, or load it: --plugin FILE.so"
                                 : fmt::format("looked for lib{}.so in: {}", plugin, join(folders_)));
}

AssetRoots rootsFor(const std::string& nameOrPath) {
    AssetRoots roots = AssetRoots::standard();
    if (!nameOrPath.ends_with(".json")) return roots;
    const fs::path folder = fs::absolute(nameOrPath).lexically_normal().parent_path();
    roots.prepend(folder);
    // A document at its place in a tree of its own: ROOT/assets/pipelines/NAME.pipeline.json with ROOT/effects.
    if (folder.filename() == "pipelines" && folder.parent_path().filename() == "assets") {
        roots.prepend(folder.parent_path().parent_path());
    }
    return roots;
}

PipelineChoice::PipelineChoice(const std::string& nameOrPath, const PipelineOptions& options)
    : roots_(rootsFor(nameOrPath)), classes_(options.plugins) {
    request_.nameOrPath = nameOrPath;
    for (const std::string& option : options.options) {
        const auto [name, value] = parseAssignment("--option", option, "NAME=VALUE");
        if (!request_.options.emplace(name, value).second) {
            throw Error(fmt::format("--option: '{}' is given more than once", name), "give it once");
        }
    }
    for (const std::string& set : options.sets) {
        const auto [path, value] = parseAssignment("--set", set, "STAGE.path=VALUE");
        request_.sets.push_back({path, value});
    }
    request_.defaultPriority = [this](const std::string& name) { return classes_.registry().priorityOf(name); };
    loadPlugins();
    desc_ = loadPipeline(roots_, request_);
    if (!options.seed.empty()) setSeed(options.seed);
}

void PipelineChoice::loadPlugins() {
    Problems problems;  // reported by loadPipeline()
    for (const PipelineSource& source : readPipelineChain(roots_, request_.nameOrPath, problems)) {
        const Value* plugins = source.tree.isObject() ? source.tree.find("plugins") : nullptr;
        if (!plugins || !plugins->isArray()) continue;
        for (const Value& plugin : plugins->items()) {
            if (plugin.isString()) classes_.loadNeeded(plugin.string(), plugin.where());
        }
    }
}

void PipelineChoice::setSeed(const std::string& seed) {
    parseCount("--seed", seed, 0, std::numeric_limits<std::uint32_t>::max());
    std::vector<StageSet> sets;
    for (const FlowDesc& flow : desc_.flows) {
        for (const StageDesc& stage : flow.stages) {
            if (hasSeed(classes_.registry(), stage)) sets.push_back({stage.name + ".params.seed", seed});
        }
    }
    if (sets.empty()) {
        throw Error(fmt::format("--seed: no stage of pipeline '{}' has a seed", desc_.name), "leave --seed out");
    }
    // Before the user's own, so that `--set` wins.
    request_.sets.insert(request_.sets.begin(), sets.begin(), sets.end());
    desc_ = loadPipeline(roots_, request_);
}

}  // namespace crevice
