// `crevice schema`: JSON Schema of pipeline documents for editors, with the parameters of every stage class.
#include <memory>

#include <CLI/CLI.hpp>

#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/OutputFiles.h"
#include "app/commands/PipelineOptions.h"
#include "core/Params.h"
#include "flow/RenderStage.h"
#include "plan/Schema.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice schema\n"
    "  crevice schema -o pipeline.schema.json\n";

struct SchemaOptions {
    std::string out;
    PluginOptions plugins;
};

int runSchema(const SchemaOptions& options) {
    if (!options.out.empty()) checkOutputPath("-o", options.out);
    const StageClasses classes(options.plugins);
    std::vector<StageSchema> stages;
    for (const StageClass& stageClass : classes.registry().classes()) {
        ParamTable params;
        stageClass.make()->params(params);
        stages.push_back({stageClass.name, stageClass.info.help, params.schema()});
    }
    const std::string text = pipelineSchema(stages).toJson(2) + "\n";
    if (options.out.empty()) {
        print(text);
        return 0;
    }
    writeFileAtomically(options.out, text);
    print(options.out + "\n");
    return 0;
}

}  // namespace

void addSchemaCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("schema", "Write the JSON Schema of pipeline documents");
    const auto options = std::make_shared<SchemaOptions>();
    command->add_option("-o,--out", options->out, "File to write; default the standard output")->type_name("FILE");
    addPluginOptions(*command, options->plugins);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runSchema(*options); }; });
}

}  // namespace crevice
