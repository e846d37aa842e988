// The walk that makes one text of a stage: its state, and what its two halves share.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "cocos/flatten/CallBranches.h"
#include "cocos/flatten/FlatOutput.h"
#include "cocos/flatten/MacroChoices.h"
#include "cocos/flatten/MacroTable.h"
#include "cocos/text/IncludedTexts.h"
#include "cocos/text/MacroCall.h"

namespace crevice::cocos {

constexpr std::size_t kMaxLooked = 16u << 20;  ///< Bytes of macros' bodies that are looked through, of a stage.

class Flattener : private FlatOutput {
public:
    Flattener(const EffectAsset& effect, ChunkLibrary& chunks, const FlattenLimits& limits, Problems& problems)
        : effect_(effect), chunks_(chunks), limits_(limits), problems_(problems) {}

    Flattened run(const std::string& program, const SourceLoc& where);

private:
    void emit(const SourceText& source);
    std::size_t emitLine(const SourceLines& lines, std::size_t at);
    void noteChoice(const MacroDefinition& macro, Origin origin);

    /// A preprocessor line in one piece: of a text, or of a macro's body.
    void emitDirective(std::string_view text, Origin origin, const SourceText& source);

    void emitDefinition(const SourceLines& lines, std::size_t at, const MacroDefinition& macro);

    void include(std::string_view rest, std::string_view line, Origin origin, const SourceText& source);

    /// A chunk that includes itself vanishes like any second include, but it is a mistake; the engine's are let pass.
    bool reportCycle(const SourceText& target, std::string_view line, Origin origin);

    void pragma(std::string_view rest, std::string_view line, Origin origin);

    /// A line of output that is being put together.
    struct Pending {
        std::string text;
        Origin origin{};
    };

    /// A place among the lines that are read.
    struct Cursor {
        std::size_t line = 0, column = 0;
    };

    /// Expands the calls of line `at`, whose arguments may reach over the next ones. Returns the number of lines used.
    std::size_t expandLine(const CodeLines& lines, std::size_t at, Pending& pending);
    /// Expands the call of a macro whose name ends at the cursor, which goes behind the call. False: no call.
    bool expandCall(const CodeLines& lines, Cursor& cursor, std::string_view name, Pending& pending);
    bool expandDefinition(const CodeLines& lines, Cursor& cursor, const MacroDefinition& macro, Pending& pending);
    /// Arguments behind the cursor. A call that cannot be one is text: GLSL's preprocessor is to refuse it in the
    /// variant that holds it.
    CallArguments takeArguments(const CodeLines& lines, Cursor cursor, std::string_view name);
    /// Writes a call that conditions cross once for each branch of the first of them. False: it is text.
    bool expandBranches(const CodeLines& lines, Cursor& cursor, std::string_view name, const SourceText& source,
                        Pending& pending);
    /// A macro whose name a body ended in: what stands behind the call is its list.
    std::string_view trailingName(const Pending& pending) const;

    bool isOpenChoice(std::string_view name) const {
        return choices_.isOpen(name, places_) && std::find(active_.begin(), active_.end(), name) == active_.end();
    }

    /// The definition that holds here; null where none does. Only `#pragma define` holds in front of its line.
    const MacroDefinition* definitionOf(std::string_view name) const;

    /// Ends what an #undef ends.
    void undefine(std::string_view name, Origin origin, const SourceText& source);

    /// endsStatements(), with the macros that are written out.
    bool isStatements(const MacroDefinition& macro) const;
    /// Follows `#define F G` to G: a call of F is one of G.
    std::string_view calledBy(std::string_view name) const;

    enum class Visited : std::uint8_t { Found, Enter, PassOver };
    /// Visits the macros to be expanded that a text names, and those that the bodies of entered ones name, each once.
    /// True when `visit` found what it looks for; false too when a stage's macros are too large to look through.
    template <class Visit>
    bool visitCalls(std::string_view text, std::unordered_set<std::string_view>& seen, Visit visit);

    /// Adds the macros whose definition is not chosen and that a text leads to, through others' bodies too.
    bool addOpenChoices(std::string_view text, std::vector<std::string_view>& names,
                        std::unordered_set<std::string_view>& seen);

    /// Does the macro stand for a declaration or the head of one?
    bool isHeadChoice(std::string_view name);

    /// The head that a condition chooses, where the macro is one or its body ends behind one. Empty when there is none.
    std::string_view chosenHeadOf(std::string_view name);

    /// A declaration whose head a condition chooses is written whole for each head: of one in pieces nobody could tell
    /// what it declares. Not found where several heads in one would multiply the text.
    StatementRest restOfDeclaration(const CodeLines& lines, Cursor from);

