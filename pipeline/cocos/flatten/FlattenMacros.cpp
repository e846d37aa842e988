// Macros that are written out: one definition, or each of those that a condition chooses between.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "cocos/flatten/FlattenRun.h"

namespace crevice::cocos {
namespace {

constexpr std::size_t kMaxRefused = 8u << 20;    ///< Bytes of calls that are none, of a stage.
constexpr std::size_t kManyAlternatives = 1000;  ///< Of one call: then they are why the stage is full.
constexpr std::size_t kMaxBranchDepth = 16;      ///< Conditions that cross a call, each in a copy of the one before.

}  // namespace

std::size_t Flattener::expandLine(const CodeLines& lines, std::size_t at, Pending& pending) {
    Cursor cursor{at, 0};
    endedInDirective_ = false;
    std::string_view trailing;  // A name that was written, and now stands in front of what it is called with.
    const auto keep = [&](std::size_t end) {
        if (trimBlank(pending.text).empty()) pending.origin = lines.origin(cursor.line);
        pending.text.append(lines.text(cursor.line).substr(cursor.column, end - cursor.column));
        cursor.column = end;
    };
    while (!stopped_) {
        const std::string_view text = lines.text(cursor.line);
        std::string_view word = std::exchange(trailing, {});
        const bool isWritten = !word.empty();
        if (isWritten) {
            pending.text.resize(pending.text.size() - word.size());
        } else {
            const std::size_t call = table_->findCall(text, cursor.column);
            if (call == std::string_view::npos) break;
            keep(call);
            word = leadingName(text.substr(call));
            if (!expandedFrom_) callPlace_ = placeAt(text, call, word.size(), lines.origin(cursor.line));
        }
        const std::string_view name = calledBy(word);
        const std::string_view head = isWritten ? std::string_view() : chosenHeadOf(name);
        if (const StatementRest rest = head.empty() ? StatementRest{} : restOfDeclaration(lines, cursor); rest.found) {
            const Origin origin = lines.origin(cursor.line);
            cursor = {rest.line, rest.end};
            expandDeclaration(head, rest, origin, pending);
            continue;
        }
        Cursor behind{cursor.line, cursor.column + (isWritten ? 0 : word.size())};
        if (expandCall(lines, behind, name, pending)) {
            cursor = behind;
            trailing = trailingName(pending);
        } else {
            if (trimBlank(pending.text).empty()) pending.origin = lines.origin(cursor.line);
            pending.text += name;
            cursor = behind;
        }
    }
    const std::string_view text = withoutSplice(lines.text(cursor.line));
    endedInDirective_ = endedInDirective_ && trimBlank(text.substr(std::min(cursor.column, text.size()))).empty();
    if (cursor.column < text.size()) keep(text.size());
    return cursor.line - at + 1;
}

bool Flattener::expandCall(const CodeLines& lines, Cursor& cursor, std::string_view name, Pending& pending) {
    if (isOpenChoice(name)) return expandChoices(lines, cursor, name, pending);
    const MacroDefinition* macro = definitionOf(name);
    if (macro == nullptr) return false;
    if (std::find(active_.begin(), active_.end(), name) != active_.end()) {
        pending.text.append(1, kFinal).append(name);  // Elsewhere too it stays a name.
        return true;
    }
    return expandDefinition(lines, cursor, *macro, pending);
}

bool Flattener::expandDefinition(const CodeLines& lines, Cursor& cursor, const MacroDefinition& macro,
                                 Pending& pending) {
    const Origin origin = lines.origin(cursor.line);
    CallArguments arguments;
    if (macro.functionLike) {
        arguments = takeArguments(lines, cursor, macro.name);
        if (arguments.state == CallArguments::State::Crossing || pastesLines(macro, arguments))
            return expandBranches(lines, cursor, macro.name, *macro.source, pending);
        if (!arguments.found()) return false;
        if (!matchArguments(macro, arguments.values)) {
            if (places_.isConditional() || captured_ != nullptr) return false;  // Perhaps no variant comes here.
            reportArguments(macro, arguments.values.size(), callPlace_, problems_);
        }
        cursor = {arguments.line, arguments.end};
        if (arguments.values.size() != macro.parameters.size()) return true;
    }
    const bool begins = beginsStatement(pending);
    endedInDirective_ = expand(macro, arguments.values, origin, pending);
    if (!endedInDirective_ || !begins || !isStatements(macro)) return true;
    const std::string_view text = lines.text(cursor.line);
    cursor.column = std::min(text.find_first_not_of(" \t", cursor.column), text.size());
    if (cursor.column < text.size() && text[cursor.column] == ';') ++cursor.column;  // It ends no statement now.
    return true;
}

CallArguments Flattener::takeArguments(const CodeLines& lines, Cursor cursor, std::string_view name) {
    CallArguments arguments = readArguments(lines, cursor.line, cursor.column, limits_.maxArgument);
    if (!arguments.found()) refused_ += arguments.bytes;
    if (!stopped_ && (arguments.state == CallArguments::State::Unclosed || refused_ > kMaxRefused)) {
        reportUnclosed(name, arguments.bytes > limits_.maxArgument ? limits_.maxArgument : 0, callPlace_, problems_);
        stopped_ = true;  // The next would look through as many lines again.
    }
    return arguments;
}

bool Flattener::expandBranches(const CodeLines& lines, Cursor& cursor, std::string_view name, const SourceText& source,
                               Pending& pending) {
    if (branchDepth_ == kMaxBranchDepth) return false;
    const CallBranches call = splitCall(lines, cursor.line, cursor.column, name, limits_.maxArgument);
    refused_ += call.bytes;
    if (call.branches.empty()) return false;
    ++branchDepth_;
    flush(pending);
    for (const CallBranches::Branch& branch : call.branches) {
        emitDirective(branch.directive, branch.origin, source);
        Pending copy;
        writeLines(branch.lines, copy, source, false);
        flush(copy);
        written_ += call.bytes;
    }
    emitDirective("#endif", call.branches.back().origin, source);
    --branchDepth_;
    if (written_ > limits_.maxBytes) stopExpanding(*table_->find(name));
    cursor = {call.line, call.end};
    endedInDirective_ = false;
    return true;
}

std::string_view Flattener::trailingName(const Pending& pending) const {
    std::size_t begin = pending.text.size();
    while (begin > 0 && isNamePart(pending.text[begin - 1])) --begin;
    if (begin > 0 && pending.text[begin - 1] == kFinal) return {};
    const MacroDefinition* macro = table_->find(std::string_view(pending.text).substr(begin));
    return macro != nullptr && table_->isExpanded(macro->name) ? macro->name : std::string_view();
}

bool Flattener::isStatements(const MacroDefinition& macro) const {
    return endsStatements(macro,
                          [&](std::string_view text) { return table_->findCall(text, 0) != std::string_view::npos; });
}

void Flattener::expandArguments(const MacroDefinition& macro, std::vector<std::string>& arguments, Origin origin) {
    const auto isPasted = [](const auto& part) { return part.text.find("##") != std::string_view::npos; };
    if (std::any_of(macro.body.begin(), macro.body.end(), isPasted)) return;
    for (std::string& argument : arguments) {
        if (table_->findCall(argument, 0) == std::string_view::npos) continue;
        if (argumentDepth_ >= limits_.maxDepth) return stopExpanding(macro);
        ++argumentDepth_;
        const BodyLines lines = splitLines(argument, origin);
        std::string written;
        std::string* const outer = std::exchange(captured_, &written);
        Pending pending;
        writeLines(lines, pending, *macro.source, false);
        flush(pending);
        captured_ = outer;
        --argumentDepth_;
        if (written.ends_with('\n') && written.find('#') == std::string::npos) written.pop_back();
        argument = (written.starts_with('#') ? "\n" : "") + written;
        written_ += argument.size();
    }
}

bool Flattener::expand(const MacroDefinition& macro, const std::vector<std::string>& given, Origin call,
                       Pending& pending) {
    std::vector<std::string> arguments = given;
    expandArguments(macro, arguments, call);
    const bool outermost = !expandedFrom_;
    if (outermost) {
        expandedFrom_ = call;
        before_ = {expansions_, written_};
    }
    if (++expansions_ > limits_.maxExpansions || active_.size() >= limits_.maxDepth) {
        stopExpanding(macro);
        return false;
    }
    active_.push_back(macro.name);
    const std::uint32_t file = fileIndex(macro.source->file);
    const bool single = macro.body.size() == 1 && !macro.bearsDirectives;
    BodyLines lines;
    for (std::size_t i = 0; i < macro.body.size(); ++i) {
        const auto& part = macro.body[i];
        const std::string text = substitute(joinPasted(macro, i), macro.parameters, arguments);
        written_ += text.size();
        const Origin origin = single ? call : Origin{file, part.line};
        BodyLines parts = splitLines(text, origin);  // Several for an argument with conditions.
        std::move(parts.texts.begin(), parts.texts.end(), std::back_inserter(lines.texts));
        lines.origins.insert(lines.origins.end(), parts.origins.begin(), parts.origins.end());
    }
    if (written_ > limits_.maxBytes) stopExpanding(macro);
    const bool endsInDirective = writeLines(lines, pending, *macro.source, !single);
    if (outermost) expandedFrom_.reset();
    active_.pop_back();
    return endsInDirective;
}

bool Flattener::writeLines(const BodyLines& lines, Pending& pending, const SourceText& source, bool apart) {
    bool endsInDirective = false;
    for (std::size_t i = 0; i < lines.texts.size() && !stopped_;) {
        endsInDirective = readDirective(lines.texts[i]).kind != LineKind::Code;
        if (apart || i > 0) flush(pending);
        if (endsInDirective) {
            emitDirective(lines.texts[i], lines.origins[i], source);
            ++i;
        } else {
            i += expandLine(lines, i, pending);
            endsInDirective = endedInDirective_;
        }
    }
    if (apart) flush(pending);
    return endsInDirective;
}

void Flattener::stopExpanding(const MacroDefinition& macro) {
    if (stopped_) return;
    stopped_ = true;
    const std::string_view name = active_.empty() ? std::string_view(macro.name) : active_.front();
    if (argumentDepth_ >= limits_.maxDepth || active_.size() >= limits_.maxDepth)
        return problems_.error(
            callPlace_, fmt::format("the call of macro '{}' nests macros deeper than {}", name, limits_.maxDepth),
            "split it: a part of it can be a variable, or a macro of fewer levels");
    if (choices_.isAnyTaken() && alternatives_ > kManyAlternatives)
        return problems_.error(callPlace_,
                               fmt::format("macro '{}' stands for too many alternatives to write them all out", name),
                               "conditions choose between definitions of the macros that it calls, and their numbers "
                               "multiply: let one macro's body hold the conditions");
    if (expansions_ - before_.expansions <= limits_.maxExpansions / 2 &&
        written_ - before_.written <= limits_.maxBytes / 2)  // It only came last.
        return problems_.error(callPlace_, "the macros of this stage write more than it can hold",
                               "call fewer, or fewer in one line: several definitions multiply the line");
    problems_.error(callPlace_, fmt::format("macro '{}' expands without end", name),
                    "macros multiply each other: write out what is meant");
}

}  // namespace crevice::cocos
