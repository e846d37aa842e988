// Reads the fields of a parameter set from a document's object, with a message for each kind of mistake.
#include "core/Params.h"

#include <algorithm>
#include <type_traits>

#include <fmt/format.h>

#include "core/ParamText.h"
#include "core/Text.h"

namespace crevice {
namespace {

/// How a message shows the value that was found: numbers and words as written, larger things by their kind.
std::string describe(const Value& value) {
    constexpr std::size_t kMaxShown = 40;
    if (value.isNumber() || value.isBool()) return value.toJson(-1);
    if (value.isString() && value.string().size() <= kMaxShown) return "the string '" + value.string() + "'";
    if (value.isArray()) return fmt::format("a list of {}", value.items().size());
    return value.typeName();
}

}  // namespace

ParamReader::ParamReader(const Value& object, std::string what, Problems& problems)
    : object_(object), what_(std::move(what)), problems_(problems) {
    if (object.isObject() || object.isNull()) return;
    problems_.error(object.where(), fmt::format("{} must be an object, found {}", what_, describe(object)),
                    "write { \"key\": value, … }");
}

const Value* ParamReader::lookUp(const char* key) {
    known_.emplace_back(key);
    return object_.isObject() ? object_.find(key) : nullptr;
}

const Value* ParamReader::take(const char* key) { return lookUp(key); }

template <class Number>
void ParamReader::readNumber(const char* key, Number& value, const FieldInfo& info) {
    const Value* found = lookUp(key);
    if (!found) return;
    const auto complain = [&](const std::string& message, const std::string& help) {
        problems_.error(found->where(), fmt::format("'{}' in {} {}", key, what_, message), help);
    };
    constexpr bool kWhole = std::is_integral_v<Number>;
    const ParamRange range = rangeOf<Number>(info).shownFor(found->isNumber() ? found->number() : 0.0);
    if (!found->isNumber()) {
        complain(fmt::format("must be {}, found {}", kWhole ? "a whole number" : "a number", found->typeName()),
                 fmt::format("write a number without quotes, such as \"{}\": {}", key, numberText(value)));
    } else if (kWhole && !found->isInteger()) {
        complain(fmt::format("must be a whole number, found {}", describe(*found)),
                 fmt::format("write it without fraction or exponent, such as \"{}\": {}", key, numberText(value)));
    } else if (!range.holds(found->number())) {
        complain(fmt::format("is {}, outside {}", describe(*found), range.text()), range.help(info.unit));
    } else {
        value = static_cast<Number>(found->number());
    }
}

template <int N, class Vec>
void ParamReader::readVector(const char* key, Vec& value, const FieldInfo& info) {
    const Value* found = lookUp(key);
    if (!found) return;
    const auto complain = [&](const Value& at, const std::string& message, const std::string& help) {
        problems_.error(at.where(), message, help);
    };
    const std::string example =
        fmt::format("write a list of {} numbers, such as \"{}\": {}", N, key, vectorText(&value[0], N));
    if (!found->isArray() || found->items().size() != N) {
        complain(*found,
                 fmt::format("'{}' in {} must be a list of {} numbers, found {}", key, what_, N, describe(*found)),
                 example);
        return;
    }
    const ParamRange range = rangeOf<float>(info);
    Vec read{};
    for (int i = 0; i < N; ++i) {
        const Value& item = found->items()[static_cast<std::size_t>(i)];
        const std::string name = fmt::format("item {} of '{}' in {}", i + 1, key, what_);
        if (!item.isNumber()) {
            complain(item, fmt::format("{} must be a number, found {}", name, item.typeName()), example);
            return;
        }
        if (!range.holds(item.number())) {
            complain(item,
                     fmt::format("{} is {}, outside {}", name, describe(item), range.shownFor(item.number()).text()),
                     range.shownFor(item.number()).help(info.unit));
            return;
        }
        read[i] = static_cast<float>(item.number());
    }
    value = read;
}

void ParamReader::field(const char* key, bool& value, const FieldInfo&) {
    const Value* found = lookUp(key);
    if (!found) return;
    if (found->isBool()) {
        value = found->boolean();
        return;
    }
    problems_.error(found->where(),
                    fmt::format("'{}' in {} must be true or false, found {}", key, what_, describe(*found)),
                    fmt::format("write \"{}\": true or \"{}\": false", key, key));
}

void ParamReader::field(const char* key, std::int32_t& value, const FieldInfo& info) { readNumber(key, value, info); }
void ParamReader::field(const char* key, std::uint32_t& value, const FieldInfo& info) { readNumber(key, value, info); }
void ParamReader::field(const char* key, float& value, const FieldInfo& info) { readNumber(key, value, info); }
void ParamReader::field(const char* key, glm::vec2& value, const FieldInfo& info) { readVector<2>(key, value, info); }
void ParamReader::field(const char* key, glm::vec3& value, const FieldInfo& info) { readVector<3>(key, value, info); }
void ParamReader::field(const char* key, glm::vec4& value, const FieldInfo& info) { readVector<4>(key, value, info); }

void ParamReader::field(const char* key, std::string& value, const FieldInfo&) {
    const Value* found = lookUp(key);
    if (!found) return;
    if (found->isString()) {
        value = found->string();
        return;
    }
    problems_.error(found->where(), fmt::format("'{}' in {} must be a string, found {}", key, what_, describe(*found)),
                    fmt::format("write it in double quotes: \"{}\": \"{}\"", key, value));
}

void ParamReader::choice(const char* key, int& value, std::span<const char* const> names, const FieldInfo&) {
    const Value* found = lookUp(key);
    if (!found) return;
    const std::vector<std::string> choices(names.begin(), names.end());
    if (!found->isString()) {
        problems_.error(found->where(),
                        fmt::format("'{}' in {} must name one of its choices, found {}", key, what_, describe(*found)),
                        "write one of these strings: " + join(choices));
        return;
    }
    const auto match = std::find(choices.begin(), choices.end(), found->string());
    if (match != choices.end()) {
        value = static_cast<int>(match - choices.begin());
        return;
    }
    problems_.error(found->where(), fmt::format("'{}' in {} has no choice '{}'", key, what_, found->string()),
                    didYouMean(found->string(), choices, "choices"));
}

void ParamReader::finish() {
    if (!object_.isObject()) return;
    for (const Member& member : object_.members()) {
        if (std::find(known_.begin(), known_.end(), member.key) != known_.end()) continue;
        problems_.error(member.keyLoc, fmt::format("unknown key '{}' in {}", member.key, what_),
                        didYouMean(member.key, known_, "keys"));
    }
}

}  // namespace crevice
