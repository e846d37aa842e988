// `#pragma define` holds for a whole stage wherever it stands: its macros go in front of everything.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "cocos/flatten/Flattener.h"

namespace crevice::cocos {

struct HoistedMacro {
    const MacroDefinition* macro = nullptr;
    FlatSource::Origin origin{};
    std::vector<std::string> raw;  ///< Conditions around it.
};

struct HoistedText {
    std::string text;
    std::vector<FlatSource::Origin> lines;
};

/// The lines that define the macros; definitions that differ keep their conditions. `inText` are the names for which
/// the text has a #define too.
HoistedText hoistMacros(const std::vector<HoistedMacro>& hoisted, const std::unordered_set<std::string_view>& inText);

}  // namespace crevice::cocos
