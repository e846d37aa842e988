// Functions that a program's entry cannot reach: Cocos' compiler drops them before it looks for macros, and so do we.
#pragma once

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace crevice::cocos {

/// A function's definition in a text: from its return type to behind its brace, in bytes and in lines counted from 0.
/// Without a name a ';' that ends nothing.
struct FunctionRange {
    std::string_view name;
    std::size_t begin = 0, end = 0;
    std::size_t firstLine = 0, lastLine = 0;
    bool stays =
        false;  ///< It defines a macro, which holds behind it too, or a condition goes on: it counts as called.
};

/// What macros may stand for, by name.
using MacroBodies = std::unordered_map<std::string_view, std::vector<std::string_view>>;

/// What else a stage's pragmas and conditions say.
struct LiveHints {
    std::vector<std::string_view> open;  ///< Macros whose value comes from outside and may be any word.
    std::vector<std::size_t> kept;  ///< Lines, counted from 0, ascending: the functions around them count as called.
    std::vector<std::string_view> foreign{};  ///< Words that are errors in the stage.
};

/// The functions that neither `entry` nor main() leads to, by name and through macros, in text order. Conditions are
/// not evaluated: a call in any branch counts, and so does every name in what is not understood. Empty where that
/// cannot be told: without the entry, when brackets do not come out even, when a macro leaves one open. When names are
/// pasted together or come from outside, only those that hold foreign words and that nobody names. `macros` are those
/// that the text does not define itself. Among them in text order what ends nothing: `void f() {};` is common where
/// other compilers are lenient.
std::vector<FunctionRange> findDeadFunctions(std::string_view text, std::string_view entry, const MacroBodies& macros,
                                             const LiveHints& hints = {});

}  // namespace crevice::cocos
