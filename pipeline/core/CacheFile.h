// A file of arrays that only its content vouches for: magic, the arrays one after the other, the hash of all that.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace crevice {

/// Fills all arrays, whose sizes must be those of the file. False, with nothing changed, when there is no such file or
/// it is damaged.
bool loadArrays(const std::filesystem::path& file, std::string_view magic,
                const std::vector<std::span<std::byte>>& arrays);
/// Writes aside, then renames. A folder that cannot be written is no error.
void storeArrays(const std::filesystem::path& file, std::string_view magic,
                 const std::vector<std::span<const std::byte>>& arrays);

}  // namespace crevice
