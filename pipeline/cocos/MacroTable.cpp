// Collects macros over all includes and finds those that GLSL's preprocessor cannot expand.
#include "cocos/MacroTable.h"

#include <algorithm>

namespace crevice::cocos {

MacroTable::MacroTable(const SourceText& program, const Resolve& resolve, std::size_t maxSources) {
    visit(program, resolve, maxSources);
    chooseExpanded();
    chooseChosen();
}

void MacroTable::visit(const SourceText& root, const Resolve& resolve, std::size_t maxSources) {
    std::vector<const SourceText*> waiting{&root};
    while (!waiting.empty() && seen_.size() < maxSources) {
        const SourceText& source = *waiting.back();
        waiting.pop_back();
        if (!seen_.insert(&source).second) continue;
        for (const MacroDefinition& macro : source.macros)
            if (!macro.dead) all_.push_back(&macro);
        const auto follow = [&](std::string_view rest) {
            const SourceText* next = resolve(source, rest);
            if (next != nullptr && !seen_.contains(next)) waiting.push_back(next);
        };
        for (const SourceLine& line : source.lines)
            if (line.kind == LineKind::Include) follow(readDirective(line.text).rest);
        for (const MacroDefinition& macro : source.macros) {
            if (!macro.bearsDirectives) continue;
            for (const auto& part : macro.body)
                if (const Directive directive = readDirective(part.text); directive.kind == LineKind::Include)
                    follow(directive.rest);
        }
    }
    for (const MacroDefinition* macro : all_) first_.emplace(macro->name, macro);
}

void MacroTable::chooseExpanded() {
    for (const MacroDefinition* macro : all_)
        if (macro->bearsDirectives || macro->declares) expand(macro->name);
    if (expanded_.empty()) return;
    const auto calls = [&](const MacroDefinition& macro) {
        return std::any_of(macro.body.begin(), macro.body.end(),
                           [&](const auto& part) { return findCall(part.text, 0) != std::string_view::npos; });
    };
    for (bool grown = true; grown;) {
        grown = false;
        for (const MacroDefinition* macro : all_) {
            if (expanded_.contains(macro->name) || !calls(*macro)) continue;
            expand(macro->name);
            grown = true;
        }
    }
}

void MacroTable::chooseChosen() {
    const auto equal = [](const MacroDefinition& a, const MacroDefinition& b) {
        return a.parameters == b.parameters && a.functionLike == b.functionLike &&
               std::equal(a.body.begin(), a.body.end(), b.body.begin(), b.body.end(),
                          [](const auto& x, const auto& y) { return trimBlank(x.text) == trimBlank(y.text); });
    };
    for (const MacroDefinition* macro : all_)
        if (expanded_.contains(macro->name) && !equal(*macro, *find(macro->name))) chosen_.insert(macro->name);
}

void MacroTable::expand(std::string_view name) {
    expanded_.insert(name);
    firstLetters_[static_cast<unsigned char>(name.front()) & 127u] = true;
}

const MacroDefinition* MacroTable::find(std::string_view name) const {
    const auto it = first_.find(name);
    return it == first_.end() ? nullptr : it->second;
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
        if (isNameStart(c) && firstLetters_[static_cast<unsigned char>(c) & 127u] &&
            expanded_.contains(text.substr(i, end - i)))
            return i;
        i = end;
    }
    return std::string_view::npos;
}

}  // namespace crevice::cocos