    /// True when the call that begins where `pending` ends begins a statement.
    bool beginsStatement(const Pending& pending) const;

    /// Calls `write` for each definition of the macro, in branches of one condition, and with null for the branch that
    /// remains where none may hold.
    void writeEach(std::string_view name, Origin origin, const std::function<void(const MacroDefinition*)>& write);

    /// What the line that is being put together has of the present statement; the rest is written.
    std::string takeHead(Pending& pending);

    /// Writes the call of a macro whose definition a condition chooses once for each: a line of code may be broken
    /// anywhere. The cursor goes from behind its name to behind the call. False: it is text.
    bool expandChoices(const CodeLines& lines, Cursor& cursor, std::string_view name, Pending& pending);

    /// Writes a declaration with its chosen head once for each.
    void expandDeclaration(std::string_view head, const StatementRest& rest, Origin origin, Pending& pending);

    /// True when the body ends in the name of a macro that brackets behind the call may call.
    bool endsInName(const MacroDefinition& macro) const;
    /// One of the definitions: those without parameters leave the brackets standing, those with them need brackets.
    bool expandChoice(const MacroDefinition& macro, const CallArguments& arguments, Origin origin, Pending& pending);

    /// Arguments are expanded before they are put in, but for those of a body that pastes.
    void expandArguments(const MacroDefinition& macro, std::vector<std::string>& arguments, Origin origin);

    /// Writes a macro's body. True when its last line was a preprocessor line.
    bool expand(const MacroDefinition& macro, const std::vector<std::string>& given, Origin call, Pending& pending);

    /// True when the last line was a preprocessor line. The first one goes on where `pending` is, if not `apart`.
    bool writeLines(const BodyLines& lines, Pending& pending, const SourceText& source, bool apart);

    void flush(Pending& pending) {
        if (!trimBlank(pending.text).empty()) push(pending.text, pending.origin);
        pending.text.clear();
    }

    void push(std::string_view line, Origin origin);
    void stopExpanding(const MacroDefinition& macro);
    void stop(std::string_view line, Origin origin, std::string message,
              std::string help = "includes or macros grow without end");

    const EffectAsset& effect_;
    ChunkLibrary& chunks_;
    const FlattenLimits& limits_;
    Problems& problems_;
    const MacroTable* table_ = nullptr;
    std::unordered_map<std::string_view, const MacroDefinition*> latest_;  ///< As the text has defined them so far.
    MacroChoices choices_;
    DefinedPlaces places_;
    IncludedTexts included_;
    std::vector<const SourceText*> stack_;
    std::vector<std::string_view> active_;  ///< Macros being expanded: they are not expanded within themselves.
    std::string* captured_ = nullptr;       ///< What is written is an argument that goes into a macro's body.
    std::optional<Origin> expandedFrom_;    ///< The author's call that writes the present lines.
    SourceLoc callPlace_;                   ///< Of that call.
    std::size_t includes_ = 0, expansions_ = 0, written_ = 0, looked_ = 0, argumentDepth_ = 0;
    std::size_t branchDepth_ = 0;
    std::size_t alternatives_ = 0;  ///< That the outermost call with a chosen definition has led to so far.
    std::size_t refused_ = 0;       ///< Bytes of calls that turned out to be none.
    struct {
        std::size_t expansions = 0, written = 0;
    } before_;  ///< The counts before that call.
    std::uint32_t file_ = 0;
    bool endedInDirective_ = false;  ///< What the line expanded last ended in.
    bool stopped_ = false;
};

template <class Visit>
bool Flattener::visitCalls(std::string_view text, std::unordered_set<std::string_view>& seen, Visit visit) {
    std::vector<std::string_view> waiting{text};
    while (!waiting.empty()) {
        const std::string_view next = waiting.back();
        waiting.pop_back();
        looked_ += next.size();
        if (looked_ > kMaxLooked) return false;
        for (std::size_t at = 0; (at = table_->findCall(next, at)) != std::string_view::npos;) {
            const std::string_view call = leadingName(next.substr(at));
            at += call.size();
            if (!seen.insert(call).second) continue;
            const Visited visited = visit(call);
            if (visited == Visited::Found) return true;
            if (visited == Visited::PassOver) continue;
            const auto enter = [&](const MacroDefinition& macro) {
                for (const auto& part : macro.body) waiting.push_back(part.text);
            };
            if (isOpenChoice(call)) {
                for (const auto& choice : choices_.of(call)) enter(*choice.macro);
            } else if (const MacroDefinition* macro = definitionOf(call)) {
                enter(*macro);
            }
        }
    }
    return false;
}

}  // namespace crevice::cocos
