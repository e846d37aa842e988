// The parts of a macro's call: its arguments over several lines, its body with the arguments put in.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "cocos/text/SourceText.h"
#include "effect/Includes.h"

namespace crevice::cocos {

/// The lines of a program or chunk.
struct SourceLines {
    const SourceText& source;
    std::uint32_t file = 0;
    std::size_t size() const { return source.lines.size(); }
    std::string_view text(std::size_t i) const { return source.lines[i].text; }
    FlatSource::Origin origin(std::size_t i) const { return {file, source.lines[i].line}; }
};

/// The lines of a macro's body with its arguments.
struct BodyLines {
    std::vector<std::string> texts;
    std::vector<FlatSource::Origin> origins;
    std::size_t size() const { return texts.size(); }
    std::string_view text(std::size_t i) const { return texts[i]; }
    FlatSource::Origin origin(std::size_t i) const { return origins[i]; }
};

/// All of one place.
BodyLines splitLines(std::string_view text, FlatSource::Origin origin);

/// Lines of either kind.
class CodeLines {
public:
    CodeLines(const SourceLines& lines) : ofSource_(&lines) {}
    CodeLines(const BodyLines& lines) : ofBody_(&lines) {}
    std::size_t size() const { return ofSource_ != nullptr ? ofSource_->size() : ofBody_->size(); }
    std::string_view text(std::size_t i) const { return ofSource_ != nullptr ? ofSource_->text(i) : ofBody_->text(i); }
    FlatSource::Origin origin(std::size_t i) const {
        return ofSource_ != nullptr ? ofSource_->origin(i) : ofBody_->origin(i);
    }
    /// A body: what it leaves open goes on behind its call.
    bool isBody() const { return ofBody_ != nullptr; }

private:
    const SourceLines* ofSource_ = nullptr;
    const BodyLines* ofBody_ = nullptr;
};

struct CallArguments {
    enum class State {
        None,      ///< No '(' follows the name.
        Found,     ///< The ')' was found.
        Crossing,  ///< A condition does not lie within one argument.
        Cut,       ///< A branch ends before the ')', or another preprocessor line stands in front of it.
        Unclosed   ///< No ')' before the end or the limit.
    };
    State state = State::None;
    bool found() const { return state == State::Found; }
    std::vector<std::string> values;  ///< Conditions between the brackets are lines of their own.
    std::size_t line = 0, end = 0;    ///< Behind the ')'.
    std::size_t bytes = 0;            ///< That were looked at.
};

/// Splits what stands between the brackets at commas outside of inner brackets, one character at a time.
class ArgumentReader {
public:
    /// True while the call is open.
    bool read(std::string_view text, std::size_t& at);
    /// A preprocessor line between the brackets stays a line of its argument. Found while it can.
    CallArguments::State readLine(std::string_view text, LineKind kind);
    bool isOpen() const { return depth_ > 0; }
    /// False when a condition within an argument goes on behind it.
    bool isWhole() const { return whole_ && branches_.empty(); }
    std::size_t bytes() const { return bytes_; }
    std::vector<std::string> take();

private:
    std::vector<std::string> values_{std::string()};
    std::vector<int> branches_;  ///< Brackets open at the #if of each condition.
    int depth_ = 0;
    bool whole_ = true;
    std::size_t bytes_ = 0;
};

/// A line of code without the backslash that joins it to the next: the next may become a preprocessor line. It parts no
/// word (joinParted()).
inline std::string_view withoutSplice(std::string_view code) {
    return code.ends_with('\\') ? code.substr(0, code.size() - 1) : code;
}

/// A preprocessor line with the lines that continue it, without their backslashes; `line` becomes the last of them.
std::string joinContinued(const CodeLines& lines, std::size_t& line);

/// Arguments behind a macro's name, which ends at column `at` of line `line`.
CallArguments readArguments(const CodeLines& lines, std::size_t line, std::size_t at, std::size_t maxBytes);

/// Fits the number of arguments: `f()` gives a macro without parameters none. False when they do not fit.
bool matchArguments(const MacroDefinition& macro, std::vector<std::string>& arguments);

/// Arguments of several lines that a body pastes: there is no line to paste them to.
bool pastesLines(const MacroDefinition& macro, const CallArguments& arguments);

/// An error at the call `where`. `limit` bytes were looked through; 0 = to the end.
void reportUnclosed(std::string_view macro, std::size_t limit, const SourceLoc& where, Problems& problems);
void reportArguments(const MacroDefinition& macro, std::size_t given, const SourceLoc& where, Problems& problems);

/// A preprocessor line over several lines as one, without their backslashes.
std::string joinDirective(const SourceLines& lines, std::size_t first, std::size_t end);

/// A line of a body, with the next ones where a `##` at its end or at their begin pastes them; `line` becomes the last.
std::string joinPasted(const MacroDefinition& macro, std::size_t& line);

/// Parameters replaced by arguments, `##` pasted.
std::string substitute(std::string_view body, const std::vector<std::string_view>& parameters,
                       const std::vector<std::string>& arguments);

/// Whether a body is whole statements, in each of its branches: a `;` behind the call then ends nothing. callsOther:
/// whether a line calls a macro that is written out as well; its own body decides there.
template <class CallsOther>
bool endsStatements(const MacroDefinition& macro, CallsOther callsOther) {
    bool ends = true;
    for (const MacroDefinition::BodyLine& line : macro.body) {
        const std::string_view text = trimBlank(line.text);
        if (text.empty()) continue;
        if (text.front() != '#')
            ends = text.back() == ';' || text.back() == '{' || text.back() == '}' || callsOther(text);
        else if (!ends && !trimBlank(text.substr(1)).starts_with("if"))
            return false;
    }
    return ends;
}

}  // namespace crevice::cocos
