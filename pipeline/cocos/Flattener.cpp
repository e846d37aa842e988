// Walks programs and chunks line by line.
#include "cocos/Flattener.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "cocos/FlatOutput.h"
#include "cocos/IncludedTexts.h"
#include "cocos/MacroCall.h"
#include "cocos/MacroChoices.h"
#include "cocos/MacroTable.h"
#include "cocos/Pragmas.h"

namespace crevice::cocos {
namespace {

using Origin = FlatSource::Origin;

class Flattener : private FlatOutput {
public:
    Flattener(const EffectAsset& effect, ChunkLibrary& chunks, const FlattenLimits& limits, Problems& problems)
        : effect_(effect), chunks_(chunks), limits_(limits), problems_(problems) {}

    Flattened run(const std::string& program, const SourceLoc& where) {
        const auto found = chunks_.find(effect_, program, std::filesystem::path(effect_.path).parent_path());
        if (found.source == nullptr) {
            problems_.error(where, fmt::format("no program or chunk '{}'", program), found.help);
            return std::move(out_);
        }
        const MacroTable table(
            *found.source,
            [&](const SourceText& from, std::string_view rest) -> const SourceText* {
                const std::string_view name = includedName(rest);
                return name.empty() ? nullptr : chunks_.find(effect_, std::string(name), from.folder).source;
            },
            limits_.maxIncludes);
        table_ = &table;
        out_.flat.text.reserve(1u << 16);
        emit(*found.source);
        return std::move(out_);
    }

private:
    void emit(const SourceText& source) {
        included_.insert(source);
        stack_.push_back(&source);
        const std::uint32_t outer = file_;
        file_ = fileIndex(source.file);
        const SourceLines lines{source, file_};
        for (std::size_t at = 0; at < source.lines.size() && !stopped_;) at = emitLine(lines, at);
        file_ = outer;
        stack_.pop_back();
    }

    std::size_t emitLine(const SourceLines& lines, std::size_t at) {
        const SourceLine& line = lines.source.lines[at];
        if (line.kind == LineKind::Code) {
            if (table_->findCall(line.text, 0) == std::string_view::npos) {
                push(line.text, lines.origin(at));
                return at + 1;
            }
            Pending pending;
            const std::size_t used = expandLine(lines, at, pending);
            flush(pending);
            return at + used;
        }
        const std::size_t next = at + line.span;
        if (line.macro >= 0) {
            emitDefinition(lines, at, lines.source.macros[static_cast<std::size_t>(line.macro)]);
        } else if (line.span > 1) {
            emitDirective(joinDirective(lines, at, next), lines.origin(at), lines.source);
        } else {
            emitDirective(line.text, lines.origin(at), lines.source);
        }
        return next;
    }

    void noteChoice(const MacroDefinition& macro, Origin origin) {
        const std::size_t number = choices_.add(macro);
        const std::string name = choiceOf(macro.name);
        emitDirective("#undef " + name, origin, *macro.source);
        emitDirective(fmt::format("#define {} {}", name, number), origin, *macro.source);
    }

    /// A preprocessor line in one piece: of a text, or of a macro's body.
    void emitDirective(std::string_view text, Origin origin, const SourceText& source) {
        const Directive directive = readDirective(text);
        if (directive.kind == LineKind::Include) {
            include(directive.rest, text, origin, source);
        } else if (directive.kind == LineKind::Pragma) {
            pragma(directive.rest, text, origin);
        } else if (directive.kind != LineKind::Dropped) {
            FlatDirective note{directive.kind, lineCount(), out_.flat.text.size(), text.size(), nullptr,
                               nullptr,        origin};
            push(text, origin);
            if (isConditional(directive.kind) || directive.kind == LineKind::Define) out_.directives.push_back(note);
        }
    }

