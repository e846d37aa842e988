// Nothing here throws: a cache is a convenience.
#include "core/CacheFile.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "core/Files.h"

namespace crevice {
namespace {

constexpr std::size_t kHashLength = 32;
constexpr std::size_t kMaxBytes = std::size_t(2) << 30;

}  // namespace

bool loadArrays(const std::filesystem::path& file, std::string_view magic,
                const std::vector<std::span<std::byte>>& arrays) {
    try {
        std::error_code error;
        if (!std::filesystem::is_regular_file(file, error)) return false;
        const std::vector<std::byte> bytes = readBytes(file, kMaxBytes);
        std::size_t expected = magic.size() + kHashLength;
        for (const auto& array : arrays) expected += array.size();
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        if (text.size() != expected || !text.starts_with(magic)) return false;
        const std::string_view body = text.substr(0, text.size() - kHashLength);
        if (contentHash(body) != text.substr(body.size())) return false;
        const std::byte* at = bytes.data() + magic.size();
        for (const auto& array : arrays) {
            std::copy_n(at, array.size(), array.data());
            at += array.size();
        }
        return true;
    } catch (const Error&) {
        return false;
    }
}

void storeArrays(const std::filesystem::path& file, std::string_view magic,
                 const std::vector<std::span<const std::byte>>& arrays) {
    std::string text(magic);
    for (const auto& array : arrays) text.append(reinterpret_cast<const char*>(array.data()), array.size());
    text += contentHash(text);
    if (text.size() > kMaxBytes) return;
    try {
        writeFileAtomically(file, text);
    } catch (const Error&) {
        // A full or read-only disk costs time, not correctness.
    }
}

}  // namespace crevice
