// Every file below a folder, behind links to folders too: one rule for what is found and for what its changes are seen
// by.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

namespace crevice::cocos {

/// Entries that all walks of one index may see together.
inline constexpr std::size_t kMaxWalkedEntries = 500'000;

enum class WalkEnd {
    Complete,
    Unreadable,  ///< A folder could not be read; the others were.
    TooMany,     ///< Stopped in the middle.
};

/// Hands over every entry below `folder` that is no folder, in no order; paths begin with `folder` as it is given.
/// Folders called node_modules or .git and those deeper than 60 levels are not entered. A linked folder is entered
/// unless the walk stands within it already, through at most four ways, and no longer once 100 000 entries were seen
/// behind links: circles end, and whatever lies in the folder itself is always found by its own name. `seen` counts
/// entries and may go on from another walk.
WalkEnd walkFiles(const std::filesystem::path& folder, std::size_t& seen,
                  const std::function<void(const std::filesystem::directory_entry&)>& visit);

}  // namespace crevice::cocos
