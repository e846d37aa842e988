// Macros that are written out: one definition, or each of those that a condition chooses between.
#include <fmt/format.h>

#include <algorithm>

#include "cocos/FlattenRun.h"

namespace crevice::cocos {

void Flattener::noteChoice(const MacroDefinition& macro, Origin origin) {
    const std::size_t number = choices_.add(macro);
    const std::string name = choiceOf(macro.name);
    emitDirective("#undef " + name, origin, *macro.source);
    emitDirective(fmt::format("#define {} {}", name, number), origin, *macro.source);
}

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
        const std::string_view name = leadingName(text.substr(call));
        if (isOpenChoice(name)) {
            keep(call);
            const SourceLoc where = placeAt(text, call, name.size(), lines.origin(at + used - 1));
            if (!expandedFrom_) callPlace_ = where;
            const std::size_t last = expandChoices(lines, at + used - 1, call, name, from, pending);
            used = last - at + 1;
            text = lines.text(last);
            continue;
        }
        const MacroDefinition* macro = latest_.contains(name) ? latest_[name] : table_->find(name);
        const bool active = macro == nullptr || std::find(active_.begin(), active_.end(), name) != active_.end();
        keep(call);
        const Origin origin = lines.origin(at + used - 1);
        const SourceLoc where = placeAt(text, call, name.size(), origin);
        if (!expandedFrom_) callPlace_ = where;
        CallArguments arguments;
        if (!active && macro->functionLike)
            arguments = readArguments(lines, at + used - 1, call + name.size(), limits_.maxArgument);
        if (active || (macro->functionLike && !arguments.found)) {
            if (arguments.unclosed) reportUnclosed(name, where, problems_);
            stopped_ = stopped_ || arguments.unclosed;
            keep(call + name.size());
            continue;
        }
        from = call + name.size();
        if (macro->functionLike) {
            used = arguments.line - at + 1;
            text = lines.text(arguments.line);
            from = arguments.end;
            if (!matchArguments(*macro, arguments.values)) {
                reportArguments(*macro, arguments.values.size(), where, problems_);
                continue;
            }
        }
        endedInDirective_ = expand(*macro, arguments.values, origin, pending);
        if (endedInDirective_) {
            from = std::min(text.find_first_not_of(" \t", from), text.size());
            if (from < text.size() && text[from] == ';') ++from;  // It ended a call that is no statement now.
        }
    }
    endedInDirective_ = endedInDirective_ && trimBlank(text.substr(from)).empty();
    keep(text.size());
    return used;
}

bool Flattener::hasOpenChoice(std::string_view text, std::string_view name) const {
    for (std::size_t at = 0; (at = table_->findCall(text, at)) != std::string_view::npos;) {
        const std::string_view call = leadingName(text.substr(at));
        if (call != name && isOpenChoice(call)) return true;
        at += call.size();
    }
    return false;
}

template <class Lines>
StatementRest Flattener::restOfDeclaration(const Lines& lines, std::size_t at, std::size_t from,
                                           std::string_view name) {
    const auto& choices = choices_.of(name);
    const bool declares = std::any_of(choices.begin(), choices.end(), [&](const MacroDefinition* macro) {
        return macro->declares || (!macro->bearsDirectives && macro->body.size() == 1 &&
                                   table_->findCall(macro->body[0].text, 0) != std::string_view::npos);
    });
    if (!declares) return {};
    return readStatementRest(lines, at, from, limits_.maxArgument,
                             [&](std::string_view part) { return hasOpenChoice(part, name); });
}

std::string Flattener::takeHead(Pending& pending) {
    const std::size_t end = pending.text.find_last_of(";{}");
    std::string head = end == std::string::npos ? pending.text : pending.text.substr(end + 1);
    pending.text.resize(pending.text.size() - head.size());
    flush(pending);
    return head;
}

template <class Lines>
std::size_t Flattener::expandChoices(const Lines& lines, std::size_t at, std::size_t call, std::string_view name,
                                     std::size_t& from, Pending& pending) {
    const std::vector<const MacroDefinition*> choices = choices_.of(name);
    const Origin origin = lines.origin(at);
    CallArguments arguments;
    if (std::any_of(choices.begin(), choices.end(), [](const auto* macro) { return macro->functionLike; }))
        arguments = readArguments(lines, at, call + name.size(), limits_.maxArgument);
    if (arguments.unclosed) {
        reportUnclosed(name, callPlace_, problems_);
        stopped_ = true;  // The next would look through as many lines again.
        from = call + name.size();
        return at;
    }
    std::size_t last = arguments.found ? arguments.line : at;
    from = arguments.found ? arguments.end : call + name.size();
    const StatementRest rest = restOfDeclaration(lines, last, from, name);
    const std::string head = rest.found ? takeHead(pending) : std::string();
    const std::string_view text = lines.text(last);
    const std::size_t behind = std::min(text.find_first_not_of(" \t", from), text.size());
    const bool statement = behind < text.size() && text[behind] == ';';
    if (statement) from = behind + 1;
    if (rest.found) {
        last = rest.line;
        from = rest.end;
    }
    flush(pending);
    const MacroDefinition* const latest = latest_[name];
    choices_.take(name);
    const std::size_t included = included_.size();
    std::vector<const SourceText*> ofCopies;
    bool allEnd = true;
    for (std::size_t i = 0; i < choices.size() && !stopped_; ++i) {
        latest_[name] = choices[i];
        emitDirective(fmt::format("#{} {} == {}", i == 0 ? "if" : "elif", choiceOf(name), i + 1), origin,
                      *choices[i]->source);
        Pending copy{head, origin};
        const bool ended = expandChoice(*choices[i], arguments, origin, copy);
        if (rest.found && !(statement && ended))
            writeLines(rest.lines, copy, *choices.front()->source, false);
        else if (statement && !ended)
            copy.text += ';';
        allEnd = allEnd && (ended || statement || rest.found);
        flush(copy);
        const auto ofCopy = included_.cutTo(included);
        ofCopies.insert(ofCopies.end(), ofCopy.begin(), ofCopy.end());
    }
    for (const SourceText* one : ofCopies) included_.insert(*one);
    emitDirective("#endif", origin, *choices.front()->source);
    choices_.release();
    latest_[name] = latest;
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

bool Flattener::expand(const MacroDefinition& macro, const std::vector<std::string>& arguments, Origin call,
                       Pending& pending) {
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
        lines.texts.push_back(substitute(part.text, macro.parameters, arguments));
        lines.origins.push_back(single ? call : Origin{file, part.line});
        written_ += lines.texts.back().size();
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
    if (active_.size() < limits_.maxDepth && expansions_ - before_.expansions <= limits_.maxExpansions / 2 &&
        written_ - before_.written <= limits_.maxBytes / 2)  // It only came last.
        return problems_.error(callPlace_, "the macros of this stage write more than it can hold",
                               "call fewer, or fewer in one line: several definitions multiply the line");
    const std::string_view name = active_.empty() ? std::string_view(macro.name) : active_.front();
    problems_.error(callPlace_, fmt::format("macro '{}' expands without end", name),
                    "macros multiply each other: write out what is meant");
}

template std::size_t Flattener::expandLine(const SourceLines&, std::size_t, Pending&);

}  // namespace crevice::cocos
