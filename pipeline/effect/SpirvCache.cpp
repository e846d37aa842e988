// Files of the cache: magic, body, then the content hash of both.
#include "effect/SpirvCache.h"

#include "core/Files.h"

namespace crevice {
namespace {

constexpr std::string_view kMagic = "CREVICE SPIRV 6\n";
constexpr std::size_t kHashLength = 32;
constexpr std::size_t kMaxBytes = 64u << 20;

}  // namespace

std::optional<std::string> SpirvCache::read(const std::string& file) const {
    if (!folder_) return std::nullopt;
    try {
        std::error_code error;
        const auto path = *folder_ / file;
        if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
        std::string bytes = readText(path, kMaxBytes);
        if (!bytes.starts_with(kMagic) || bytes.size() < kMagic.size() + kHashLength) return std::nullopt;
        const std::string hash = bytes.substr(bytes.size() - kHashLength);
        bytes.resize(bytes.size() - kHashLength);
        if (contentHash(bytes) != hash) return std::nullopt;
        bytes.erase(0, kMagic.size());
        return bytes;
    } catch (const Error&) {
        return std::nullopt;
    }
}

void SpirvCache::write(const std::string& file, const std::string& body) const {
    if (!folder_) return;
    try {
        const std::string bytes = std::string(kMagic) + body;
        writeFileAtomically(*folder_ / file, bytes + contentHash(bytes));
    } catch (const Error&) {
        // A full or read-only disk costs time, not correctness.
    }
}

std::optional<CompiledPass> SpirvCache::load(const std::string& key) const {
    const auto bytes = read(key + ".spv");
    return bytes ? compiledPassFrom(*bytes) : std::nullopt;
}

void SpirvCache::store(const std::string& key, const CompiledPass& pass) const {
    if (folder_) write(key + ".spv", toBytes(pass));
}

std::optional<SpirvCache::Answer> SpirvCache::loadAnswer(const std::string& request) const {
    const auto bytes = read(request + ".ask");
    if (!bytes || bytes->size() < kHashLength) return std::nullopt;
    auto problems = problemsFrom(std::string_view(*bytes).substr(kHashLength));
    if (!problems) return std::nullopt;
    return Answer{bytes->substr(0, kHashLength), std::move(*problems)};
}

void SpirvCache::storeAnswer(const std::string& request, const Answer& answer) const {
    if (folder_) write(request + ".ask", answer.content + toBytes(answer.problems));
}

}  // namespace crevice
