// The node of a document: construction, access by key, and writing as JSON text.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/Document.h"

namespace crevice {
namespace {

constexpr double kLargestExactInteger = 9007199254740992.0;  // 2^53: doubles beyond skip whole numbers

void writeString(std::string& out, std::string_view text) {
    out += '"';
    for (const char c : text) {
        switch (c) {
            case '"':
                out += "\\\"";
                break;
            case '\\':
                out += "\\\\";
                break;
            case '\n':
                out += "\\n";
                break;
            case '\r':
                out += "\\r";
                break;
            case '\t':
                out += "\\t";
                break;
            default:
                if (static_cast<unsigned char>(c) < 0x20) {
                    out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
                } else {
                    out += c;
                }
        }
    }
    out += '"';
}

void writeNumber(std::string& out, const Value& value) {
    if (value.isInteger()) {
        out += fmt::format("{}", value.integer());
        return;
    }
    assert(std::isfinite(value.number()));
    const std::string text = fmt::format("{}", value.number());
    out += text;
    if (text.find_first_of(".e") == std::string::npos) out += ".0";
}

void writeLineBreak(std::string& out, int indent, int depth) {
    if (indent < 0) return;
    out += '\n';
    out.append(static_cast<std::size_t>(indent) * static_cast<std::size_t>(depth), ' ');
}

void writeValue(std::string& out, const Value& value, int indent, int depth);

/// Arrays without arrays or objects inside stay on one line: vectors and lists of names read best so.
void writeArray(std::string& out, const Value& value, int indent, int depth) {
    const bool flat = std::none_of(value.items().begin(), value.items().end(),
                                   [](const Value& item) { return item.isArray() || item.isObject(); });
    out += '[';
    bool first = true;
    for (const Value& item : value.items()) {
        if (!first) out += flat && indent >= 0 ? ", " : ",";
        if (!flat) writeLineBreak(out, indent, depth + 1);
        writeValue(out, item, indent, depth + 1);
        first = false;
    }
    if (!flat) writeLineBreak(out, indent, depth);
    out += ']';
}

void writeObject(std::string& out, const Value& value, int indent, int depth) {
    out += '{';
    bool first = true;
    for (const Member& member : value.members()) {
        if (!first) out += ',';
        writeLineBreak(out, indent, depth + 1);
        writeString(out, member.key);
        out += indent >= 0 ? ": " : ":";
        writeValue(out, member.value, indent, depth + 1);
        first = false;
    }
    if (!value.members().empty()) writeLineBreak(out, indent, depth);
    out += '}';
}

void writeValue(std::string& out, const Value& value, int indent, int depth) {
    switch (value.type()) {
        case Value::Type::Null:
            out += "null";
            break;
        case Value::Type::Bool:
            out += value.boolean() ? "true" : "false";
            break;
        case Value::Type::Number:
            writeNumber(out, value);
            break;
        case Value::Type::String:
            writeString(out, value.string());
            break;
        case Value::Type::Array:
            writeArray(out, value, indent, depth);
            break;
        case Value::Type::Object:
            writeObject(out, value, indent, depth);
            break;
    }
}

}  // namespace

bool fitsFloat(double number) { return std::abs(number) <= double(std::numeric_limits<float>::max()); }

Value Value::makeBool(bool value, SourceLoc where) {
    Value v;
    v.type_ = Type::Bool;
    v.bool_ = value;
    v.where_ = std::move(where);
    return v;
}

Value Value::makeNumber(double value, SourceLoc where) {
    const bool whole = std::abs(value) <= kLargestExactInteger && std::trunc(value) == value;
    return whole ? makeInteger(static_cast<std::int64_t>(value), std::move(where)) : makeReal(value, std::move(where));
}

Value Value::makeInteger(std::int64_t value, SourceLoc where) {
    Value v;
    v.type_ = Type::Number;
    v.integer_ = true;
    v.integerValue_ = value;
    v.number_ = static_cast<double>(value);
    v.where_ = std::move(where);
    return v;
}

Value Value::makeReal(double value, SourceLoc where) {
    Value v;
    v.type_ = Type::Number;
    v.number_ = value;
    v.where_ = std::move(where);
    return v;
}

Value Value::makeString(std::string value, SourceLoc where) {
    Value v;
    v.type_ = Type::String;
    v.string_ = std::move(value);
    v.where_ = std::move(where);
    return v;
}

Value Value::makeArray(SourceLoc where) {
    Value v;
    v.type_ = Type::Array;
    v.where_ = std::move(where);
    return v;
}

Value Value::makeObject(SourceLoc where) {
    Value v;
    v.type_ = Type::Object;
    v.where_ = std::move(where);
    return v;
}

bool Value::isInteger() const { return isNumber() && integer_; }

bool Value::boolean() const {
    assert(isBool());
    return bool_;
}

double Value::number() const {
    assert(isNumber());
    return number_;
}

std::int64_t Value::integer() const {
    assert(isInteger());
    return integerValue_;
}

const std::string& Value::string() const {
    assert(isString());
    return string_;
}

const std::vector<Value>& Value::items() const {
    assert(isArray());
    return items_;
}

std::vector<Value>& Value::items() {
    assert(isArray());
    return items_;
}

const std::vector<Member>& Value::members() const {
    assert(isObject());
    return members_;
}

std::vector<Member>& Value::members() {
    assert(isObject());
    return members_;
}

const Value* Value::find(std::string_view key) const {
    assert(isObject());
    const auto found = std::find_if(members_.begin(), members_.end(), [&](const Member& m) { return m.key == key; });
    return found == members_.end() ? nullptr : &found->value;
}

Value* Value::find(std::string_view key) {
    assert(isObject());
    const auto found = std::find_if(members_.begin(), members_.end(), [&](const Member& m) { return m.key == key; });
    return found == members_.end() ? nullptr : &found->value;
}

void Value::set(std::string key, Value value, SourceLoc keyLoc) {
    assert(isObject());
    for (Member& member : members_) {
        if (member.key != key) continue;
        member.keyLoc = std::move(keyLoc);
        member.value = std::move(value);
        return;
    }
    members_.push_back({std::move(key), std::move(keyLoc), std::move(value)});
}

void Value::erase(std::string_view key) {
    assert(isObject());
    std::erase_if(members_, [&](const Member& m) { return m.key == key; });
}

const char* Value::typeName() const {
    switch (type_) {
        case Type::Null:
            return "null";
        case Type::Bool:
            return "a bool";
        case Type::Number:
            return "a number";
        case Type::String:
            return "a string";
        case Type::Array:
            return "a list";
        case Type::Object:
            return "an object";
    }
    return "nothing";
}

std::string Value::toJson(int indent) const {
    std::string out;
    writeValue(out, *this, indent, 0);
    return out;
}

}  // namespace crevice
