// Collects macros over all includes and finds those that GLSL's preprocessor cannot expand.
#include "cocos/flatten/MacroTable.h"

#include <algorithm>

namespace crevice::cocos {
namespace {

constexpr int kMaxPasses = 16;                    ///< Macros in macros' brackets in macros' brackets.
constexpr std::size_t kMaxLookedBack = 8u << 20;  ///< Bytes, for the brackets around the calls of a stage.

/// The name or number that begins at `at`.
std::string_view namePartsAt(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && isNamePart(text[end])) ++end;
    return text.substr(at, end - at);
}

bool pastes(const MacroDefinition& macro) {
    return std::any_of(macro.body.begin(), macro.body.end(),
                       [](const auto& part) { return part.text.find("##") != std::string_view::npos; });
}

}  // namespace

bool areEqual(const MacroDefinition& a, const MacroDefinition& b) {
    return a.parameters == b.parameters && a.functionLike == b.functionLike &&
           std::equal(a.body.begin(), a.body.end(), b.body.begin(), b.body.end(),
                      [](const auto& x, const auto& y) { return trimBlank(x.text) == trimBlank(y.text); });
}

MacroTable::MacroTable(const SourceText& program, const Resolve& resolve, std::size_t maxSources) {
    visit(program, resolve, maxSources);
    findRedefined();
    chooseExpanded();
}

void MacroTable::visit(const SourceText& root, const Resolve& resolve, std::size_t maxSources) {
    std::vector<const SourceText*> waiting{&root};
    while (!waiting.empty() && seen_.size() < maxSources) {
        const SourceText& source = *waiting.back();
        waiting.pop_back();
        if (!seen_.insert(&source).second) continue;
        sources_.push_back(&source);
        for (const MacroDefinition& macro : source.macros) {
            if (!macro.dead) all_.push_back(&macro);
            if (macro.conditional || conditional_.contains(&source)) uncertain_.insert(macro.name);
        }
        const auto follow = [&](std::string_view rest, bool conditional) {
            const SourceText* next = resolve(source, rest);
            if (next == nullptr || seen_.contains(next)) return;
            if (conditional || conditional_.contains(&source)) conditional_.insert(next);
            waiting.push_back(next);
        };
        for (const SourceLine& line : source.lines) {
            if (line.kind == LineKind::Include) follow(readDirective(line.text).rest, line.conditional);
            if (line.kind == LineKind::Undef) undefined_.insert(leadingName(readDirective(line.text).rest));
        }
        for (const MacroDefinition& macro : source.macros) {
            if (!macro.bearsDirectives) continue;
            for (const auto& part : macro.body)
                if (const Directive directive = readDirective(part.text); directive.kind == LineKind::Include)
                    follow(directive.rest, true);
                else if (directive.kind == LineKind::Undef)
                    undefined_.insert(leadingName(directive.rest));
        }
    }
    for (const MacroDefinition* macro : all_) {
        byName_[macro->name].push_back(macro);
        if (macro->fromPragma) hoisted_.push_back(macro->name);
    }
}

void MacroTable::chooseExpanded() {
    for (const MacroDefinition* macro : all_)
        if (macro->bearsDirectives || macro->declares) expand(macro->name);
    for (const SourceText* source : sources_) {
        carryAll(source->splitCalls);
        carryAll(source->declaringCalls);
    }
    if (expanded_.empty()) return;
    for (const MacroDefinition* macro : all_)
        if (pastes(*macro)) expand(macro->name);  // It may write the name of one.
    for (int pass = 0; pass < kMaxPasses; ++pass) {
        expandCallers();
        chooseChosen();
        if (!expandAround()) break;
    }
    findRecursive();
    hidden_ = recursive_;
    for (const MacroDefinition* macro : all_)
        if (macro->bearsDirectives || macro->declares) hidden_.insert(macro->name);
}

