// Walks programs and chunks line by line.
#include "cocos/flatten/Flattener.h"

#include <fmt/format.h>

#include <algorithm>

#include "cocos/flatten/FlattenRun.h"
#include "cocos/text/Pragmas.h"

namespace crevice::cocos {

Flattened Flattener::run(const std::string& program, const SourceLoc& where) {
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
    for (const std::string_view name : table.hoisted()) places_.defineBefore(name);
    out_.flat.text.reserve(1u << 16);
    emit(*found.source);
    return std::move(out_);
}

void Flattener::emit(const SourceText& source) {
    included_.insert(source);
    stack_.push_back(&source);
    const std::uint32_t outer = file_;
    file_ = fileIndex(source.file);
    const SourceLines lines{source, file_};
    for (std::size_t at = 0; at < source.lines.size() && !stopped_;) at = emitLine(lines, at);
    file_ = outer;
    stack_.pop_back();
}

std::size_t Flattener::emitLine(const SourceLines& lines, std::size_t at) {
    const SourceLine& line = lines.source.lines[at];
    if (line.kind == LineKind::Code) {
        if (table_->findCall(line.text, 0) == std::string_view::npos) {
            push(withoutSplice(line.text), lines.origin(at));
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

void Flattener::emitDirective(std::string_view text, Origin origin, const SourceText& source) {
    if (captured_ != nullptr) return push(text, origin);
    const Directive directive = readDirective(text);
    if (directive.kind == LineKind::Include) {
        include(directive.rest, text, origin, source);
    } else if (directive.kind == LineKind::Pragma) {
        pragma(directive.rest, text, origin);
    } else if (directive.kind != LineKind::Dropped) {
        FlatDirective note{directive.kind, lineCount(), out_.flat.text.size(), text.size(), nullptr, nullptr, origin};
        push(text, origin);
        if (isConditional(directive.kind) || directive.kind == LineKind::Define) out_.directives.push_back(note);
        if (isConditional(directive.kind) && !places_.follow(directive.kind, directive.rest))
            stop(text, origin, fmt::format("conditions are nested deeper than {}", DefinedPlaces::kMaxDepth),
                 "close some of them: GLSL's preprocessor takes no more");
        if (directive.kind == LineKind::Define) places_.define(leadingName(directive.rest));
        if (directive.kind == LineKind::Undef) undefine(leadingName(trimBlank(directive.rest)), origin, source);
    }
}

void Flattener::emitDefinition(const SourceLines& lines, std::size_t at, const MacroDefinition& macro) {
    const SourceLine& line = lines.source.lines[at];
    const Origin origin = lines.origin(at);
    const bool expanded = table_->isExpanded(macro.name);
    const bool hidden = table_->isHidden(macro.name);
    // As for C's preprocessors, and unlike GLSL's, a second definition replaces the first.
    const bool replaces =
        expanded ? !hidden && !choices_.possible(macro.name, places_).empty() : table_->isRedefined(macro.name);
    const auto latest = latest_.find(macro.name);
    const bool holds = latest != latest_.end() && latest->second != nullptr && !choices_.contains(macro.name);
    if (expanded && !macro.dead) latest_[macro.name] = &macro;
    places_.define(macro.name);
    // An equal one that stands above all conditions holds in any case.
    const bool uncertain = !macro.fromPragma && !holds && (places_.isConditional() || table_->isUndefined(macro.name));
    if (!macro.dead && (table_->isChosen(macro.name) || (expanded && uncertain))) noteChoice(macro, origin);
    if (replaces && !macro.fromPragma) push(fmt::format("#undef {}", macro.name), origin);
    const FlatDirective note{line.kind, lineCount(), out_.flat.text.size(), 0, &macro, nullptr, origin};
    out_.directives.push_back(note);
    if (macro.fromPragma) return;  // Hoisted by the analysis.
    if (expanded && hidden) return push(fmt::format("#define {0} {0}", macro.name), origin);
    for (std::size_t i = at; i < at + line.span; ++i) {
        const bool adopts = macro.adoptsNextLine && i == at;
        push(std::string(lines.text(i)) + (adopts ? " \\" : ""), lines.origin(i));
    }
}

void Flattener::include(std::string_view rest, std::string_view line, Origin origin, const SourceText& source) {
    const std::string_view name = includedName(rest);
    if (name.empty()) return problems_.error(place(line, origin), "malformed #include", "write #include <chunk-name>");
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

bool Flattener::reportCycle(const SourceText& target, std::string_view line, Origin origin) {
    const auto first = std::find(stack_.begin(), stack_.end(), &target);
    if (first == stack_.end()) return false;
    if (chunks_.isOfEngine(*stack_.back())) return true;
    std::string chain;
    for (auto it = first; it != stack_.end(); ++it) chain += (*it)->shown + " -> ";
    problems_.error(place(line, origin), fmt::format("include cycle: {}{}", chain, target.shown),
                    "move what both need into a third chunk");
    return true;
}

void Flattener::pragma(std::string_view rest, std::string_view line, Origin origin) {
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

void Flattener::push(std::string_view line, Origin origin) {
    if (captured_ != nullptr) {
        captured_->append(line).push_back('\n');
        return;
    }
    if (line.find(kFinal) == std::string_view::npos) {
        write(line, origin, expandedFrom_);
    } else {
        std::string plain(line);
        std::erase(plain, kFinal);
        write(plain, origin, expandedFrom_);
    }
    if (out_.flat.text.size() > limits_.maxBytes)
        stop(line, origin, fmt::format("the flattened stage is larger than {} MB", limits_.maxBytes >> 20));
}

void Flattener::stop(std::string_view line, Origin origin, std::string message, std::string help) {
    if (stopped_) return;
    stopped_ = true;
    problems_.error(place(line, origin), std::move(message), std::move(help));
}

Flattened flattenStage(const EffectAsset& effect, const std::string& program, const SourceLoc& where,
                       ChunkLibrary& chunks, const FlattenLimits& limits, Problems& problems) {
    return Flattener(effect, chunks, limits, problems).run(program, where);
}

}  // namespace crevice::cocos
