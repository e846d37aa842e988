// Macros of which conditions choose a definition: what has been defined so far, and how far their calls reach.
#pragma once

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cocos/DefinedPlaces.h"
#include "cocos/MacroCall.h"

namespace crevice::cocos {

class MacroChoices {
public:
    struct Choice {
        const MacroDefinition* macro = nullptr;
        std::vector<DefinedPlaces::Place> places;  ///< Of the definition and of equal ones.
        std::size_t number = 1;                    ///< Among the definitions of its name.
    };
    /// Returns the definition's number among those of its name, from 1. One `equal` to those above joins them.
    std::size_t add(const MacroDefinition& macro, DefinedPlaces::Place place, bool equal) {
        Name& name = choices_[macro.name];
        name.hoisted = name.hoisted || macro.fromPragma;
        if (!equal || name.all.empty()) name.all.push_back({&macro, {}, name.all.size() + 1});
        if (auto& places = name.all.back().places; places.size() < kMaxPlaces) places.push_back(std::move(place));
        return name.all.size();
    }
    bool contains(std::string_view name) const { return choices_.contains(name); }
    bool isTaken(std::string_view name) const { return std::find(taken_.begin(), taken_.end(), name) != taken_.end(); }
    bool isEmpty() const { return choices_.empty(); }
    const std::vector<Choice>& of(std::string_view name) { return choices_[name].all; }
    /// The definitions above that may hold here.
    std::vector<Choice> possible(std::string_view name, const DefinedPlaces& places) const {
        std::vector<Choice> found;
        const auto it = choices_.find(name);
        if (it == choices_.end()) return found;
        for (const Choice& choice : it->second.all)
            if (it->second.hoisted || std::any_of(choice.places.begin(), choice.places.end(),
                                                  [&](const auto& place) { return !places.excludes(place); }))
                found.push_back(choice);
        return found;
    }
    /// One of the definitions holds here whatever the conditions are.
    bool isSure(std::string_view name, const DefinedPlaces& places) const {
        const auto it = choices_.find(name);
        if (it == choices_.end() || it->second.hoisted || places.isSure(name)) return true;
        const auto holds = [&](const Choice& choice) {
            return choice.places.size() == kMaxPlaces ||
                   std::any_of(choice.places.begin(), choice.places.end(),
                               [&](const auto& place) { return places.implies(place); });
        };
        return !it->second.undone && std::any_of(it->second.all.begin(), it->second.all.end(), holds);
    }
    /// Several definitions of the macro may hold, or one or none, and none of them is taken yet.
    bool isOpen(std::string_view name, const DefinedPlaces& places) const {
        if (!contains(name) || isTaken(name)) return false;
        const std::size_t count = possible(name, places).size();
        return count > 1 || (count == 1 && !isSure(name, places));
    }
    /// An #undef: of all definitions above, or in a branch that may not be taken.
    void undefine(std::string_view name, bool conditional) {
        const auto it = choices_.find(name);
        if (it == choices_.end()) return;
        if (conditional)
            it->second.undone = true;
        else
            choices_.erase(it);
    }
    /// From here to release() one of the definitions holds, or none.
    void take(std::string_view name) { taken_.push_back(name); }
    void release() { taken_.pop_back(); }

private:
    static constexpr std::size_t kMaxPlaces = 16;
    struct Name {
        std::vector<Choice> all;
        bool hoisted = false;  ///< `#pragma define` holds for the whole stage.
        bool undone = false;
    };
    std::unordered_map<std::string_view, Name> choices_;
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
