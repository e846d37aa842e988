// Which texts are in a stage already.
#pragma once

#include <unordered_set>
#include <vector>

#include "cocos/text/SourceText.h"

namespace crevice::cocos {

/// In the order in which they came: those that only one copy of a call has are no part of the next.
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
    std::vector<const SourceText*> cutTo(std::size_t size) {
        const auto first = order_.begin() + static_cast<std::ptrdiff_t>(size);
        std::vector<const SourceText*> cut(first, order_.end());
        order_.erase(first, order_.end());
        for (const SourceText* text : cut) seen_.erase(text);
        return cut;
    }

private:
    std::unordered_set<const SourceText*> seen_;
    std::vector<const SourceText*> order_;
};

}  // namespace crevice::cocos
