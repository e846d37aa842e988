// What it takes to write a call once for each of the definitions that a condition chooses between.
#pragma once

#include <string_view>
#include <unordered_set>
#include <vector>

#include "cocos/MacroCall.h"
#include "cocos/MacroTable.h"

namespace crevice::cocos {

struct FoundChoice {
    std::string_view name;   ///< Empty = none is left.
    std::size_t looked = 0;  ///< Bytes of further lines that were read for it.
};

/// The first macro to be chosen that line `at` calls and `known` does not have. The calls of the line may reach over
/// the next ones: these are looked at too, up to a preprocessor line or `maxBytes`.
FoundChoice findChoice(const MacroTable& table, const SourceLines& lines, std::size_t at,
                       const std::vector<std::string_view>& known, std::size_t maxBytes);

/// Which texts are in the stage already. Those that only another copy of a call has are no part of this one.
class IncludedTexts {
public:
    /// False when it was there.
    bool insert(const SourceText& text) {
        const bool isNew = seen_.insert(&text).second;
        if (isNew) order_.push_back(&text);
        return isNew;
    }
    bool contains(const SourceText& text) const { return seen_.contains(&text); }
    std::size_t size() const { return order_.size(); }
    /// Takes out what came behind the first `size` and returns it.
    std::vector<const SourceText*> cutTo(std::size_t size);

private:
    std::unordered_set<const SourceText*> seen_;
    std::vector<const SourceText*> order_;
};

}  // namespace crevice::cocos
