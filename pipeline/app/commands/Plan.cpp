// `crevice plan`: what a frame does, stage by stage, as a table or a graph.
#include <memory>

#include <CLI/CLI.hpp>

#include "app/commands/ArgumentText.h"
#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/OpenScene.h"
#include "app/commands/PipelineOptions.h"
#include "app/commands/SceneFiles.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice plan ssao-deferred\n"
    "  crevice plan ssao-deferred default --size 640x360\n"
    "  crevice plan deferred --dot\n";

struct PlanOptions {
    std::string pipeline, scene, size = "1280x720";
    PipelineOptions pipelineOptions;
    SceneOptions loading;
    ConsoleOptions console;
    bool dot = false;
};

int runPlan(const PlanOptions& options) {
    if (options.pipeline.empty()) throw Error("no pipeline given", "name one: crevice plan ssao-deferred");
    const glm::uvec2 size = parseSize("--size", options.size);
    const Log log = makeLog(options.console);
    const PipelineChoice pipeline(options.pipeline, options.pipelineOptions, log, {options.scene});
    EffectLibrary library(pipeline.roots(), log);
    pipeline.addEffects(library);
    FrameProgram program(pipeline.desc(), pipeline.classes().registry(), library, log,
                         {.width = size.x, .height = size.y});
    const Scene scene = openSceneOrSample(options.scene, pipeline, log, options.loading);
    program.prepare(&scene);
    log.write(program.plan().notes);
    print(options.dot ? planDot(program.plan())
                      : planTable(program.plan(), program.desc(), size.x, size.y, &program.globals().bindings()));
    return 0;
}

}  // namespace

void addPlanCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("plan", "Print what a frame does: writes, reads, transitions, memory");
    const auto options = std::make_shared<PlanOptions>();
    command->add_option("pipeline", options->pipeline, "Name or path of a pipeline")->type_name("PIPELINE");
    command->add_option("scene", options->scene, "Scene whose materials are drawn; default a plain box")
        ->type_name("SCENE");
    command->add_option("--size", options->size, "Pixels of the frame")->type_name("WxH")->capture_default_str();
    command->add_flag("--dot", options->dot, "Print a graph for Graphviz");
    addPipelineOptions(*command, options->pipelineOptions);
    addSceneOptions(*command, options->loading);
    addConsoleOptions(*command, options->console);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runPlan(*options); }; });
}

}  // namespace crevice
