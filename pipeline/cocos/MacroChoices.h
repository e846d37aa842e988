// Macros of which conditions choose a definition: what has been defined so far, and how far their calls reach.
#pragma once

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "cocos/MacroCall.h"

namespace crevice::cocos {

class MacroChoices {
public:
    /// Returns the definition's number among those of its name, from 1.
    std::size_t add(const MacroDefinition& macro) {
        auto& all = choices_[macro.name];
        all.push_back(&macro);
        return all.size();
    }
    /// Several definitions of the macro stand above, and none of them is taken yet.
    bool isOpen(std::string_view name) const {
        const auto it = choices_.find(name);
        return it != choices_.end() && it->second.size() > 1 &&
               std::find(taken_.begin(), taken_.end(), name) == taken_.end();
    }
    bool isEmpty() const { return choices_.empty(); }
    const std::vector<const MacroDefinition*>& of(std::string_view name) { return choices_[name]; }
    /// From here to release() one of the definitions holds.
    void take(std::string_view name) { taken_.push_back(name); }
    void release() { taken_.pop_back(); }

private:
    std::unordered_map<std::string_view, std::vector<const MacroDefinition*>> choices_;
    std::vector<std::string_view> taken_;
};

/// What follows a call up to the ';' of its statement, with conditions between its lines.
struct StatementRest {
    bool found = false;
    BodyLines lines;
    std::size_t line = 0, end = 0;  ///< Behind the ';'.
};

/// Reads on from column `at` of line `line`. Not found when brackets cross, other preprocessor lines come between, the
/// text is too long or `refuses` a part of it.
template <class Lines, class Refuses>
StatementRest readStatementRest(const Lines& lines, std::size_t line, std::size_t at, std::size_t maxBytes,
                                Refuses refuses) {
    StatementRest rest;
    int depth = 0;
    std::size_t bytes = 0;
    for (bool first = true; line < lines.size() && bytes <= maxBytes; ++line, at = 0, first = false) {
        const std::string_view text = lines.text(line);
        const LineKind kind = first ? LineKind::Code : readDirective(text).kind;
        std::size_t end = text.size();
        bool ends = false;
        if (kind == LineKind::Code) {
            for (end = at; end < text.size() && !ends; ++end) {
                depth += int(text[end] == '(' || text[end] == '{') - int(text[end] == ')' || text[end] == '}');
                if (depth < 0) return rest;
                ends = text[end] == ';' && depth == 0;
            }
            if (refuses(text.substr(at, end - at))) return rest;
        } else if (!isConditional(kind) || text.ends_with('\\')) {
            return rest;
        }
        rest.lines.texts.emplace_back(text.substr(at, end - at));
        rest.lines.origins.push_back(lines.origin(line));
        bytes += end - at + 1;
        rest.line = line;
        rest.end = end;
        rest.found = ends;
        if (ends) return rest;
    }
    return rest;
}

}  // namespace crevice::cocos
