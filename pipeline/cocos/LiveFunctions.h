// Functions that a program's entry cannot reach: Cocos' compiler drops them before it looks for macros, and so do we.
#pragma once

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace crevice::cocos {

/// A function's definition in a text: from its return type to behind its brace, in bytes and in lines counted from 0.
struct FunctionRange {
    std::string_view name;
    std::size_t begin = 0, end = 0;
    std::size_t firstLine = 0, lastLine = 0;
    bool defines = false;  ///< A macro, which holds behind it too: it counts as called.
};

/// Bodies of the macros that a text leaves to GLSL's preprocessor, by name.
using MacroBodies = std::unordered_map<std::string_view, std::vector<std::string_view>>;

/// The functions that neither `entry` nor main() leads to, by name and through macros, in text order. Conditions are
/// not evaluated: a call in any branch counts. Empty where that cannot be told: without the entry, when a condition
/// begins in one function and ends in another, when names are pasted together.
std::vector<FunctionRange> findDeadFunctions(std::string_view text, std::string_view entry, const MacroBodies& macros);

}  // namespace crevice::cocos
