// Several definitions of a name become branches of one condition.
#include "cocos/flatten/HoistedMacros.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace crevice::cocos {

HoistedText hoistMacros(const std::vector<HoistedMacro>& hoisted, const std::unordered_set<std::string_view>& inText) {
    HoistedText out;
    std::unordered_map<std::string_view, std::vector<const HoistedMacro*>> byName;
    std::vector<std::string_view> order;
    for (const HoistedMacro& one : hoisted) {
        auto& same = byName[one.macro->name];
        if (same.empty()) order.push_back(one.macro->name);
        same.push_back(&one);
    }
    const auto write = [&](const std::string& line, FlatSource::Origin origin) {
        out.text += line + "\n";
        out.lines.push_back(origin);
    };
    for (const std::string_view name : order) {
        const auto& same = byName[name];
        const bool equal = std::all_of(same.begin(), same.end(), [&](const HoistedMacro* other) {
            return defineLine(*other->macro) == defineLine(*same[0]->macro);
        });
        // Where the text has a #define of the name too, both stand in branches of their own.
        const bool shared = inText.contains(name) && !same[0]->raw.empty();
        if (equal && !shared) {
            write(defineLine(*same[0]->macro), same[0]->origin);
            continue;
        }
        for (std::size_t i = 0; i < same.size(); ++i) {
            const auto& raw = same[i]->raw;
            write(fmt::format("#{} {}", i == 0 ? "if" : "elif",
                              raw.empty() ? "1" : fmt::format("{}", fmt::join(raw, " && "))),
                  same[i]->origin);
            write(defineLine(*same[i]->macro), same[i]->origin);
        }
        write("#endif", same.back()->origin);
    }
    return out;
}

}  // namespace crevice::cocos