/// What is left when names that no body leads to are taken away, and those whose bodies lead nowhere: cycles, and what
/// stands between two of them.
void MacroTable::findRecursive() {
    std::unordered_map<std::string_view, std::unordered_set<std::string_view>> into, out;
    for (const std::string_view name : expanded_) {
        const auto callers = callers_.find(name);
        if (callers == callers_.end()) continue;
        for (const MacroDefinition* caller : callers->second)
            if (expanded_.contains(caller->name)) {
                into[name].insert(caller->name);
                out[caller->name].insert(name);
            }
    }
    recursive_ = expanded_;
    constexpr std::string_view kAny;  // What is pasted may be any name.
    for (const MacroDefinition* macro : all_) {
        if (!pastes(*macro)) continue;
        into[kAny].insert(macro->name);
        out[macro->name].insert(kAny);
    }
    if (into.contains(kAny)) {
        recursive_.insert(kAny);
        out[kAny] = expanded_;
        for (const std::string_view name : expanded_) into[name].insert(kAny);
    }
    const auto takeAway = [&](auto& edges, auto& back) {
        std::vector<std::string_view> waiting;
        for (const std::string_view name : recursive_)
            if (edges[name].empty()) waiting.push_back(name);
        while (!waiting.empty()) {
            const std::string_view name = waiting.back();
            waiting.pop_back();
            recursive_.erase(name);
            for (const std::string_view other : back[name]) {
                edges[other].erase(name);
                if (edges[other].empty() && recursive_.contains(other)) waiting.push_back(other);
            }
            back[name].clear();
        }
    };
    takeAway(out, into);
    takeAway(into, out);
}

void MacroTable::findCallers() {
    for (const MacroDefinition* macro : all_)
        for (const auto& part : macro->body)
            for (std::size_t at = 0; at < part.text.size();) {
                const std::string_view word = namePartsAt(part.text, at);
                at += std::max<std::size_t>(1, word.size());
                if (word.empty() || !byName_.contains(word)) continue;
                auto& callers = callers_[word];
                if (callers.empty() || callers.back() != macro) callers.push_back(macro);
            }
}

/// Each name is followed once, whatever the order of the definitions.
void MacroTable::expandCallers() {
    if (callers_.empty()) findCallers();
    while (!unfollowed_.empty()) {
        const auto callers = callers_.find(unfollowed_.back());
        unfollowed_.pop_back();
        if (callers == callers_.end()) continue;
        for (const MacroDefinition* macro : callers->second) expand(macro->name);
    }
}

/// Whoever is called within a carrying macro may be given what it carries, and so may a macro that only names another.
bool MacroTable::carryAll(const std::unordered_set<std::string_view>& names) {
    bool grown = false;
    std::vector<std::string_view> waiting(names.begin(), names.end());
    while (!waiting.empty()) {
        const auto known = byName_.find(waiting.back());
        waiting.pop_back();
        if (known == byName_.end() || !carrying_.insert(known->first).second) continue;
        for (const MacroDefinition* macro : known->second) {
            if (macro->functionLike && !expanded_.contains(macro->name)) {
                expand(macro->name);
                grown = true;
            }
            for (const auto& part : macro->body)
                for (std::size_t at = 0; at < part.text.size();) {
                    const std::string_view word = leadingName(part.text.substr(at));
                    if (!word.empty()) waiting.push_back(word);
                    at += std::max<std::size_t>(1, word.size());
                }
        }
    }
    return grown;
}

/// What becomes more than one line when it is written out.
std::unordered_set<std::string_view> MacroTable::findSplitting() const {
    std::unordered_set<std::string_view> splitting = chosen_;
    for (const auto* names : {&uncertain_, &undefined_})
        for (const std::string_view name : *names)
            if (expanded_.contains(name)) splitting.insert(name);
    for (const MacroDefinition* macro : all_)
        if (macro->bearsDirectives) splitting.insert(macro->name);
    if (!splitting.empty())
        for (const MacroDefinition* macro : all_)
            if (pastes(*macro)) splitting.insert(macro->name);  // It may write the name of one.
    const auto leads = [&](const MacroDefinition& macro) {
        for (const auto& part : macro.body)
            for (std::size_t at = 0; (at = findCall(part.text, at)) != std::string_view::npos;) {
                const std::string_view name = leadingName(part.text.substr(at));
                if (splitting.contains(name)) return true;
                at += name.size();
            }
        return false;
    };
    bool grown = !splitting.empty();
    for (int pass = 0; grown && pass < kMaxPasses; ++pass) {
        grown = false;
        for (const MacroDefinition* macro : all_)
            if (expanded_.contains(macro->name) && !splitting.contains(macro->name) && leads(*macro))
                grown = splitting.insert(macro->name).second || grown;
    }
    return splitting;
}

