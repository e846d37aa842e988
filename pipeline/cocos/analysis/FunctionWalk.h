// Finds the functions of a GLSL text that still has its preprocessor lines.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "cocos/analysis/LiveFunctions.h"

namespace crevice::cocos {

inline bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Behind the preprocessor line that begins at `at`, with its continuations; its newline is left.
std::size_t lineEnd(std::string_view text, std::size_t at);

/// Adds what stands behind the name in each #define of the text, parameters included.
void addDefinesOf(std::string_view text, MacroBodies& macros);

/// Those of the #defines whose every body ends in a function's: a ';' behind their call ends nothing.
std::unordered_set<std::string_view> findFunctionMakers(const MacroBodies& defines);

/// A condition is the number 0 or 1.
bool hasNever(std::string_view text);
/// The text with blanks for what stands behind `#if 0`, and behind `#if 1` in the other branches.
std::string withoutNever(std::string_view text);

/// True when every macro closes as many brackets as it opens: the brackets of the text are those of the program.
bool keepBrackets(const MacroBodies& macros);

/// Definitions of functions whose every word is understood: qualifiers, a type, a name that is no macro, a list in
/// parentheses and then a body, outside of all braces. Whatever else has a body is passed over.
class FunctionWalk {
public:
    FunctionWalk(std::string_view text, const MacroBodies& macros, const std::unordered_set<std::string_view>& makers)
        : text_(text), macros_(macros), makers_(makers) {}

    /// False when braces and conditions do not come out even. Where they cross in a function, it counts as called.
    bool run();

    std::vector<FunctionRange> functions;
    std::vector<std::size_t> emptyStatements;  ///< Each a ';' behind a function's body or another ';'.

private:
    static constexpr std::size_t kMaxAliasDepth = 4;
    using Accepts = bool (*)(std::string_view word);
    using Answers = std::array<std::unordered_map<std::string_view, bool>, kMaxAliasDepth>;

    struct Depth {
        int brace = 0, paren = 0;
        bool operator==(const Depth&) const = default;
    };

    bool take(char c);
    bool isHead() const;
    void begin();
    void end(std::size_t at);
    bool takeDirective();
    void noteUnfinished(std::size_t directive, bool turns);
    void finishStatement();
    bool standsFor(Accepts accepts, Answers& answers, std::string_view word, std::size_t depth);
    std::size_t offsetOf(std::string_view part) const { return static_cast<std::size_t>(part.data() - text_.data()); }

    std::string_view text_;
    const MacroBodies& macros_;
    const std::unordered_set<std::string_view>& makers_;
    std::size_t at_ = 0, paren_ = 0;
    std::size_t directiveEnd_ = 0;    ///< Of the last preprocessor line outside of braces and parentheses.
    std::size_t statementBegin_ = 0;  ///< Behind what ended the last statement outside of braces.
    Depth depth_;
    std::vector<Depth> branches_;  ///< Depths at the #if of each enclosing condition.
    std::size_t branchesAtBegin_ = 0;
    std::size_t unfinishedIn_ = 0;  ///< How many conditions must be open for `unfinished_` to outlast a statement.
    char last_ = '\0';
    bool isOpen_ = false;
    bool isBody_ = false;      ///< The braces are a function's, be it understood or not.
    bool ended_ = false;       ///< What stood before was a function's body or a statement.
    bool unfinished_ = false;  ///< A preprocessor line stood in the middle of the statement.
    bool definesInList_ = false;
    Answers types_, qualifiers_;  ///< What is known of macros, by the depth at which they were met.
};

}  // namespace crevice::cocos
