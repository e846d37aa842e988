// `crevice stages`: the classes that documents can name, and their parameters, from the lists that reading uses.
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/PipelineOptions.h"
#include "app/commands/TextTable.h"
#include "core/Params.h"
#include "core/Text.h"
#include "flow/RenderStage.h"

namespace crevice {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice stages\n"
    "  crevice stages SsaoStage\n"
    "  crevice stages --json\n";

struct StagesOptions {
    std::string name;
    PluginOptions plugins;
    bool markdown = false, json = false;
};

std::vector<ParamRow> paramsOf(const StageClass& stageClass) {
    ParamTable table;
    stageClass.make()->params(table);
    return table.rows();
}

std::string priorityText(const StageClass& stageClass) {
    return stageClass.info.priority ? std::to_string(*stageClass.info.priority) : "–";
}

TextTable paramTable(const std::vector<ParamRow>& rows) {
    TextTable table;
    table.add({"parameter", "type", "default", "range", "unit", "help"});
    for (const ParamRow& row : rows) {
        table.add({row.key, row.type, row.defaultValue, row.range, row.unit, row.help});
    }
    return table;
}

std::string listText(const std::vector<StageClass>& classes) {
    TextTable table;
    table.add({"class", "priority", "origin", "help"});
    for (const StageClass& c : classes) table.add({c.name, priorityText(c), c.origin, c.info.help});
    return table.text();
}

std::string classText(const StageClass& c) {
    const TextTable table = paramTable(paramsOf(c));
    return fmt::format("{}: {}\n  priority {}, from {}\n{}", c.name, c.info.help, priorityText(c), c.origin,
                       table.empty() ? "  no parameters\n" : table.text(2));
}

std::string classMarkdown(const StageClass& c) {
    const TextTable table = paramTable(paramsOf(c));
    return fmt::format("## {}\n\n{}\n\nPriority: {}\n\n{}\n", c.name, c.info.help, priorityText(c),
                       table.empty() ? "No parameters.\n" : table.markdown());
}

Json classJson(const StageClass& c) {
    Json params = Json::array();
    for (const ParamRow& row : paramsOf(c)) {
        params.push_back({{"key", row.key},
                          {"type", row.type},
                          {"default", Json::parse(row.defaultValue)},
                          {"range", row.range},
                          {"unit", row.unit},
                          {"help", row.help},
                          {"schema", Json::parse(row.schema.toJson(-1))}});
    }
    const Json priority = c.info.priority ? Json(*c.info.priority) : Json();
    return {{"class", c.name}, {"priority", priority}, {"origin", c.origin}, {"help", c.info.help}, {"params", params}};
}

std::vector<StageClass> chooseClasses(const StageRegistry& registry, const std::string& name) {
    if (name.empty()) return registry.classes();
    if (const StageClass* found = registry.find(name)) return {*found};
    std::vector<std::string> names;
    for (const StageClass& c : registry.classes()) names.push_back(c.name);
    throw Error(fmt::format("no stage class named '{}'", name), didYouMean(name, names, "classes"));
}

int runStages(const StagesOptions& options) {
    if (options.markdown && options.json) {
        throw Error("--markdown and --json contradict each other", "choose one of them");
    }
    const StageClasses stageClasses(options.plugins);
    const std::vector<StageClass> classes = chooseClasses(stageClasses.registry(), options.name);
    if (options.json) {
        Json all = Json::array();
        for (const StageClass& c : classes) all.push_back(classJson(c));
        print(all.dump(2) + "\n");
    } else if (options.markdown) {
        for (const StageClass& c : classes) print(classMarkdown(c));
    } else if (options.name.empty()) {
        print(listText(classes));
    } else {
        print(classText(classes.front()));
    }
    return 0;
}

}  // namespace

void addStagesCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("stages", "List stage classes and their parameters");
    const auto options = std::make_shared<StagesOptions>();
    command->add_option("name", options->name, "One class, with its parameters")->type_name("CLASS");
    command->add_flag("--markdown", options->markdown, "As Markdown, parameters included");
    command->add_flag("--json", options->json, "As JSON, parameters included");
    addPluginOptions(*command, options->plugins);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runStages(*options); }; });
}

}  // namespace crevice
