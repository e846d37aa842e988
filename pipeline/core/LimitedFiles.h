// Files within what `--limit file-bytes` allows.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace crevice {

/// readBytes() and readText() whose error for a larger file names the limit to raise. `most`: Limits::maxFileBytes, or
/// what is left of it.
std::vector<std::byte> readBytesWithin(const std::filesystem::path& path, std::size_t most);
std::string readTextWithin(const std::filesystem::path& path, std::size_t most);

}  // namespace crevice
