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
    std::optional<long long> value;  ///< When it does not depend on any macro from outside.
    bool tooDeep = false;            ///< Brackets or signs nest deeper than any author writes.
};

/// What Cocos' compiler keeps of a condition.
struct KeptNames {
    std::vector<std::string> needs;     ///< "USE_X", "!USE_Y": what it notes of lines that stand under the condition.
    std::vector<std::string> compared;  ///< Macros from outside in front of == < > and the like: they are numbers.
};

/// What a name in a condition stands for.
struct ConditionName {
    std::optional<long long> value;  ///< A number.
    bool outside = true;             ///< A macro whose value comes from outside: it is kept in lists.
    std::vector<std::string> alias;  ///< Other names it stands for, in their place.
};
/// `isValue` is false for a name that is only asked whether it is defined.
using NameLookup = std::function<ConditionName(std::string_view name, bool isValue)>;

/// The expression of an #if or #elif; `__VERSION__` is 450. Every name is looked up. Malformed expressions give an
/// unknown value: the compiler reports them where they matter.
Condition readCondition(std::string_view expression, const NameLookup& lookup);

/// Cocos' compiler does not parse: of every word between blanks it takes the first name, with `!` when the word begins
/// so; a word `||` leaves nothing; a word of `<`, `=`, `>` makes the name before it a number.
KeptNames keepNames(std::string_view expression, const NameLookup& lookup);

/// The needs of the other branch: each name turned round.
std::vector<std::string> turnRound(const std::vector<std::string>& needs);

/// True or false when `__VERSION__` (450) and numbers alone decide an expression.
std::optional<bool> decideByVersion(std::string_view expression);

}  // namespace crevice::cocos
