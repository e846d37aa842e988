// Macros that are written out: one definition, or each of those that a condition chooses between.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cocos/FlattenRun.h"

namespace crevice::cocos {
namespace {

constexpr std::size_t kMaxLooked = 16u << 20;  ///< Bytes of macros' bodies that are looked through, of a stage.
constexpr std::size_t kMaxHeads = 16;          ///< In one declaration.
constexpr std::size_t kMaxCopies = 16;         ///< Of a declaration with several chosen heads.

}  // namespace

template <class Lines>
std::size_t Flattener::expandLine(const Lines& lines, std::size_t at, Pending& pending) {
    std::size_t used = 1, from = 0;
    endedInDirective_ = false;
    std::string_view text = lines.text(at);
    const auto keep = [&](std::size_t end) {
        if (trimBlank(pending.text).empty()) pending.origin = lines.origin(at + used - 1);
        pending.text.append(text.substr(from, end - from));
        from = end;
    };
    while (!stopped_) {
        std::size_t call = table_->findCall(text, from);
        if (call == std::string_view::npos) break;
        const std::string_view word = leadingName(text.substr(call)), name = calledBy(word);
        const std::size_t behind = call + word.size(), line = at + used - 1;
        const Origin origin = lines.origin(line);
        const SourceLoc where = placeAt(text, call, word.size(), origin);
        keep(call);
        if (!expandedFrom_) callPlace_ = where;
        const std::string_view head = chosenHeadOf(name);
        const StatementRest rest = head.empty() ? StatementRest{} : restOfDeclaration(lines, line, call);
        if (rest.found || isOpenChoice(name)) {
            from = rest.found ? rest.end : behind;
            const std::size_t last = rest.found ? expandDeclaration(head, rest, origin, pending)
                                                : expandChoices(lines, line, name, from, pending);
            used = last - at + 1;
            text = lines.text(last);
            continue;
        }
        const MacroDefinition* macro = definitionOf(name);
        const bool active = macro == nullptr || std::find(active_.begin(), active_.end(), name) != active_.end();
        CallArguments arguments;
        if (!active && macro->functionLike) arguments = readArguments(lines, line, behind, limits_.maxArgument);
        if (active || (macro->functionLike && !arguments.found)) {
            if (arguments.unclosed) reportUnclosed(name, where, problems_);
            stopped_ = stopped_ || arguments.unclosed;
            keep(behind);
            continue;
        }
        from = behind;
        if (macro->functionLike) {
            used = arguments.line - at + 1;
            text = lines.text(arguments.line);
            from = arguments.end;
            if (!matchArguments(*macro, arguments.values)) {
                reportArguments(*macro, arguments.values.size(), where, problems_);
                continue;
            }
        }
        const bool begins = beginsStatement(pending);
        endedInDirective_ = expand(*macro, arguments.values, origin, pending);
        if (endedInDirective_ && begins && isStatements(*macro)) {
            from = std::min(text.find_first_not_of(" \t", from), text.size());
            if (from < text.size() && text[from] == ';') ++from;  // It ended a call that is no statement now.
        }
    }
    text = withoutSplice(text);
    endedInDirective_ = endedInDirective_ && trimBlank(text.substr(std::min(from, text.size()))).empty();
    if (from < text.size()) keep(text.size());
    return used;
}

bool Flattener::isStatements(const MacroDefinition& macro) const {
    return endsStatements(macro,
                          [&](std::string_view text) { return table_->findCall(text, 0) != std::string_view::npos; });
}

std::string_view Flattener::calledBy(std::string_view name) const {
    for (std::size_t i = 0; i < limits_.maxDepth && !isOpenChoice(name); ++i) {
        const MacroDefinition* macro = definitionOf(name);
        if (macro == nullptr || macro->functionLike || macro->body.size() != 1 ||
            std::find(active_.begin(), active_.end(), name) != active_.end())
            break;
        const std::string_view body = trimBlank(macro->body[0].text);
        if (body.empty() || leadingName(body) != body || !table_->isExpanded(body)) break;
        name = body;
    }
    return name;
}

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

bool Flattener::addOpenChoices(std::string_view text, std::vector<std::string_view>& names,
                               std::unordered_set<std::string_view>& seen) {
    return visitCalls(text, seen, [&](std::string_view call) {
        const MacroDefinition* macro = definitionOf(call);
        if (isOpenChoice(call)) names.push_back(call);
        if (names.size() > kMaxHeads) return Visited::Found;
        const bool within = std::find(active_.begin(), active_.end(), call) != active_.end();
        return isOpenChoice(call) || within || macro == nullptr || macro->bearsDirectives ? Visited::PassOver
                                                                                          : Visited::Enter;
    });
}

bool Flattener::isHeadChoice(std::string_view name) {
    const auto& choices = choices_.of(name);
    return std::any_of(choices.begin(), choices.end(), [&](const auto& choice) {
        const MacroDefinition* macro = choice.macro;
        return macro->declares || (!macro->bearsDirectives && macro->body.size() == 1 &&
                                   table_->findCall(macro->body[0].text, 0) != std::string_view::npos);
    });
}

std::string_view Flattener::chosenHeadOf(std::string_view name) {
    if (choices_.isEmpty()) return {};
    if (isOpenChoice(name)) return isHeadChoice(name) ? name : std::string_view();
    const MacroDefinition* macro = definitionOf(name);
    if (macro == nullptr || macro->bearsDirectives || macro->body.empty()) return {};
    const std::string_view last = trimBlank(macro->body.back().text);
    if (last.empty() || last.ends_with(';') || last.ends_with('}')) return {};
    std::vector<std::string_view> names;
    std::unordered_set<std::string_view> seen;
    for (const auto& part : macro->body) addOpenChoices(part.text, names, seen);
    const auto head = std::find_if(names.begin(), names.end(), [&](std::string_view one) { return isHeadChoice(one); });
    return head == names.end() ? std::string_view() : *head;
}

template <class Lines>
StatementRest Flattener::restOfDeclaration(const Lines& lines, std::size_t at, std::size_t from) {
    std::vector<std::string_view> names;
    std::unordered_set<std::string_view> seen;
    return readStatementRest(lines, at, from, limits_.maxArgument, [&](std::string_view part) {
        addOpenChoices(part, names, seen);
        std::size_t copies = 1;
        for (const std::string_view name : names) copies = std::min(copies * choices_.of(name).size(), kMaxCopies + 1);
        return copies > kMaxCopies && names.size() > 1;
    });
}

bool Flattener::beginsStatement(const Pending& pending) const {
    std::string_view before = trimBlank(pending.text);
    if (captured_ != nullptr) return false;
    if (before.empty()) {
        before = trimBlank(std::string_view(out_.flat.text));
        while (before.ends_with('\n')) before = trimBlank(before.substr(0, before.size() - 1));
        const auto begin = before.rfind('\n');
        if (trimBlank(before.substr(begin == std::string_view::npos ? 0 : begin + 1)).starts_with('#')) return true;
    }
    return before.empty() || std::string_view(";{})").find(before.back()) != std::string_view::npos;
}

std::string Flattener::takeHead(Pending& pending) {
    const std::size_t end = pending.text.find_last_of(";{}");
    std::string head = end == std::string::npos ? pending.text : pending.text.substr(end + 1);
    pending.text.resize(pending.text.size() - head.size());
    flush(pending);
    return head;
}

template <class Write>
void Flattener::writeEach(std::string_view name, Origin origin, Write write) {
    const auto choices = choices_.possible(name, places_);
    const bool sure = choices_.isSure(name, places_);
    const MacroDefinition* const latest = latest_[name];
    choices_.take(name);
    const std::size_t included = included_.size();
    std::vector<const SourceText*> ofCopies;
    for (std::size_t i = 0; i < choices.size() + (sure ? 0 : 1) && !stopped_; ++i) {
        const bool defined = i < choices.size();
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

std::size_t Flattener::expandDeclaration(std::string_view head, const StatementRest& rest, Origin origin,
                                         Pending& pending) {
    const std::string before = takeHead(pending);
    const SourceText& source = *choices_.of(head).front().macro->source;
    writeEach(head, origin, [&](const MacroDefinition*) {
        Pending copy{before, origin};
        writeLines(rest.lines, copy, source, false);
        flush(copy);
    });
    endedInDirective_ = true;
    return rest.line;
}

template <class Lines>
std::size_t Flattener::expandChoices(const Lines& lines, std::size_t at, std::string_view name, std::size_t& from,
                                     Pending& pending) {
    const auto choices = choices_.possible(name, places_);
    const Origin origin = lines.origin(at);
    const std::size_t begin = from;
    CallArguments arguments;
    if (std::any_of(choices.begin(), choices.end(), [](const auto& one) { return one.macro->functionLike; }))
        arguments = readArguments(lines, at, from, limits_.maxArgument);
    if (arguments.unclosed) {
        reportUnclosed(name, callPlace_, problems_);
        stopped_ = true;  // The next would look through as many lines again.
        return at;
    }
    const std::size_t last = arguments.found ? arguments.line : at;
    if (arguments.found) from = arguments.end;
    const std::string_view text = lines.text(last);
    const std::size_t behind = std::min(text.find_first_not_of(" \t", from), text.size());
    const bool statement = behind < text.size() && text[behind] == ';' && beginsStatement(pending);
    if (statement) from = behind + 1;
    BodyLines written;  // The call as it stands, for where no definition holds.
    for (std::size_t line = at, column = begin; line <= last; ++line, column = 0) {
        const std::size_t end = line == last ? from : lines.text(line).size();
        written.texts.emplace_back(line == at ? name : std::string_view());
        written.texts.back() += lines.text(line).substr(column, end - column);
        written.origins.push_back(lines.origin(line));
    }
    flush(pending);
    bool allEnd = true;
    writeEach(name, origin, [&](const MacroDefinition* macro) {
        Pending copy{{}, origin};
        const bool ended = macro != nullptr && expandChoice(*macro, arguments, origin, copy);
        if (macro == nullptr) {
            writeLines(written, copy, *choices.front().macro->source, false);
            return flush(copy);
        }
        if (statement && !(ended && isStatements(*macro))) copy.text += ';';
        allEnd = allEnd && (ended || statement);
        flush(copy);
    });
    endedInDirective_ = allEnd;
    return last;
}

bool Flattener::expandChoice(const MacroDefinition& macro, const CallArguments& arguments, Origin origin,
                             Pending& pending) {
    if (macro.functionLike && !arguments.found) {
        pending.text += macro.name;
        return false;
    }
    std::vector<std::string> values = arguments.values;
    if (macro.functionLike && !matchArguments(macro, values)) {
        reportArguments(macro, values.size(), callPlace_, problems_);
        return false;
    }
    const bool ended = expand(macro, macro.functionLike ? values : std::vector<std::string>{}, origin, pending);
    if (macro.functionLike || !arguments.found) return ended;
    pending.text += fmt::format("({})", fmt::join(arguments.values, ", "));
    return false;
}

void Flattener::expandArguments(const MacroDefinition& macro, std::vector<std::string>& arguments, Origin origin) {
    const auto isPasted = [](const auto& part) { return part.text.find("##") != std::string_view::npos; };
    if (std::any_of(macro.body.begin(), macro.body.end(), isPasted)) return;
    for (std::string& argument : arguments) {
        std::unordered_set<std::string_view> seen;
        const bool leadsBack = visitCalls(argument, seen, [&](std::string_view call) {
            const bool around = std::find(active_.begin(), active_.end(), call) != active_.end();
            return call == macro.name || around ? Visited::Found : Visited::Enter;
        });
        if (!leadsBack) continue;
        if (argumentDepth_ >= limits_.maxDepth) return stopExpanding(macro);
        ++argumentDepth_;
        BodyLines lines;
        for (std::size_t at = 0; at <= argument.size();) {
            const std::size_t end = std::min(argument.find('\n', at), argument.size());
            lines.texts.push_back(argument.substr(at, end - at));
            lines.origins.push_back(origin);
            at = end + 1;
        }
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
    for (const auto& part : macro.body) {
        std::string text = substitute(part.text, macro.parameters, arguments);
        written_ += text.size();
        const Origin origin = single ? call : Origin{file, part.line};
        for (std::size_t end; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1)) {
            lines.texts.push_back(text.substr(0, end));  // An argument with conditions.
            lines.origins.push_back(origin);
        }
        lines.texts.push_back(std::move(text));
        lines.origins.push_back(origin);
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
    const bool deep = active_.size() >= limits_.maxDepth || argumentDepth_ >= limits_.maxDepth;
    if (!deep && expansions_ - before_.expansions <= limits_.maxExpansions / 2 &&
        written_ - before_.written <= limits_.maxBytes / 2)  // It only came last.
        return problems_.error(callPlace_, "the macros of this stage write more than it can hold",
                               "call fewer, or fewer in one line: several definitions multiply the line");
    const std::string_view name = active_.empty() ? std::string_view(macro.name) : active_.front();
    problems_.error(callPlace_, fmt::format("macro '{}' expands without end", name),
                    "macros multiply each other: write out what is meant");
}

template std::size_t Flattener::expandLine(const SourceLines&, std::size_t, Pending&);

}  // namespace crevice::cocos
