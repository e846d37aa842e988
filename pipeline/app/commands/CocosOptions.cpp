// Folders are checked before anything is read from them.
#include "app/commands/CocosOptions.h"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cocos/CocosEffects.h"
#include "flow/RenderStage.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

fs::path checkFolder(const char* option, const std::string& folder) {
    std::error_code failed;
    if (folder.empty() || fs::is_directory(folder, failed)) return folder;
    throw Error(fmt::format("{}: no folder '{}'", option, folder), "name a folder that exists");
}

std::vector<cocos::StageFacts> factsOf(const StageRegistry& registry) {
    const RunInfo run;
    std::vector<cocos::StageFacts> all;
    for (const StageClass& stageClass : registry.classes()) {
        cocos::StageFacts facts{.name = stageClass.name};
        const auto stage = stageClass.make();
        ParamTable table;
        stage->params(table);
        for (const ParamRow& row : table.rows()) facts.params.push_back(row.key);
        StageDeclaration declaration;
        StageDesc desc;
        desc.effect = stageClass.name;  // a name of any kind: data-only stages insist on one
        StageIo io(declaration, desc, run);
        stage->declare(io);
        for (const TargetWrite& write : declaration.writes) facts.writes.push_back(write.target);
        all.push_back(std::move(facts));
    }
    return all;
}

}  // namespace

void addCocosProjectOptions(CLI::App& command, CocosProjectOptions& options) {
    command
        .add_option("--project", options.project, "Cocos Creator project; default the folder above a .rpp or .scene")
        ->type_name("DIR");
    command.add_option("--engine", options.engine, "Cocos engine checkout: its effects, chunks and materials")
        ->type_name("DIR");
    command.add_option("--chunks", options.chunks, "Folder of chunks that is searched first (repeatable)")
        ->type_name("DIR")
        ->allow_extra_args(false);
    command
        .add_option("--cocos-version", options.version,
                    "Version of a .rpp, such as 3.3.1; default as the engine or project says")
        ->type_name("VERSION");
}

bool isCocosPipeline(const std::string& nameOrPath) { return nameOrPath.ends_with(".rpp"); }
bool isCocosScene(const std::string& nameOrPath) { return nameOrPath.ends_with(".scene"); }

CocosProject::CocosProject(const CocosProjectOptions& options, const std::string& file) : version_(options.version) {
    roots_.project = checkFolder("--project", options.project);
    roots_.engine = cocos::engineFolder(checkFolder("--engine", options.engine));
    for (const std::string& folder : options.chunks) roots_.chunks.push_back(checkFolder("--chunks", folder));
    if (options.project.empty() && !file.empty()) roots_.project = cocos::findProjectFolder(file).value_or(fs::path());
}

cocos::Project& CocosProject::assets(const Log& log) {
    if (!assets_) {
        const auto effects = std::make_shared<cocos::CocosEffects>(roots_);
        Problems problems;
        assets_ = std::make_unique<cocos::Project>(
            roots_,
            [effects](const fs::path& path, const std::string& name, Problems& found) {
                return effects->parse(path, name, found);
            },
            problems);
        log.write(problems);
    }
    return *assets_;
}

void CocosProject::addEffects(EffectLibrary& library) const {
    library.addFrontEnd(std::make_unique<cocos::CocosEffects>(roots_));
}

cocos::ImportedPipeline CocosProject::importPipeline(const std::string& rpp, const StageRegistry& classes,
                                                     const Log& log) {
    Problems problems;
    const cocos::ImportRequest request{.rpp = rpp, .classes = factsOf(classes), .version = version_};
    cocos::ImportedPipeline imported;
    try {
        imported = cocos::importPipeline(request, assets(log), problems);
    } catch (const Error& error) {
        problems.add(error);
    }
    problems.throwIfErrors();
    log.write(problems);
    return imported;
}

std::shared_ptr<CocosProject> openCocosProject(const CocosProjectOptions& options,
                                               const std::vector<std::string>& files) {
    std::string first;
    for (const std::string& file : files) {
        if (first.empty() && (isCocosPipeline(file) || isCocosScene(file))) first = file;
    }
    const bool asked =
        !options.project.empty() || !options.engine.empty() || !options.chunks.empty() || !options.version.empty();
    if (!asked && first.empty()) return nullptr;
    return std::make_shared<CocosProject>(options, first);
}

}  // namespace crevice
