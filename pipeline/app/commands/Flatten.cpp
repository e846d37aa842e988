// `crevice flatten`: a pipeline with its parents, flow files, edits and sets merged into one document.
#include <memory>

#include <CLI/CLI.hpp>

#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/PipelineOptions.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice flatten ssao-deferred\n"
    "  crevice flatten ssao-deferred --resolve --option ssao=false\n";

struct FlattenCommand {
    std::string pipeline;
    PipelineOptions pipelineOptions;
    bool resolve = false;
};

int runFlatten(const FlattenCommand& options) {
    if (options.pipeline.empty()) throw Error("no pipeline given", "name one: crevice flatten ssao-deferred");
    const PipelineChoice pipeline(options.pipeline, options.pipelineOptions);
    const FlattenOptions mode = options.resolve ? FlattenOptions::Resolve : FlattenOptions::Keep;
    print(flattenText(flattenPipeline(pipeline.roots(), pipeline.request(), mode)));
    return 0;
}

}  // namespace

void addFlattenCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("flatten", "Print a pipeline merged into one document, with origins");
    const auto options = std::make_shared<FlattenCommand>();
    command->add_option("pipeline", options->pipeline, "Name or path of a pipeline")->type_name("PIPELINE");
    command->add_flag("--resolve", options->resolve, "Put the values of options in the place of their names");
    addPipelineOptions(*command, options->pipelineOptions);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runFlatten(*options); }; });
}

}  // namespace crevice
