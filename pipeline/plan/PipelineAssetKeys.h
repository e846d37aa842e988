// The keys of every kind of object in a pipeline document, listed once: for reading, for the JSON Schema and for the
// docs.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/Document.h"

namespace crevice {

/// NumberOrOption is read before options have their values: "$option" stands as it is written.
enum class KeyKind {
    Bool,
    Condition,
    Integer,
    Number,
    NumberOrOption,
    Text,
    Choice,
    Object,
    Array,
    ObjectOrArray,
    NumberOrArray,
    Any
};

struct KeySpec {
    const char* key;
    KeyKind kind;
    const char* help;
    bool required = false;
    double min = -std::numeric_limits<double>::infinity();  ///< Inclusive, unless `exclusiveMin`.
    double max = std::numeric_limits<double>::infinity();
    bool exclusiveMin = false;
    std::vector<std::string> (*names)() = nullptr;  ///< Choice: the words allowed.
    const char* schema = nullptr;                   ///< JSON Schema text where `kind` does not say enough.
    const char* type = nullptr;                     ///< Type as the docs show it, where `kind` does not say enough.
    const char* defaultText = "";                   ///< For the docs.
};

/// The keys of one kind of object.
struct KeyTable {
    const char* object;  ///< "target": as messages name it
    std::span<const KeySpec> keys;

    const KeySpec* find(std::string_view key) const;
    std::vector<std::string> names() const;
};

const KeyTable& pipelineKeys();
const KeyTable& fallbackKeys();
const KeyTable& targetKeys();
const KeyTable& blockKeys();
const KeyTable& optionKeys();
const KeyTable& choiceKeys();
const KeyTable& flowKeys();
const KeyTable& flowFileKeys();
const KeyTable& stageKeys();
const KeyTable& queueKeys();
const KeyTable& insertKeys();
const KeyTable& replaceKeys();
const KeyTable& removeKeys();

/// Words of the enums that documents use.
std::vector<std::string> formatNames();
std::vector<std::string> profileNames();
std::vector<std::string> samplerNames();
std::vector<std::string> sortNames();
std::vector<std::string> optionTypeNames();

/// Type of a key in words: "number", "one of a, b".
std::string keyTypeName(const KeySpec& spec);

/// Checks an object against a table when it is made (type, unknown keys, missing keys, value types and ranges: each a
/// problem of its own) and then hands out the values that were right.
class ObjectReader {
public:
    /// `what` names the object in messages: "target 'cc_ssaoMap'".
    ObjectReader(const Value& object, const KeyTable& table, std::string what, Problems& problems);

    /// The value when the key is present and well typed, else null.
    const Value* get(std::string_view key) const;
    std::string text(std::string_view key, std::string otherwise = {}) const;
    bool flag(std::string_view key, bool otherwise) const;
    std::optional<double> number(std::string_view key) const;
    std::optional<int> integer(std::string_view key) const;
    bool isObject() const { return object_ != nullptr; }
    /// Whether an unknown key was reported that looks like this one: that it is missing need not be said as well.
    bool isMisspelt(std::string_view key) const;
    const std::string& what() const { return what_; }

private:
    void check(const Member& member, const KeySpec& spec, Problems& problems);

    const Value* object_ = nullptr;
    std::string what_;
    std::vector<std::string> bad_, misspelt_;
};

/// Whether a stage is an object with a class and a good name, and a flow one with a name and, if any, an array of
/// stages: what merging and edits rely on. Reports what is wrong.
bool checkStageShape(const Value& stage, const std::string& what, Problems& problems);
bool checkFlowShape(const Value& flow, const std::string& what, Problems& problems);

/// Names of targets, stages and options: letters, digits, '_' and '-', not beginning with a digit or '-'.
bool isPlainName(std::string_view name);

}  // namespace crevice
