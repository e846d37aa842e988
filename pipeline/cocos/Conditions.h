// The expressions behind #if: what version 450 decides of them, which macros they test, what a metadata list keeps.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crevice::cocos {

/// A condition, or a part of one.
struct Condition {
    std::optional<long long> value;     ///< When it does not depend on any macro from outside.
    std::vector<std::string> needs;     ///< All of these must hold: "USE_X", "!USE_Y". Only simple names are kept.
    bool tooDeep = false;               ///< Brackets or signs nest deeper than any author writes.
    std::vector<std::string> negated;   ///< The same for the condition's opposite; empty when nothing simple says it.
    std::vector<std::string> compared;  ///< Macros from outside that == < > and the like compare: they are numbers.
};

/// What a name in a condition stands for.
struct ConditionName {
    std::optional<long long> value;  ///< A number.
    bool outside = true;             ///< A macro whose value comes from outside: it is kept in lists.
    std::vector<std::string> alias;  ///< Other names it stands for, in their place.
};
/// `isValue` is false for a name that is only asked whether it is defined.
using NameLookup = std::function<ConditionName(std::string_view name, bool isValue)>;

/// The expression of an #if or #elif. A comparison counts as its names; of `||` nothing is kept; `__VERSION__` is 450.
/// Malformed expressions give an unknown value without needs: the compiler reports them where they matter.
Condition readCondition(std::string_view expression, const NameLookup& lookup);

/// The opposite, for #else.
Condition negate(const Condition& condition);

/// True or false when `__VERSION__` (450) and numbers alone decide an expression.
std::optional<bool> decideByVersion(std::string_view expression);

}  // namespace crevice::cocos