    void emitDefinition(const SourceLines& lines, std::size_t at, const MacroDefinition& macro) {
        const SourceLine& line = lines.source.lines[at];
        const Origin origin = lines.origin(at);
        const bool expanded = table_->isExpanded(macro.name);
        if (expanded && !macro.dead) latest_[macro.name] = &macro;
        if (!macro.dead && table_->isChosen(macro.name)) noteChoice(macro, origin);
        const FlatDirective note{line.kind, lineCount(), out_.flat.text.size(), 0, &macro, nullptr, origin};
        out_.directives.push_back(note);
        if (macro.fromPragma) return;  // Hoisted by the analysis.
        if (expanded) return push(fmt::format("#define {0} {0}", macro.name), origin);
        for (std::size_t i = at; i < at + line.span; ++i) {
            const bool adopts = macro.adoptsNextLine && i == at;
            push(std::string(lines.text(i)) + (adopts ? " \\" : ""), lines.origin(i));
        }
    }

    void include(std::string_view rest, std::string_view line, Origin origin, const SourceText& source) {
        const std::string_view name = includedName(rest);
        if (name.empty())
            return problems_.error(place(line, origin), "malformed #include", "write #include <chunk-name>");
        if (++includes_ > limits_.maxIncludes)
            return stop(line, origin, fmt::format("a stage has more than {} includes", limits_.maxIncludes));
        const auto found = chunks_.find(effect_, std::string(name), source.folder);
        if (found.source == nullptr)
            return problems_.error(place(line, origin), fmt::format("no chunk or program '{}' to include", name),
                                   found.help);
        if (reportCycle(*found.source, line, origin) || included_.contains(*found.source)) return;
        if (stack_.size() >= limits_.maxDepth)
            return stop(line, origin, fmt::format("includes are nested deeper than {}", limits_.maxDepth));
        emit(*found.source);
    }

    /// A chunk that includes itself vanishes like any second include, but it is a mistake; the engine's are let pass.
    bool reportCycle(const SourceText& target, std::string_view line, Origin origin) {
        const auto first = std::find(stack_.begin(), stack_.end(), &target);
        if (first == stack_.end()) return false;
        if (chunks_.isOfEngine(*stack_.back())) return true;
        std::string chain;
        for (auto it = first; it != stack_.end(); ++it) chain += (*it)->shown + " -> ";
        problems_.error(place(line, origin), fmt::format("include cycle: {}{}", chain, target.shown),
                        "move what both need into a third chunk");
        return true;
    }

    void pragma(std::string_view rest, std::string_view line, Origin origin) {
        Pragma read = readPragma(rest);
        if (!read.mistake.empty()) problems_.error(place(line, origin), read.mistake, std::string(pragmaExample(rest)));
        if (!read.extension.empty() &&
            std::find(out_.extensions.begin(), out_.extensions.end(), read.extension) == out_.extensions.end())
            out_.extensions.push_back(std::move(read.extension));
        if (read.meta) {
            read.meta->info.where = place(line, origin);
            out_.metas.push_back(std::make_unique<StageMacro>(std::move(*read.meta)));
            out_.directives.push_back({LineKind::Pragma, lineCount(), 0, 0, nullptr, out_.metas.back().get(), origin});
        }
        if (!read.mark) return;
        read.mark->line = static_cast<int>(lineCount()) + 1;
        out_.marks.push_back(std::move(*read.mark));
        push({}, origin);
    }

    /// A line of output that is being put together.
    struct Pending {
        std::string text;
        Origin origin{};
    };

