// What each kind of value allows, in code and in words.
#include "plan/ObjectReader.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/Text.h"

namespace crevice {
namespace {

bool hasKind(const Value& value, KeyKind kind) {
    switch (kind) {
        case KeyKind::Bool:
            return value.isBool();
        case KeyKind::Condition:
            return value.isBool() || value.isString();
        case KeyKind::Integer:
            return value.isInteger();
        case KeyKind::Number:
            return value.isNumber();
        case KeyKind::NumberOrOption:
            return value.isNumber() || (value.isString() && value.string().starts_with('$'));
        case KeyKind::Text:
        case KeyKind::Choice:
            return value.isString();
        case KeyKind::Object:
            return value.isObject();
        case KeyKind::Array:
            return value.isArray();
        case KeyKind::ObjectOrArray:
            return value.isObject() || value.isArray();
        case KeyKind::NumberOrArray:
            return value.isNumber() || value.isArray();
        case KeyKind::Any:
            return !value.isNull();
    }
    return false;
}

const char* kindWords(KeyKind kind) {
    switch (kind) {
        case KeyKind::Bool:
            return "a bool";
        case KeyKind::Condition:
            return "a bool or a condition such as \"$option\"";
        case KeyKind::Integer:
            return "an integer";
        case KeyKind::Number:
        case KeyKind::NumberOrOption:
            return "a number";
        case KeyKind::Text:
        case KeyKind::Choice:
            return "a string";
        case KeyKind::Object:
            return "an object";
        case KeyKind::Array:
            return "a list";
        case KeyKind::ObjectOrArray:
            return "an object or a list";
        case KeyKind::NumberOrArray:
            return "a number or a list";
        case KeyKind::Any:
            return "a value";
    }
    return "";
}

bool inRange(double number, const KeySpec& spec) {
    const bool aboveMin = spec.exclusiveMin ? number > spec.min : number >= spec.min;
    return aboveMin && number <= spec.max;
}

std::string rangeWords(const KeySpec& spec) {
    if (std::isinf(spec.max)) return fmt::format("write {} or more", spec.min);
    if (spec.exclusiveMin) return fmt::format("write a number above {} and up to {}", spec.min, spec.max);
    return fmt::format("write a number from {} to {}", spec.min, spec.max);
}

}  // namespace

const KeySpec* KeyTable::find(std::string_view key) const {
    for (const KeySpec& spec : keys)
        if (key == spec.key) return &spec;
    return nullptr;
}

std::vector<std::string> KeyTable::names() const {
    std::vector<std::string> names;
    for (const KeySpec& spec : keys) names.push_back(spec.key);
    return names;
}

std::string keyTypeName(const KeySpec& spec) {
    if (spec.type) return spec.type;
    switch (spec.kind) {
        case KeyKind::Bool:
            return "bool";
        case KeyKind::Condition:
            return "bool or condition";
        case KeyKind::Integer:
            return std::isinf(spec.max) ? "integer" : fmt::format("integer, {} … {}", spec.min, spec.max);
        case KeyKind::NumberOrOption:
            return fmt::format("number or \"$option\", {} … {}", spec.min, spec.max);
        case KeyKind::Number:
            if (std::isinf(spec.max)) return "number";
            return spec.exclusiveMin ? fmt::format("number above {}, up to {}", spec.min, spec.max)
                                     : fmt::format("number, {} … {}", spec.min, spec.max);
        case KeyKind::Choice:
            return "one of " + join(spec.names());
        case KeyKind::Text:
            return "string";
        case KeyKind::Object:
            return "object";
        case KeyKind::Array:
            return "list";
        case KeyKind::ObjectOrArray:
            return "object or list";
        case KeyKind::NumberOrArray:
            return "number or list";
        case KeyKind::Any:
            return "any";
    }
    return "";
}

ObjectReader::ObjectReader(const Value& object, const KeyTable& table, std::string what, Problems& problems)
    : what_(std::move(what)) {
    if (!object.isObject()) {
        problems.error(object.where(), fmt::format("{} must be an object, found {}", what_, object.typeName()),
                       "keys: " + join(table.names()));
        return;
    }
    object_ = &object;
    for (const Member& member : object.members()) {
        if (const KeySpec* spec = table.find(member.key)) {
            check(member, *spec, problems);
        } else {
            problems.error(member.keyLoc, fmt::format("unknown key '{}' in {}", member.key, what_),
                           didYouMean(member.key, table.names(), "keys"));
            for (std::string& near : nearestNames(member.key, table.names())) misspelt_.push_back(std::move(near));
        }
    }
    for (const KeySpec& spec : table.keys)
        if (spec.required && !object.find(spec.key) && !isMisspelt(spec.key))
            problems.error(object.where(), fmt::format("missing key '{}' in {}", spec.key, what_),
                           fmt::format("add \"{}\": {}", spec.key, keyTypeName(spec)));
}

bool ObjectReader::isMisspelt(std::string_view key) const {
    return std::find(misspelt_.begin(), misspelt_.end(), key) != misspelt_.end();
}

void ObjectReader::check(const Member& member, const KeySpec& spec, Problems& problems) {
    const Value& value = member.value;
    if (!hasKind(value, spec.kind)) {
        bad_.push_back(member.key);
        problems.error(value.where(),
                       fmt::format("'{}' of {} must be {}, found {}", spec.key, what_, kindWords(spec.kind),
                                   value.isNumber() ? value.toJson(-1) : value.typeName()),
                       fmt::format("expected: {}", keyTypeName(spec)));
    } else if (spec.kind == KeyKind::Choice) {
        const std::vector<std::string> names = spec.names();
        if (std::find(names.begin(), names.end(), value.string()) != names.end()) return;
        bad_.push_back(member.key);
        problems.error(value.where(), fmt::format("unknown {} '{}' in {}", spec.key, value.string(), what_),
                       didYouMean(value.string(), names, spec.key + std::string("s")));
    } else if (value.isNumber() && !inRange(value.number(), spec)) {
        bad_.push_back(member.key);
        problems.error(value.where(), fmt::format("'{}' of {} is {}, out of range", spec.key, what_, value.number()),
                       rangeWords(spec));
    }
}

const Value* ObjectReader::get(std::string_view key) const {
    if (!object_ || std::find(bad_.begin(), bad_.end(), key) != bad_.end()) return nullptr;
    return object_->find(key);
}

std::string ObjectReader::text(std::string_view key, std::string otherwise) const {
    const Value* value = get(key);
    return value ? value->string() : otherwise;
}

bool ObjectReader::flag(std::string_view key, bool otherwise) const {
    const Value* value = get(key);
    return value && value->isBool() ? value->boolean() : otherwise;
}

std::optional<double> ObjectReader::number(std::string_view key) const {
    const Value* value = get(key);
    if (!value) return std::nullopt;
    return value->number();
}

std::optional<int> ObjectReader::integer(std::string_view key) const {
    const Value* value = get(key);
    if (!value) return std::nullopt;
    return static_cast<int>(value->integer());
}

namespace {

/// Reports the unknown keys of an object; whether one of them looks like `key`.
bool reportMisspelt(const Value& object, std::string_view key, const KeyTable& table, const std::string& what,
                    Problems& problems) {
    bool misspelt = false;
    for (const Member& member : object.members()) {
        if (table.find(member.key)) continue;
        problems.error(member.keyLoc, fmt::format("unknown key '{}' in {}", member.key, what),
                       didYouMean(member.key, table.names(), "keys"));
        const std::vector<std::string> near = nearestNames(member.key, table.names());
        misspelt = misspelt || std::find(near.begin(), near.end(), key) != near.end();
    }
    return misspelt;
}

bool checkTextKey(const Value& object, const char* key, const KeyTable& table, const std::string& what,
                  Problems& problems) {
    const Value* value = object.find(key);
    if (!value) {
        if (reportMisspelt(object, key, table, what, problems)) return false;
        problems.error(object.where(), fmt::format("missing key '{}' in {}", key, what),
                       fmt::format("add \"{}\" with a name", key));
        return false;
    }
    if (value->isString() && !value->string().empty()) return true;
    problems.error(value->where(),
                   fmt::format("'{}' of {} must be a name, found {}", key, what,
                               value->isString() ? "an empty string" : value->typeName()),
                   "write a string");
    return false;
}

bool checkIsObject(const Value& value, const std::string& what, Problems& problems) {
    if (!value.isObject())
        problems.error(value.where(), fmt::format("{} must be an object, found {}", what, value.typeName()), "");
    return value.isObject();
}

}  // namespace

bool checkStageShape(const Value& stage, const std::string& what, Problems& problems) {
    if (!checkIsObject(stage, what, problems) || !checkTextKey(stage, "stage", stageKeys(), what, problems))
        return false;
    const Value* name = stage.find("name");
    if (!name) return true;
    if (!checkTextKey(stage, "name", stageKeys(), what, problems)) return false;
    if (isPlainName(name->string())) return true;
    problems.error(name->where(), fmt::format("'{}' cannot name a stage", name->string()),
                   "use letters, digits, '_' and '-', beginning with a letter or '_'");
    return false;
}

bool checkFlowShape(const Value& flow, const std::string& what, Problems& problems) {
    if (!checkIsObject(flow, what, problems) || !checkTextKey(flow, "flow", flowKeys(), what, problems)) return false;
    const Value* stages = flow.find("stages");
    if (!stages || stages->isArray()) return true;
    problems.error(
        stages->where(),
        fmt::format("'stages' of flow '{}' must be a list, found {}", flow.find("flow")->string(), stages->typeName()),
        "write \"stages\": [ { \"stage\": … } ]");
    return false;
}

bool isPlainName(std::string_view name) {
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    if (name.empty() || !isLetter(name[0])) return false;
    return std::all_of(name.begin(), name.end(),
                       [&](char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '-'; });
}

}  // namespace crevice
