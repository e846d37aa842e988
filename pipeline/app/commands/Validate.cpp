// `crevice validate`: everything that can be wrong with a pipeline short of a device, its shaders included.
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/OpenScene.h"
#include "app/commands/PipelineOptions.h"
#include "app/commands/SceneFiles.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice validate ssao-deferred deferred\n"
    "  crevice validate ssao-deferred --option ssao=false --scene default\n";

struct ValidateOptions {
    std::vector<std::string> pipelines;
    std::string scene;
    PipelineOptions pipelineOptions;
    SceneOptions loading;
    ConsoleOptions console;
    bool noCache = false;
};

void validatePipeline(const std::string& name, const ValidateOptions& options, const Log& log) {
    const PipelineChoice pipeline(name, options.pipelineOptions, log, {options.scene});
    EffectLibrary library(pipeline.roots(), log, {.useDiskCache = !options.noCache});
    pipeline.addEffects(library);
    FrameProgram program(pipeline.desc(), pipeline.classes().registry(), library, log, {});
    const Scene scene = openSceneOrSample(options.scene, pipeline, log, options.loading);
    program.prepare(&scene);
    log.write(program.globals().notes());
    log.write(program.plan().notes);
    const EffectLibrary::Counters& counters = library.counters();
    log.verbose(
        fmt::format("{}: {} shader variants compiled, {} from the cache", name, counters.compiled, counters.fromDisk));
    print(fmt::format("{}: ok, {} stages run\n", name, program.plan().stages.size()));
}

/// Goes on after a bad pipeline; bad input outweighs failed work.
int runValidate(const ValidateOptions& options) {
    if (options.pipelines.empty()) throw Error("no pipeline given", "name one: crevice validate ssao-deferred");
    const Log log = makeLog(options.console);
    std::vector<Problem> problems;
    bool badInput = false;
    const auto collect = [&](const Error& error) {
        problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    };
    for (const std::string& name : options.pipelines) {
        try {
            validatePipeline(name, options, log);
        } catch (const RenderError& error) {
            collect(error);
        } catch (const Error& error) {
            collect(error);
            badInput = true;
        }
    }
    if (badInput) throw Error(std::move(problems));
    if (!problems.empty()) throw RenderError(std::move(problems));
    return 0;
}

}  // namespace

void addValidateCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("validate", "Check pipelines, their effects and shaders; no device");
    const auto options = std::make_shared<ValidateOptions>();
    command->add_option("pipeline", options->pipelines, "Names or paths of pipelines")->type_name("PIPELINE");
    command->add_option("--scene", options->scene, "Check with the materials of a scene; default a plain box")
        ->type_name("SCENE");
    command->add_flag("--no-cache", options->noCache, "Compile all shaders anew");
    addPipelineOptions(*command, options->pipelineOptions);
    addSceneOptions(*command, options->loading);
    addConsoleOptions(*command, options->console);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runValidate(*options); }; });
}

}  // namespace crevice
