// What a macro of a stage's own text stands for when a condition names it.
#pragma once

#include <functional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "cocos/text/Conditions.h"
#include "cocos/text/SourceText.h"

namespace crevice::cocos {

/// Definitions by name; several where conditions choose one.
using MacroDefinitions = std::unordered_map<std::string_view, std::vector<const MacroDefinition*>>;

/// Follows macros through the macros they name.
class MacroAliases {
public:
    /// Words that all conditions of a stage together may lead to: time stays bounded.
    static constexpr std::size_t kMaxWords = 1'000'000;

    /// `isOutside` says of a name in a body whether it is a macro whose value comes from outside.
    MacroAliases(const MacroDefinitions& definitions, std::function<bool(std::string_view)> isOutside)
        : definitions_(definitions), isOutside_(std::move(isOutside)) {}

    /// The number that the macro is, when it has one definition, or the names from outside that it leads to, each once,
    /// in the order of the bodies. A macro that leads to itself stands for nothing there, as in a preprocessor.
    ConditionName follow(std::string_view name);

    /// More than kMaxWords were met: what `follow` gave is not complete.
    bool exhausted() const { return words_ > kMaxWords; }

private:
    void open(std::string_view name, std::vector<std::string_view>& bodies) const;

    const MacroDefinitions& definitions_;
    std::function<bool(std::string_view)> isOutside_;
    std::size_t words_ = 0;
};

}  // namespace crevice::cocos
