// Command line → PipelineRequest: plugins first, since a document's classes may come from them; then options, seed,
// sets.
#include "app/commands/PipelineOptions.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/ArgumentText.h"
#include "core/Params.h"
#include "flow/RenderStage.h"
#include "stages/Builtin.h"

namespace crevice {
namespace {

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
    addCocosProjectOptions(command, options.cocos);
}

StageClasses::StageClasses(const PluginOptions& options) {
    registerBuiltinStages(registry_);
    for (const std::string& folder : options.pluginPaths) plugins_.allowFolder(folder);
    for (const std::string& file : options.plugins) plugins_.load(file, registry_);
}

AssetRoots rootsFor(const std::string& nameOrPath) { return AssetRoots::standard().forDocument(nameOrPath); }

PipelineChoice::PipelineChoice(const std::string& nameOrPath, const PipelineOptions& options, const Log& log,
                               const std::vector<std::string>& scenes)
    : roots_(rootsFor(nameOrPath)), classes_(options.plugins) {
    request_.nameOrPath = nameOrPath;
    std::vector<std::string> files{nameOrPath};
    files.insert(files.end(), scenes.begin(), scenes.end());
    cocos_ = openCocosProject(options.cocos, files);
    if (isCocosPipeline(nameOrPath)) {
        request_.text = cocos_->importPipeline(nameOrPath, classes_.registry(), log).text;
        request_.nameOrPath += " (translated)";  // its lines are not those of the .rpp
    }
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
    classes_.loadNeeded(roots_, request_);
    desc_ = loadPipeline(roots_, request_);
    if (!options.seed.empty()) setSeed(options.seed);
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