/// GLSL's preprocessor takes no preprocessor lines between a macro's brackets.
bool MacroTable::expandAround() {
    const auto isWaiting = [&](const MacroDefinition* macro) {
        return macro->functionLike && !expanded_.contains(macro->name);
    };
    if (std::none_of(all_.begin(), all_.end(), isWaiting)) return false;
    const auto splitting = findSplitting();
    if (splitting.empty()) return false;
    std::unordered_set<std::string_view> names;
    std::size_t looked = 0;
    const auto lookBack = [&](std::size_t count, auto lineOf, auto isCode) {
        for (std::size_t line = 0; line < count; ++line) {
            if (!isCode(line)) continue;
            const std::string_view text = lineOf(line);
            for (std::size_t at = 0; (at = findCall(text, at)) != std::string_view::npos;) {
                const std::string_view name = leadingName(text.substr(at));
                OpenCalls open(names);
                bool reads = splitting.contains(name) && open.readBack(text.substr(0, at));
                for (std::size_t i = line; reads && i-- > 0 && line - i < kMostCallLines;) {
                    reads = isCode(i) ? open.readBack(lineOf(i)) : true;
                    looked += lineOf(i).size();
                }
                at += name.size();
                looked += at;
                if (looked > kMaxLookedBack) return;
            }
        }
    };
    for (const SourceText* source : sources_)
        lookBack(
            source->lines.size(), [&](std::size_t i) { return source->lines[i].text; },
            [&](std::size_t i) { return isCodeLine(*source, i); });
    for (const MacroDefinition* macro : all_)
        lookBack(
            macro->body.size(), [&](std::size_t i) { return macro->body[i].text; },
            [&](std::size_t i) { return readDirective(macro->body[i].text).kind == LineKind::Code; });
    for (const MacroDefinition* macro : all_) {
        for (std::size_t line = 0; macro->bearsDirectives && line < macro->body.size(); ++line) {
            if (!isConditional(readDirective(macro->body[line].text).kind)) continue;
            OpenCalls open(names);
            for (std::size_t i = line; i-- > 0 && line - i < kMostCallLines;)
                if (readDirective(macro->body[i].text).kind == LineKind::Code && !open.readBack(macro->body[i].text))
                    break;
        }
    }
    return carryAll(names);
}

void MacroTable::findRedefined() {
    for (const auto& [name, definitions] : byName_)
        for (const MacroDefinition* macro : definitions)
            if (!areEqual(*macro, *definitions.front())) redefined_.insert(name);
}

void MacroTable::chooseChosen() {
    for (const std::string_view name : redefined_)
        if (expanded_.contains(name)) chosen_.insert(name);
}

void MacroTable::expand(std::string_view name) {
    if (!expanded_.insert(name).second) return;
    unfollowed_.push_back(name);
    firstLetters_[static_cast<unsigned char>(name.front()) & 127u] = true;
}

const MacroDefinition* MacroTable::find(std::string_view name) const {
    const auto it = byName_.find(name);
    return it == byName_.end() ? nullptr : it->second.front();
}

std::size_t MacroTable::findCall(std::string_view text, std::size_t from) const {
    if (expanded_.empty()) return std::string_view::npos;
    for (std::size_t i = from; i < text.size();) {
        const char c = text[i];
        if (!isNamePart(c)) {
            ++i;
            continue;
        }
        std::size_t end = i + 1;
        while (end < text.size() && isNamePart(text[end])) ++end;
        if (isNameStart(c) && (i == 0 || text[i - 1] != kFinal) &&
            firstLetters_[static_cast<unsigned char>(c) & 127u] && expanded_.contains(text.substr(i, end - i)))
            return i;
        i = end;
    }
    return std::string_view::npos;
}

}  // namespace crevice::cocos
