// The options follow from the fields of a scene document: names, help, ranges and messages are theirs.
#include "app/commands/EnvironmentOptions.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/ArgumentText.h"
#include "core/Error.h"

namespace crevice {
namespace {

std::string optionOf(const std::string& key) { return "--environment-" + key; }

std::vector<ParamRow> fieldRows() {
    ParamTable table;
    EnvironmentFields fields;
    visitFields(table, fields);
    std::vector<ParamRow> rows;
    for (const ParamRow& row : table.rows())
        if (row.key != "file") rows.push_back(row);
    return rows;
}

/// An object such as a scene document would have, with the options as places.
Value documentOf(const EnvironmentOptions& given) {
    Value object = Value::makeObject();
    for (const ParamRow& row : fieldRows()) {
        const auto found = given.fields.find(row.key);
        if (found == given.fields.end() || found->second.empty()) continue;
        const std::string& text = found->second;
        if (row.type != "bool") {
            object.set(row.key, Value::makeNumber(parseNumber(optionOf(row.key), text)));
        } else if (text == "true" || text == "false") {
            object.set(row.key, Value::makeBool(text == "true"));
        } else {
            throw Error(fmt::format("{}: '{}' is neither true nor false", optionOf(row.key), text),
                        fmt::format("write {} false", optionOf(row.key)));
        }
    }
    return object;
}

/// What is given goes over what the fields hold.
void readFields(const EnvironmentOptions& given, EnvironmentFields& fields) {
    Problems problems;
    const Value object = documentOf(given);
    ParamReader reader(object, "--environment", problems);
    visitFields(reader, fields);
    reader.finish();
    problems.throwIfErrors();
}

EnvironmentFields fieldsOf(const Environment& environment) {
    EnvironmentFields fields;
    fields.rotation = glm::degrees(environment.rotation);
    fields.intensity = environment.intensity;
    fields.visible = environment.visible;
    fields.blur = environment.blur;
    return fields;
}

}  // namespace

void addEnvironmentOptions(CLI::App& command, EnvironmentOptions& options) {
    constexpr const char* kGroup = "Environment";
    command
        .add_option("--environment", options.environment,
                    "Light from all around: a panorama (.hdr, .exr), sky (computed) or none; default the scene's")
        ->type_name("FILE|sky|none")
        ->group(kGroup);
    for (const ParamRow& row : fieldRows()) {
        std::string help = row.help;
        if (!row.range.empty()) help += fmt::format(", {} {}", row.range, row.unit);
        while (help.ends_with(' ')) help.pop_back();
        command.add_option(optionOf(row.key), options.fields[row.key], help + "; default " + row.defaultValue)
            ->type_name(row.type == "bool" ? "true|false" : "NUMBER")
            ->group(kGroup);
    }
}

EnvironmentChoice::EnvironmentChoice(const EnvironmentOptions& options) : file_(options.environment), given_(options) {
    EnvironmentFields checked;
    readFields(given_, checked);
}

void EnvironmentChoice::apply(Scene& scene, const Log& log, const Limits& limits) {
    if (isNone()) {
        scene.environment.reset();
        return;
    }
    const bool named = !file_.empty();
    EnvironmentFields fields = scene.environment && !named ? fieldsOf(*scene.environment) : EnvironmentFields();
    readFields(given_, fields);
    if (file_ == "sky") {
        scene.environment = skyEnvironment(scene.sky);
    } else if (named) {
        if (!loaded_) loaded_ = loadEnvironment(file_, log, limits);
        scene.environment = loaded_;
    }
    if (scene.environment) {
        fields.apply(*scene.environment);
    } else if (!documentOf(given_).members().empty()) {
        throw Error(fmt::format("{} changes an environment, and the scene names none",
                                optionOf(documentOf(given_).members().front().key)),
                    "name one: --environment FILE, or --environment sky");
    }
}

}  // namespace crevice
