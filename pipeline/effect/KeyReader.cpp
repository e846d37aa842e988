// Reads an object key by key and reports the keys nobody asked for.
#include <fmt/format.h>

#include <algorithm>

#include "core/Text.h"
#include "effect/EffectHeader.h"

namespace crevice {

KeyReader::KeyReader(const Value& object, std::string what, EffectReading reading, Problems& problems)
    : object_(object), what_(std::move(what)), reading_(reading), problems_(problems) {}

const Value* KeyReader::find(const char* key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
    return object_.find(key);
}

const Value* KeyReader::typed(const char* key, bool (Value::*is)() const, const char* wanted) {
    const std::string_view kind = wanted;
    const char* example = kind == "a string"        ? "word"
                          : kind == "a number"      ? "1"
                          : kind == "true or false" ? "true"
                          : kind == "a list"        ? "[ … ]"
                                                    : "{ … }";
    const Value* value = find(key);
    if (value == nullptr || (value->*is)()) return value;
    if (!strict() && value->isNull()) return nullptr;  // `properties:` with nothing behind it.
    if (!strict() && kind != "a list" && kind != "a map") {
        problems_.warning(value->where(),
                          fmt::format("'{}' of {} is {}: it is not read", key, what_, value->typeName()),
                          fmt::format("write {}: {}", key, example));
        return nullptr;
    }
    problems_.error(value->where(), fmt::format("'{}' of {} must be {}, not {}", key, what_, wanted, value->typeName()),
                    fmt::format("write {}: {}", key, example));
    return nullptr;
}

const Value* KeyReader::string(const char* key) { return typed(key, &Value::isString, "a string"); }
const Value* KeyReader::number(const char* key) { return typed(key, &Value::isNumber, "a number"); }
const Value* KeyReader::boolean(const char* key) { return typed(key, &Value::isBool, "true or false"); }
const Value* KeyReader::array(const char* key) { return typed(key, &Value::isArray, "a list"); }
const Value* KeyReader::object(const char* key) { return typed(key, &Value::isObject, "a map"); }

void KeyReader::finish() {
    for (const Member& member : object_.members()) {
        if (std::find(known_.begin(), known_.end(), member.key) != known_.end()) continue;
        SourceLoc where = member.keyLoc;
        where.length = std::max(1, static_cast<int>(member.key.size()));
        if (!strict()) {
            const std::string message = fmt::format("key '{}' in {} is not read", member.key, what_);
            // Beside the editor's keys stand many; one among a pass' states was meant to have an effect.
            if (what_.find("property") == std::string::npos)
                problems_.note(where, message);
            else
                problems_.verbose(where, message);
            continue;
        }
        problems_.error(where, fmt::format("unknown key '{}' in {}", member.key, what_),
                        didYouMean(member.key, known_, "keys"));
    }
}

}  // namespace crevice
