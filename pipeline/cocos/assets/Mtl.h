// A .mtl file: which effect, and per pass which macros, states and property values. Nothing is looked up here.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cocos/assets/TypedValue.h"

namespace crevice::cocos {

struct MtlProperty {
    std::string name{};
    TypedValue value{};
    SourceLoc where{};
};

/// What a material says of one pass, by the pass' number in the technique.
struct MtlPass {
    Value defines{};  ///< Object: bools, numbers, words.
    Value states;     ///< Object; enums are Cocos' integers.
    std::vector<MtlProperty> properties{};
};

struct Mtl {
    std::string name{}, path{};
    AssetRef effect{};
    std::size_t technique = 0;
    std::vector<MtlPass> passes{};  ///< As many as the longest of the file's three lists.
    SourceLoc where{}, techniqueWhere{};
};

/// Throws Error for a file that is no material at all; collects what is wrong inside one.
Mtl readMtl(const std::filesystem::path& path, Problems& problems);
Mtl parseMtl(std::string_view text, const std::string& file, Problems& problems);

}  // namespace crevice::cocos
