// What the tests of Cocos' dialect share: stages written down as the front end would hand them over.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "cocos/text/StageText.h"

namespace crevice::cocos {

/// A stage from a text without pragmas. Conditions of its lines are the caller's to add.
inline StageText stageText(ShaderStageBits stage, const std::string& text) {
    StageText result;
    result.stage = stage;
    result.flat.text = text;
    result.flat.files = {stage == kVertexBit ? "v.chunk" : "f.chunk"};
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    for (std::size_t i = 0; i < lines; ++i) result.flat.lines.push_back({0, static_cast<int>(i) + 1});
    result.conditionOf.assign(lines, 0);
    return result;
}

/// Lines first … last (counted from 1) stand in the given conditions.
inline void enclose(StageText& stage, int first, int last, std::vector<std::string> conditions) {
    stage.conditions.push_back(std::move(conditions));
    for (int line = first; line <= last; ++line)
        stage.conditionOf[static_cast<std::size_t>(line) - 1] = static_cast<std::uint32_t>(stage.conditions.size()) - 1;
}

}  // namespace crevice::cocos
