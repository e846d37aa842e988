// Finds the .meta files below folders, in a fixed order; links and depth cannot make the walk endless.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "core/Error.h"

namespace crevice::cocos {

/// What a walk may see before it stops with a warning.
struct WalkLimits {
    int maxDepth = 64;
    std::size_t maxEntries = 2'000'000;
};

/// Every X.meta whose X exists, sorted by path, root by root. Metas of metas and those whose asset is gone are left
/// out; hidden folders are not entered, and a folder that links reach again is entered once.
std::vector<std::filesystem::path> findMetaFiles(std::span<const std::filesystem::path> roots, Problems& problems,
                                                 const WalkLimits& limits = {});

}  // namespace crevice::cocos
