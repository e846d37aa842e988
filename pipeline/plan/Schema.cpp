// Builds the schema and the Markdown tables from the key tables.
#include "plan/Schema.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "plan/PipelineAssetKeys.h"

namespace crevice {
namespace {

constexpr const char* kOptionUse =
    R"({"type":"string","pattern":"^\\$[A-Za-z_][A-Za-z0-9_-]*$","description":"Value of an option."})";
constexpr const char* kCondition =
    R"({"anyOf":[{"type":"boolean"},{"type":"string","pattern":"^\\s*(!\\s*\\$[\\w-]+|\\$[\\w-]+(\\s*(==|!=)\\s*\\S+)?)\\s*$"}]})";

Value json(std::string_view text) { return parseJson(text, "schema"); }
Value text(std::string words) { return Value::makeString(std::move(words)); }

Value object(std::vector<std::pair<std::string, Value>> members) {
    Value result = Value::makeObject();
    for (auto& [key, value] : members) result.set(key, std::move(value));
    return result;
}

Value array(std::vector<Value> items) {
    Value result = Value::makeArray();
    result.items() = std::move(items);
    return result;
}

Value reference(const std::string& name) { return object({{"$ref", text("#/$defs/" + name)}}); }

Value choiceSchema(const KeySpec& spec) {
    std::vector<Value> names;
    for (const std::string& name : spec.names()) names.push_back(text(name));
    return object({{"enum", array(std::move(names))}});
}

Value numberSchema(const KeySpec& spec) {
    Value schema = object({{"type", text(spec.kind == KeyKind::Integer ? "integer" : "number")}});
    if (std::isfinite(spec.min))
        schema.set(spec.exclusiveMin ? "exclusiveMinimum" : "minimum", Value::makeNumber(spec.min));
    if (std::isfinite(spec.max)) schema.set("maximum", Value::makeNumber(spec.max));
    return schema;
}

Value typeSchema(const KeySpec& spec) {
    if (spec.schema) return json(spec.schema);
    switch (spec.kind) {
        case KeyKind::Bool:
            return json(R"({"type":"boolean"})");
        case KeyKind::Condition:
            return json(kCondition);
        case KeyKind::Integer:
        case KeyKind::Number:
        case KeyKind::NumberOrOption:
            return numberSchema(spec);
        case KeyKind::Text:
            return json(R"({"type":"string"})");
        case KeyKind::Choice:
            return choiceSchema(spec);
        case KeyKind::Object:
            return json(R"({"type":"object"})");
        case KeyKind::Array:
            return json(R"({"type":"array"})");
        case KeyKind::ObjectOrArray:
            return json(R"({"type":["object","array"]})");
        case KeyKind::NumberOrArray:
            return json(R"({"type":["number","array"]})");
        case KeyKind::Any:
            return Value::makeObject();
    }
    return {};
}

/// "$option" may stand for the value.
bool takesOption(const KeySpec& spec) {
    return spec.kind == KeyKind::Integer || spec.kind == KeyKind::Number || spec.kind == KeyKind::Choice ||
           spec.kind == KeyKind::NumberOrArray;
}

Value orOption(Value schema) { return object({{"anyOf", array({std::move(schema), reference("optionUse")})}}); }

/// The default of a key as the docs write it, if it is a value and no explanation.
void addDefault(Value& schema, const KeySpec& spec) {
    const std::string words = spec.defaultText;
    if (spec.kind == KeyKind::Choice && !words.empty()) schema.set("default", text(words));
    if (words == "true" || words == "false" ||
        (!words.empty() && words.find_first_not_of("0123456789.") == std::string::npos))
        schema.set("default", json(words));
}

Value keySchema(const KeySpec& spec, bool options) {
    Value schema = typeSchema(spec);
    if (spec.kind == KeyKind::NumberOrOption || (options && takesOption(spec))) schema = orOption(std::move(schema));
    schema.set("description", text(spec.help));
    addDefault(schema, spec);
    return schema;
}

Value tableSchema(const KeyTable& table, bool options = false) {
    Value properties = Value::makeObject();
    std::vector<Value> required;
    for (const KeySpec& spec : table.keys) {
        properties.set(spec.key, keySchema(spec, options));
        if (spec.required) required.push_back(text(spec.key));
    }
    Value schema = object({{"type", text("object")}});
    if (!required.empty()) schema.set("required", array(std::move(required)));
    schema.set("additionalProperties", Value::makeBool(false));
    schema.set("properties", std::move(properties));
    return schema;
}

/// An override names only what changes, so it needs none of the required keys.
Value orOverride(Value schema, const char* required) {
    schema.erase("required");
    schema.set("anyOf", json(fmt::format(R"([{},{{"required":["override"]}}])", required)));
    return schema;
}

/// Parameters of a class, each of which an option may stand for.
Value paramsSchema(Value schema) {
    if (!schema.isObject()) return json(R"({"type":"object"})");
    if (Value* properties = schema.find("properties"); properties && properties->isObject())
        for (Member& member : properties->members()) {
            Value description;
            if (const Value* help = member.value.find("description")) description = *help;
            member.value = orOption(member.value);
            if (!description.isNull()) member.value.set("description", std::move(description));
        }
    return schema;
}

/// Completes the names of known classes, accepts those of plugins, and checks the parameters of the known ones.
Value stageSchema(const std::vector<StageSchema>& stages) {
    Value schema = tableSchema(stageKeys(), true);
    std::vector<Value> names, rules;
    for (const StageSchema& stage : stages) {
        names.push_back(object({{"const", text(stage.name)}, {"description", text(stage.help)}}));
        const Value isClass = object({{"properties", object({{"stage", object({{"const", text(stage.name)}})}})},
                                      {"required", json(R"(["stage"])")}});
        rules.push_back(object({{"if", isClass}, {"then", reference(stage.name)}}));
    }
    names.push_back(json(R"({"type":"string"})"));
    Value* stageKey = schema.find("properties")->find("stage");
    stageKey->erase("type");
    stageKey->set("anyOf", array(std::move(names)));
    if (!rules.empty()) schema.set("allOf", array(std::move(rules)));
    return schema;
}

/// { "set": "LightingStage", … }: the keys of a stage but for its class and name.
Value setSchema() {
    Value schema = tableSchema(stageKeys(), true);
    Value* properties = schema.find("properties");
    properties->erase("stage");
    properties->erase("name");
    properties->set("set",
                    json(R"({"type":"string","description":"Stage that changes (or flow: enabled, priority)."})"));
    schema.set("required", json(R"(["set"])"));
    return schema;
}

Value editSchema() {
    return object({{"anyOf", array({tableSchema(insertKeys()), setSchema(), tableSchema(replaceKeys()),
                                    tableSchema(removeKeys())})}});
}

/// `help` is cut at no place; a `|` would end the cell.
std::string cell(std::string words) {
    std::string escaped;
    for (const char c : words) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
    return escaped;
}

}  // namespace

Value pipelineSchema(const std::vector<StageSchema>& stages) {
    Value definitions = Value::makeObject();
    definitions.set("optionUse", json(kOptionUse));
    definitions.set("target",
                    orOverride(tableSchema(targetKeys(), true), R"({"required":["format"]},{"required":["like"]})"));
    definitions.set("block", tableSchema(blockKeys()));
    definitions.set("fallbacks", tableSchema(fallbackKeys()));
    definitions.set("option", orOverride(tableSchema(optionKeys()), R"({"required":["type","default"]})"));
    definitions.set("choice", tableSchema(choiceKeys()));
    definitions.set("queue", tableSchema(queueKeys(), true));
    definitions.set("flow", tableSchema(flowKeys()));
    definitions.set("flowFile", tableSchema(flowFileKeys()));
    definitions.set("stage", stageSchema(stages));
    definitions.set("edit", editSchema());
    for (const StageSchema& stage : stages) {
        const Value params = paramsSchema(stage.paramsSchema);
        definitions.set(
            stage.name,
            object({{"description", text(stage.help)},
                    {"properties", object({{"stage", object({{"const", text(stage.name)}})}, {"params", params}})}}));
    }
    Value schema = object({{"$schema", text("https://json-schema.org/draft/2020-12/schema")},
                           {"title", text("Crevice pipeline document")}});
    const Value top = tableSchema(pipelineKeys());
    for (const Member& member : top.members()) schema.set(member.key, member.value);
    schema.set("$defs", std::move(definitions));
    return schema;
}

std::string pipelineKeysMarkdown() {
    struct Section {
        const char* title;
        const KeyTable& table;
    };
    const Section sections[] = {
        {"Document", pipelineKeys()},   {"Fallbacks", fallbackKeys()},  {"Target", targetKeys()},
        {"Block", blockKeys()},         {"Option", optionKeys()},       {"Choice", choiceKeys()},
        {"Flow", flowKeys()},           {"Flow file", flowFileKeys()},  {"Stage", stageKeys()},
        {"Queue", queueKeys()},         {"Edit: insert", insertKeys()}, {"Edit: replace", replaceKeys()},
        {"Edit: remove", removeKeys()},
    };
    std::string result;
    for (const Section& section : sections) {
        result += fmt::format("### {}\n\n| Key | Type | Default | Meaning |\n|---|---|---|---|\n", section.title);
        for (const KeySpec& spec : section.table.keys)
            result += fmt::format("| `{}` | {} | {} | {} |\n", spec.key, cell(keyTypeName(spec)),
                                  spec.required ? "required" : spec.defaultText, cell(spec.help));
        result += '\n';
    }
    return result;
}

}  // namespace crevice
