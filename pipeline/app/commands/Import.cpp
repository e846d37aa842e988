// `crevice import`: a Cocos pipeline and its materials as one of our documents.
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/CocosOptions.h"
#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/OutputFiles.h"
#include "app/commands/PipelineOptions.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice import mine.rpp -o mine.pipeline.json\n"
    "  crevice import mine.rpp --cocos-version 3.3.1\n";

struct ImportOptions {
    std::string rpp, out;
    CocosProjectOptions cocos;
    PluginOptions plugins;
    ConsoleOptions console;
};

int runImport(const ImportOptions& options) {
    if (options.rpp.empty())
        throw Error("no pipeline given", "name a .rpp file: crevice import X.rpp -o X.pipeline.json");
    if (!isCocosPipeline(options.rpp))
        throw Error(fmt::format("'{}' is no Cocos pipeline", options.rpp), "pipelines of Cocos Creator end in .rpp");
    if (!options.out.empty()) {
        checkOutputPath("-o", options.out);
        if (!options.out.ends_with(".json"))
            throw Error(fmt::format("-o: '{}' must end in .json", options.out), "pipelines end in .pipeline.json");
    }
    const Log log = makeLog(options.console);
    CocosProject project(options.cocos, options.rpp);
    const StageClasses classes(options.plugins);
    const cocos::ImportedPipeline imported = project.importPipeline(options.rpp, classes.registry(), log);
    log.verbose(fmt::format("{}: {}, {}", imported.name, imported.version.profile, imported.version.reason));
    if (options.out.empty()) {
        print(imported.text);
        return 0;
    }
    OutputFiles files;
    files.add(options.out, imported.text);
    for (const std::filesystem::path& path : files.commit()) print(path.string() + "\n");
    return 0;
}

}  // namespace

void addImportCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("import", "Translate a Cocos pipeline (.rpp) into a pipeline document");
    const auto options = std::make_shared<ImportOptions>();
    command->add_option("pipeline", options->rpp, "Cocos pipeline")->type_name("PIPELINE.rpp");
    command->add_option("-o,--out", options->out, "Document to write; without it, it is printed")
        ->type_name("OUT.pipeline.json");
    addCocosProjectOptions(*command, options->cocos);
    addPluginOptions(*command, options->plugins);
    addConsoleOptions(*command, options->console);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runImport(*options); }; });
}

}  // namespace crevice