    /// Expands the calls of line `at`, whose arguments may reach over the next ones. Returns the number of lines used.
    template <class Lines>
    std::size_t expandLine(const Lines& lines, std::size_t at, Pending& pending) {
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

    bool isOpenChoice(std::string_view name) const {
        return choices_.isOpen(name) && std::find(active_.begin(), active_.end(), name) == active_.end();
    }

    /// Does a text hold a call whose definition is not chosen, but for those of `name`?
    bool hasOpenChoice(std::string_view text, std::string_view name) const {
        for (std::size_t at = 0; (at = table_->findCall(text, at)) != std::string_view::npos;) {
            const std::string_view call = leadingName(text.substr(at));
            if (call != name && isOpenChoice(call)) return true;
            at += call.size();
        }
        return false;
    }

    /// A declaration whose head a condition chooses is written whole for each head: of one in pieces nobody could tell
    /// what it declares. Of several heads in one the last: each would double the text.
    template <class Lines>
    StatementRest restOfDeclaration(const Lines& lines, std::size_t at, std::size_t from, std::string_view name) {
        const auto& choices = choices_.of(name);
        const bool declares = std::any_of(choices.begin(), choices.end(), [&](const MacroDefinition* macro) {
            return macro->declares || (!macro->bearsDirectives && macro->body.size() == 1 &&
                                       table_->findCall(macro->body[0].text, 0) != std::string_view::npos);
        });
        if (!declares) return {};
        return readStatementRest(lines, at, from, limits_.maxArgument,
                                 [&](std::string_view part) { return hasOpenChoice(part, name); });
    }

    /// What the line that is being put together has of the present statement; the rest is written.
    std::string takeHead(Pending& pending) {
        const std::size_t end = pending.text.find_last_of(";{}");
        std::string head = end == std::string::npos ? pending.text : pending.text.substr(end + 1);
        pending.text.resize(pending.text.size() - head.size());
        flush(pending);
        return head;
    }

    /// Writes the call of a macro whose definition a condition chooses once for each: a line of code may be broken
    /// anywhere. Returns the line on which the call ends; `from` is the column behind it.
    template <class Lines>
    std::size_t expandChoices(const Lines& lines, std::size_t at, std::size_t call, std::string_view name,
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

    /// One of the definitions: those without parameters leave the brackets standing, those with them need brackets.
    bool expandChoice(const MacroDefinition& macro, const CallArguments& arguments, Origin origin, Pending& pending) {
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

    /// Writes a macro's body. True when its last line was a preprocessor line.
    bool expand(const MacroDefinition& macro, const std::vector<std::string>& arguments, Origin call,
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

    /// True when the last line was a preprocessor line. The first one goes on where `pending` is, if not `apart`.
    bool writeLines(const BodyLines& lines, Pending& pending, const SourceText& source, bool apart) {
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

    void flush(Pending& pending) {
        if (!trimBlank(pending.text).empty()) push(pending.text, pending.origin);
        pending.text.clear();
    }

    void push(std::string_view line, Origin origin) {
        write(line, origin, expandedFrom_);
        if (out_.flat.text.size() > limits_.maxBytes)
            stop(line, origin, fmt::format("the flattened stage is larger than {} MB", limits_.maxBytes >> 20));
    }

    void stopExpanding(const MacroDefinition& macro) {
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

    void stop(std::string_view line, Origin origin, std::string message,
              std::string help = "includes or macros grow without end") {
        if (stopped_) return;
        stopped_ = true;
        problems_.error(place(line, origin), std::move(message), std::move(help));
    }

    const EffectAsset& effect_;
    ChunkLibrary& chunks_;
    const FlattenLimits& limits_;
    Problems& problems_;
    const MacroTable* table_ = nullptr;
    std::unordered_map<std::string_view, const MacroDefinition*> latest_;  ///< As the text has defined them so far.
    MacroChoices choices_;
    IncludedTexts included_;
    std::vector<const SourceText*> stack_;
    std::vector<std::string_view> active_;  ///< Macros being expanded: they are not expanded within themselves.
    std::optional<Origin> expandedFrom_;    ///< The author's call that writes the present lines.
    SourceLoc callPlace_;                   ///< Of that call.
    std::size_t includes_ = 0, expansions_ = 0, written_ = 0;
    struct {
        std::size_t expansions = 0, written = 0;
    } before_;  ///< The counts before that call.
    std::uint32_t file_ = 0;
    bool endedInDirective_ = false;  ///< What the line expanded last ended in.
    bool stopped_ = false;
};

}  // namespace

Flattened flattenStage(const EffectAsset& effect, const std::string& program, const SourceLoc& where,
                       ChunkLibrary& chunks, const FlattenLimits& limits, Problems& problems) {
    return Flattener(effect, chunks, limits, problems).run(program, where);
}

}  // namespace crevice::cocos
