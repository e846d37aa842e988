// Objects of a pipeline document, checked against their tables of keys.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/Document.h"
#include "plan/PipelineAssetKeys.h"

namespace crevice {

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
