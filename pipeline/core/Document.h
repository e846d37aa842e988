// A parsed JSON or YAML document as a tree of values, each with the place it was written at.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/Error.h"

namespace crevice {

struct Member;

/// Whether a float holds `number` as something that is finite; false for NaN.
bool fitsFloat(double number);

/// A node of a document. Objects keep the order of their keys. Nothing is converted between string, number and bool.
class Value {
public:
    enum class Type { Null, Bool, Number, String, Array, Object };

    Value() = default;
    static Value makeBool(bool value, SourceLoc where = {});
    /// A whole number of at most 2^53 becomes an integer: makeNumber(3) is what the text `3` reads as.
    static Value makeNumber(double value, SourceLoc where = {});
    static Value makeInteger(std::int64_t value, SourceLoc where = {});
    /// A number that was written with fraction or exponent: never an integer.
    static Value makeReal(double value, SourceLoc where = {});
    static Value makeString(std::string value, SourceLoc where = {});
    static Value makeArray(SourceLoc where = {});
    static Value makeObject(SourceLoc where = {});

    Type type() const { return type_; }
    bool isNull() const { return type_ == Type::Null; }
    bool isBool() const { return type_ == Type::Bool; }
    bool isNumber() const { return type_ == Type::Number; }
    /// A number that was written without fraction or exponent and fits an int64.
    bool isInteger() const;
    bool isString() const { return type_ == Type::String; }
    bool isArray() const { return type_ == Type::Array; }
    bool isObject() const { return type_ == Type::Object; }

    /// Content; the type must match (asserted).
    bool boolean() const;
    double number() const;
    std::int64_t integer() const;
    const std::string& string() const;
    const std::vector<Value>& items() const;
    std::vector<Value>& items();
    const std::vector<Member>& members() const;
    std::vector<Member>& members();

    /// Member by key, or null. Only for objects.
    const Value* find(std::string_view key) const;
    Value* find(std::string_view key);
    /// Replaces or appends a member.
    void set(std::string key, Value value, SourceLoc keyLoc = {});
    void erase(std::string_view key);

    const SourceLoc& where() const { return where_; }
    void setWhere(SourceLoc where) { where_ = std::move(where); }

    /// "string", "number", … as error messages name it: "a string", "an object".
    const char* typeName() const;

    /// JSON text: compact when `indent` < 0. Numbers keep their shortest exact form.
    std::string toJson(int indent = 2) const;

private:
    Type type_ = Type::Null;
    bool bool_ = false;
    bool integer_ = false;
    std::int64_t integerValue_ = 0;
    double number_ = 0;
    std::string string_;
    std::vector<Value> items_;
    std::vector<Member> members_;
    SourceLoc where_;
};

struct Member {
    std::string key;
    SourceLoc keyLoc;
    Value value;
};

/// Limits that keep hostile documents from using unbounded memory.
struct DocumentLimits {
    std::size_t maxBytes = 64u << 20;
    int maxDepth = 200;
    std::size_t maxNodes = 1'000'000;
};

/// Strict JSON (RFC 8259) plus comments. Duplicate keys, NaN and trailing text are errors. Throws Error with
/// file:line:col.
Value parseJson(std::string_view text, const std::string& file, const DocumentLimits& limits = {});

/// YAML 1.2 scalars (`0x1f` is an int, `yes` a string), quoted scalars are strings, `<<` merges, the last anchor of a
/// name wins. `firstLine` is the line of the file on which `text` begins. Throws Error.
Value parseYaml(std::string_view text, const std::string& file, int firstLine = 1, const DocumentLimits& limits = {});

}  // namespace crevice
