// Which macros of a stage must be expanded in its text, before GLSL's own preprocessor sees it.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "cocos/text/SourceText.h"

namespace crevice::cocos {

/// All macros of the texts that a program includes, wherever they stand: `#pragma define` holds for the whole stage.
/// Expanded are those whose body bears preprocessor lines or interface declarations, those that call such a one, and
/// those between whose brackets preprocessor lines or interface words stand or come to stand.
class MacroTable {
public:
    /// What an #include in `from` means; null = nothing, somebody else reports it.
    using Resolve = std::function<const SourceText*(const SourceText& from, std::string_view rest)>;

    /// At most `maxSources` texts are looked at.
    MacroTable(const SourceText& program, const Resolve& resolve, std::size_t maxSources);

    bool isExpanded(std::string_view name) const { return expanded_.contains(name); }
    /// The first definition in the order of the texts.
    const MacroDefinition* find(std::string_view name) const;
    /// True for an expanded name with definitions that differ: a condition chooses between them when the shader runs.
    bool isChosen(std::string_view name) const { return chosen_.contains(name); }
    /// True for a name with definitions that differ, wherever they stand.
    bool isRedefined(std::string_view name) const { return redefined_.contains(name); }
    /// True when the bodies of an expanded name may lead to it again: within itself it is not expanded.
    bool isRecursive(std::string_view name) const { return recursive_.contains(name); }
    /// True for an expanded name that GLSL's preprocessor may not see the definition of. Others it may: conditions name
    /// them too.
    bool isHidden(std::string_view name) const { return hidden_.contains(name); }
    /// An #undef of the name stands somewhere.
    bool isUndefined(std::string_view name) const { return undefined_.contains(name); }
    /// Macros of `#pragma define`.
    const std::vector<std::string_view>& hoisted() const { return hoisted_; }
    /// Where the next name to be expanded stands in a line of code, from `from` on; npos = nowhere.
    std::size_t findCall(std::string_view text, std::size_t from) const;

private:
    void visit(const SourceText& source, const Resolve& resolve, std::size_t maxSources);
    void chooseExpanded();
    void findCallers();
    void expandCallers();
    bool expandAround();
    bool carryAll(const std::unordered_set<std::string_view>& names);
    void chooseChosen();
    void findRedefined();
    void findRecursive();
    void expand(std::string_view name);
    std::unordered_set<std::string_view> findSplitting() const;

    std::vector<const MacroDefinition*> all_;
    std::vector<const SourceText*> sources_;
    std::unordered_set<const SourceText*> seen_;
    std::unordered_map<std::string_view, std::vector<const MacroDefinition*>> byName_;
    std::unordered_map<std::string_view, std::vector<const MacroDefinition*>> callers_;  ///< In whose body it stands.
    std::unordered_set<std::string_view> expanded_, chosen_, redefined_, recursive_, hidden_, undefined_;
    std::unordered_set<std::string_view> uncertain_;     ///< Defined in conditions.
    std::unordered_set<const SourceText*> conditional_;  ///< Included in conditions.
    std::vector<std::string_view> hoisted_;
    std::vector<std::string_view> unfollowed_;       ///< Expanded names whose callers are to be expanded too.
    std::unordered_set<std::string_view> carrying_;  ///< Between whose brackets such come to stand.
    std::array<bool, 128> firstLetters_{};           ///< Of the expanded names: most words are passed over by one look.
};

/// The same parameters and the same words in the same lines.
bool areEqual(const MacroDefinition& a, const MacroDefinition& b);

/// The macro that says in a text which definition of a chosen one holds, 1 for the first.
inline std::string choiceOf(std::string_view name) { return "crevice_choice_" + std::string(name); }

}  // namespace crevice::cocos
