// Macros of which conditions choose a definition: what has been defined so far, and how far their calls reach.
#pragma once

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cocos/flatten/DefinedPlaces.h"
#include "cocos/flatten/MacroTable.h"
#include "cocos/text/MacroCall.h"

namespace crevice::cocos {

class MacroChoices {
public:
    /// Definitions of a name that conditions may choose between.
    static constexpr std::size_t kMaxOfName = 250;

    /// One of the definitions, with its number among those of its name, from 1.
    struct Option {
        const MacroDefinition* macro = nullptr;
        std::size_t number = 1;
    };
    /// Returns the definition's number: that of an equal one above. One that is `certain` ends all above.
    std::size_t add(const MacroDefinition& macro, DefinedPlaces::Place place, bool certain) {
        Name& name = choices_[macro.name];
        name.hoisted = name.hoisted || macro.fromPragma;
        if (certain && !name.hoisted) {
            name.all.clear();
            name.undone = false;
        }
        auto same = std::find_if(name.all.begin(), name.all.end(),
                                 [&](const Choice& one) { return areEqual(*one.option.macro, macro); });
        if (same == name.all.end()) same = name.all.insert(same, {{&macro, ++name.count}, {}, false});
        if (same->places.size() < kMaxPlaces)
            same->places.push_back(std::move(place));
        else
            same->elsewhere = true;
        return same->option.number;
    }
    bool contains(std::string_view name) const { return choices_.contains(name); }
    bool isTaken(std::string_view name) const { return std::find(taken_.begin(), taken_.end(), name) != taken_.end(); }
    bool isAnyTaken() const { return !taken_.empty(); }
    bool isEmpty() const { return choices_.empty(); }
    /// All definitions above.
    std::vector<Option> of(std::string_view name) const {
        return find(name, [](const Choice&) { return true; });
    }
    /// Those that may hold here.
    std::vector<Option> possible(std::string_view name, const DefinedPlaces& places) const {
        return find(name, [&](const Choice& choice) {
            return choice.elsewhere || std::any_of(choice.places.begin(), choice.places.end(),
                                                   [&](const auto& place) { return !places.excludes(place); });
        });
    }
    /// One of the definitions holds here whatever the conditions are.
    bool isSure(std::string_view name, const DefinedPlaces& places) const {
        const auto it = choices_.find(name);
        if (it == choices_.end() || it->second.hoisted || places.isSure(name)) return true;
        const auto holds = [&](const Choice& choice) {
            return std::any_of(choice.places.begin(), choice.places.end(),
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
    struct Choice {
        Option option;
        std::vector<DefinedPlaces::Place> places;  ///< Of the definition and of equal ones.
        bool elsewhere = false;                    ///< There are more places than are kept.
    };
    struct Name {
        std::vector<Choice> all;
        std::size_t count = 0;
        bool hoisted = false;  ///< `#pragma define` holds for the whole stage.
        bool undone = false;
    };
    template <class Accepts>
    std::vector<Option> find(std::string_view name, Accepts accepts) const {
        std::vector<Option> found;
        const auto it = choices_.find(name);
        if (it == choices_.end()) return found;
        for (const Choice& choice : it->second.all)
            if (it->second.hoisted || accepts(choice)) found.push_back(choice.option);
        return found;
    }

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
template <class Refuses>
StatementRest readStatementRest(const CodeLines& lines, std::size_t line, std::size_t at, std::size_t maxBytes,
                                Refuses refuses) {
    StatementRest rest;
    int depth = 0, conditions = 0;
    std::size_t bytes = 0;
    for (bool first = true; line < lines.size() && bytes <= maxBytes; ++line, at = 0, first = false) {
        std::string text(lines.text(line));
        const LineKind kind = first ? LineKind::Code : readDirective(text).kind;
        rest.lines.origins.push_back(lines.origin(line));
        std::size_t end = text.size();
        bool ends = false;
        if (kind == LineKind::Code) {
            for (end = at; end < text.size() && !ends; ++end) {
                depth += int(text[end] == '(' || text[end] == '{') - int(text[end] == ')' || text[end] == '}');
                if (depth < 0) return rest;
                ends = text[end] == ';' && depth == 0;
            }
            if (ends && conditions > 0) return rest;
            if (refuses(lines.text(line).substr(at, end - at))) return rest;
        } else if (isConditional(kind)) {
            const bool opens = kind == LineKind::If || kind == LineKind::Ifdef || kind == LineKind::Ifndef;
            if (!opens && conditions == 0) return rest;
            conditions += int(opens) - int(kind == LineKind::Endif);
            text = joinContinued(lines, line);
            end = text.size();
        } else {
            return rest;
        }
        bytes += end - at + 1;
        rest.lines.texts.push_back(text.substr(at, end - at));
        rest.line = line;
        rest.end = end;
        rest.found = ends;
        if (ends) return rest;
    }
    return rest;
}

}  // namespace crevice::cocos
