// How many words macros stand for, without expanding them: what would make the compiler's preprocessor run out of
// memory is refused before it starts.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "cocos/text/SourceText.h"
#include "effect/Includes.h"

namespace crevice::cocos {

/// The size of a call grows linearly with the sizes of its arguments: constant + sum of factor × argument. So the size
/// of any nesting follows without writing it out.
class MacroWeights {
public:
    /// That one call, or all calls of a stage's text together, may stand for.
    static constexpr int kMaxWords = 2'000'000;
    /// That one statement may hold: operators count twice. The compiler follows long sums and lists by recursion and
    /// would run out of stack.
    static constexpr int kMaxStatement = 8000;

    /// Of several definitions of a name the heaviest counts.
    void add(const MacroDefinition& macro);

    /// The line of `text`, counted from 1, on which a limit is passed; 0 = nowhere. `macro` is empty when it is that of
    /// a statement.
    int firstTooHeavy(std::string_view text, std::string_view& macro);
    /// The same as an error in the author's file.
    void check(const FlatSource& flat, Problems& problems);

private:
    struct Linear {
        double constant = 0;
        std::vector<double> factors;
    };
    struct Entry {
        std::vector<const MacroDefinition*> definitions;
        Linear weight;
        bool known = false, busy = false, functionLike = false;
    };
    /// Reads a text of words and brackets; see the source.
    struct Scanner;

    const Linear& weightOf(Entry& entry);
    Entry* find(std::string_view name);
    Linear measure(std::string_view text, const std::vector<std::string_view>& parameters);

    std::unordered_map<std::string_view, Entry> entries_;
    int depth_ = 0;
};

}  // namespace crevice::cocos
