// Which definitions of a macro to be expanded hold, as #define, #undef and conditions follow each other; its call
// written for each of them.
#include <fmt/format.h>

#include <algorithm>

#include "cocos/flatten/FlattenRun.h"

namespace crevice::cocos {

void Flattener::noteChoice(const MacroDefinition& macro, Origin origin) {
    const std::size_t number = choices_.add(macro, places_.here(), !places_.isConditional());
    if (number > MacroChoices::kMaxOfName)
        return stop(macro.body.front().text, origin,
                    fmt::format("macro '{}' has more than {} definitions", macro.name, MacroChoices::kMaxOfName),
                    "conditions choose between them where it is called: each would be written out");
    const std::string name = choiceOf(macro.name);
    emitDirective("#undef " + name, origin, *macro.source);
    emitDirective(fmt::format("#define {} {}", name, number), origin, *macro.source);
}

const MacroDefinition* Flattener::definitionOf(std::string_view name) const {
    if (choices_.contains(name) && !choices_.isTaken(name)) {
        const auto possible = choices_.possible(name, places_);
        return possible.empty() ? nullptr : possible.back().macro;
    }
    if (const auto latest = latest_.find(name); latest != latest_.end()) return latest->second;
    const MacroDefinition* first = table_->find(name);
    return first != nullptr && first->fromPragma ? first : nullptr;
}

void Flattener::undefine(std::string_view name, Origin origin, const SourceText& source) {
    places_.undefine(name);
    if (!table_->isExpanded(name)) return;
    const bool conditional = places_.isConditional();
    if (choices_.contains(name)) emitDirective("#undef " + choiceOf(name), origin, source);
    choices_.undefine(name, conditional);
    if (const auto latest = latest_.find(name); latest != latest_.end() && !conditional) latest_.erase(latest);
}

void Flattener::writeEach(std::string_view name, Origin origin,
                          const std::function<void(const MacroDefinition*)>& write) {
    const auto choices = choices_.possible(name, places_);
    const bool sure = choices_.isSure(name, places_);
    const MacroDefinition* const latest = latest_[name];
    if (!choices_.isAnyTaken()) alternatives_ = 0;
    choices_.take(name);
    const std::size_t included = included_.size();
    std::vector<const SourceText*> ofCopies;
    for (std::size_t i = 0; i < choices.size() + (sure ? 0 : 1) && !stopped_; ++i) {
        const bool defined = i < choices.size();
        ++alternatives_;
        latest_[name] = defined ? choices[i].macro : nullptr;
        const SourceText& source = *choices[defined ? i : 0].macro->source;
        emitDirective(
            defined ? fmt::format("#{} {} == {}", i == 0 ? "if" : "elif", choiceOf(name), choices[i].number) : "#else",
            origin, source);
        write(latest_[name]);
        const auto ofCopy = included_.cutTo(included);
        ofCopies.insert(ofCopies.end(), ofCopy.begin(), ofCopy.end());
    }
    for (const SourceText* one : ofCopies) included_.insert(*one);
    emitDirective("#endif", origin, *choices.front().macro->source);
    choices_.release();
    latest_[name] = latest;
}

bool Flattener::expandChoices(const CodeLines& lines, Cursor& cursor, std::string_view name, Pending& pending) {
    const auto choices = choices_.possible(name, places_);
    const SourceText& source = *choices.front().macro->source;
    const Origin origin = lines.origin(cursor.line);
    CallArguments arguments;
    if (std::any_of(choices.begin(), choices.end(),
                    [&](const auto& one) { return one.macro->functionLike || endsInName(*one.macro); }))
        arguments = takeArguments(lines, cursor, name);
    const bool pastes = std::any_of(choices.begin(), choices.end(),
                                    [&](const auto& one) { return pastesLines(*one.macro, arguments); });
    if (arguments.state == CallArguments::State::Crossing || pastes) {
        if (expandBranches(lines, cursor, name, source, pending)) return true;
        arguments = {};
    }
    const auto isObject = [](const auto& one) { return !one.macro->functionLike; };
    if (!arguments.found() && std::none_of(choices.begin(), choices.end(), isObject)) return false;
    const Cursor begin = cursor;
    if (arguments.found()) cursor = {arguments.line, arguments.end};
    const std::string_view text = lines.text(cursor.line);
    const std::size_t behind = std::min(text.find_first_not_of(" \t", cursor.column), text.size());
    const bool statement = behind < text.size() && text[behind] == ';' && beginsStatement(pending);
    if (statement) cursor.column = behind + 1;
    BodyLines written;  // The call as it stands, for where no definition holds.
    for (std::size_t line = begin.line, column = begin.column; line <= cursor.line; ++line, column = 0) {
        const std::size_t end = line == cursor.line ? cursor.column : lines.text(line).size();
        written.texts.emplace_back(line == begin.line ? kFinal + std::string(name) : std::string());
        written.texts.back() += lines.text(line).substr(column, end - column);
        written.origins.push_back(lines.origin(line));
    }
    flush(pending);
    bool allEnd = true;
    writeEach(name, origin, [&](const MacroDefinition* macro) {
        Pending copy{{}, origin};
        const bool ended = macro != nullptr && expandChoice(*macro, arguments, origin, copy);
        if (macro == nullptr) {
            writeLines(written, copy, source, false);
            return flush(copy);
        }
        if (statement && !(ended && isStatements(*macro))) copy.text += ';';
        allEnd = allEnd && (ended || statement);
        flush(copy);
    });
    endedInDirective_ = allEnd;
    return true;
}

bool Flattener::endsInName(const MacroDefinition& macro) const {
    if (macro.body.empty()) return false;
    const std::string_view text = trimBlank(macro.body.back().text);
    std::size_t begin = text.size();
    while (begin > 0 && isNamePart(text[begin - 1])) --begin;
    return table_->isExpanded(text.substr(begin));
}

bool Flattener::expandChoice(const MacroDefinition& macro, const CallArguments& arguments, Origin origin,
                             Pending& pending) {
    std::vector<std::string> values = arguments.values;
    const bool called = macro.functionLike && arguments.found() && matchArguments(macro, values);
    bool ended = false;
    if (macro.functionLike && !called)
        pending.text += macro.name;
    else
        ended = expand(macro, called ? values : std::vector<std::string>{}, origin, pending);
    if (called || !arguments.found()) return ended;
    const std::string_view name = trailingName(pending);
    pending.text.resize(pending.text.size() - name.size());
    writeLines(splitLines(fmt::format("{}({})", name, fmt::join(arguments.values, ", ")), origin), pending,
               *macro.source, false);
    return false;
}

}  // namespace crevice::cocos
