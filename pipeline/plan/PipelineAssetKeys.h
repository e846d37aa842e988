// The keys of every kind of object in a pipeline document, listed once: for reading, for the JSON Schema and for the
// docs.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

}  // namespace crevice
