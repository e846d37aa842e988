// Collects the fields of a parameter set as rows for documentation and as JSON Schema.
#include <cassert>
#include <charconv>

#include <fmt/format.h>

#include "core/ParamText.h"
#include "core/Params.h"
#include "core/Text.h"

namespace crevice {
namespace {

Value numberSchema(const char* type, const ParamRange& range) {
    Value schema = Value::makeObject();
    schema.set("type", Value::makeString(type));
    if (range.showMin) schema.set("minimum", Value::makeNumber(range.min));
    if (range.showMax) schema.set("maximum", Value::makeNumber(range.max));
    return schema;
}

std::string describeField(const FieldInfo& info) {
    const std::string help = info.help;
    const std::string unit = info.unit;
    if (unit.empty()) return help;
    return help.empty() ? fmt::format("In {}.", unit) : fmt::format("{} In {}.", help, unit);
}

ParamRow makeRow(const char* key, std::string type, const Value& defaultValue, const ParamRange& range,
                 const FieldInfo& info, Value schema) {
    schema.set("default", defaultValue);
    if (const std::string text = describeField(info); !text.empty()) {
        schema.set("description", Value::makeString(text));
    }
    return {key, std::move(type), defaultValue.toJson(0), range.text(), info.unit, info.help, std::move(schema)};
}

ParamRow vectorRow(const char* key, const float* values, int count, const FieldInfo& info) {
    const ParamRange range = rangeOf<float>(info);
    Value defaults = Value::makeArray();
    for (int i = 0; i < count; ++i) defaults.items().push_back(Value::makeNumber(tidyDouble(values[i])));
    Value schema = Value::makeObject();
    schema.set("type", Value::makeString("array"));
    schema.set("items", numberSchema("number", range));
    schema.set("minItems", Value::makeNumber(count));
    schema.set("maxItems", Value::makeNumber(count));
    return makeRow(key, fmt::format("vec{}", count), defaults, range, info, std::move(schema));
}

Value typeSchema(const char* type) {
    Value schema = Value::makeObject();
    schema.set("type", Value::makeString(type));
    return schema;
}

}  // namespace

std::string numberText(float value) { return fmt::format("{}", value); }
std::string numberText(double value) { return fmt::format("{}", value); }
std::string numberText(std::int32_t value) { return fmt::format("{}", value); }
std::string numberText(std::uint32_t value) { return fmt::format("{}", value); }

std::string vectorText(const float* values, int count) {
    std::vector<std::string> words;
    for (int i = 0; i < count; ++i) words.push_back(numberText(values[i]));
    return fmt::format("[{}]", join(words));
}

double tidyDouble(float value) {
    const std::string text = numberText(value);
    double tidy = value;
    std::from_chars(text.data(), text.data() + text.size(), tidy);
    return tidy;
}

std::string ParamRange::text() const {
    if (showMin && showMax) return fmt::format("{} … {}", numberText(min), numberText(max));
    if (showMin) return fmt::format("≥ {}", numberText(min));
    if (showMax) return fmt::format("≤ {}", numberText(max));
    return {};
}

std::string ParamRange::help(const std::string& unit) const {
    std::string text = fmt::format("write a number from {} to {}", numberText(min), numberText(max));
    if (showMin && !showMax) text = "write a number of at least " + numberText(min);
    if (!showMin && showMax) text = "write a number of at most " + numberText(max);
    return unit.empty() ? text : text + ", in " + unit;
}

void ParamTable::field(const char* key, bool& value, const FieldInfo& info) {
    rows_.push_back(makeRow(key, "bool", Value::makeBool(value), {}, info, typeSchema("boolean")));
}

void ParamTable::field(const char* key, std::int32_t& value, const FieldInfo& info) {
    const ParamRange range = rangeOf<std::int32_t>(info);
    rows_.push_back(makeRow(key, "int", Value::makeInteger(value), range, info, numberSchema("integer", range)));
}

void ParamTable::field(const char* key, std::uint32_t& value, const FieldInfo& info) {
    const ParamRange range = rangeOf<std::uint32_t>(info);
    rows_.push_back(makeRow(key, "uint", Value::makeInteger(value), range, info, numberSchema("integer", range)));
}

void ParamTable::field(const char* key, float& value, const FieldInfo& info) {
    const ParamRange range = rangeOf<float>(info);
    rows_.push_back(
        makeRow(key, "float", Value::makeNumber(tidyDouble(value)), range, info, numberSchema("number", range)));
}

void ParamTable::field(const char* key, glm::vec2& value, const FieldInfo& info) {
    rows_.push_back(vectorRow(key, &value[0], 2, info));
}
void ParamTable::field(const char* key, glm::vec3& value, const FieldInfo& info) {
    rows_.push_back(vectorRow(key, &value[0], 3, info));
}
void ParamTable::field(const char* key, glm::vec4& value, const FieldInfo& info) {
    rows_.push_back(vectorRow(key, &value[0], 4, info));
}

void ParamTable::field(const char* key, std::string& value, const FieldInfo& info) {
    rows_.push_back(makeRow(key, "string", Value::makeString(value), {}, info, typeSchema("string")));
}

void ParamTable::choice(const char* key, int& value, std::span<const char* const> names, const FieldInfo& info) {
    assert(value >= 0 && static_cast<std::size_t>(value) < names.size());
    const std::vector<std::string> choices(names.begin(), names.end());
    Value schema = Value::makeObject();
    Value words = Value::makeArray();
    for (const std::string& name : choices) words.items().push_back(Value::makeString(name));
    schema.set("enum", std::move(words));
    const Value present = Value::makeString(choices[static_cast<std::size_t>(value)]);
    rows_.push_back(makeRow(key, join(choices, " | "), present, {}, info, std::move(schema)));
}

Value ParamTable::schema() const {
    Value properties = Value::makeObject();
    for (const ParamRow& row : rows_) properties.set(row.key, row.schema);
    Value schema = typeSchema("object");
    schema.set("additionalProperties", Value::makeBool(false));
    schema.set("properties", std::move(properties));
    return schema;
}

}  // namespace crevice
