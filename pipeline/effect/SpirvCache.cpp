// SPIR-V on disk: magic, stages as (stage bit, word count, words), then the content hash of all that.
#include "effect/SpirvCache.h"

#include <cstring>

#include "core/Files.h"

namespace crevice {
namespace {

constexpr std::string_view kMagic = "CREVICE SPIRV 1\n";
constexpr std::size_t kHashLength = 32;
constexpr std::uint32_t kSpirvMagic = 0x07230203;
constexpr std::size_t kMaxBytes = 64u << 20;

void append(std::string& out, const void* data, std::size_t bytes) {
    out.append(static_cast<const char*>(data), bytes);
}

std::string serialise(const std::vector<StageCode>& code) {
    std::string out(kMagic);
    for (const StageCode& stage : code) {
        const std::uint32_t head[2] = {stage.stage, static_cast<std::uint32_t>(stage.words.size())};
        append(out, head, sizeof head);
        append(out, stage.words.data(), stage.words.size() * sizeof(std::uint32_t));
    }
    return out + contentHash(out);
}

std::vector<StageCode> deserialise(std::string_view file) {
    if (!file.starts_with(kMagic) || file.size() < kMagic.size() + kHashLength) return {};
    const std::string_view body = file.substr(0, file.size() - kHashLength);
    if (contentHash(body) != file.substr(body.size())) return {};
    std::vector<StageCode> code;
    for (std::size_t at = kMagic.size(); at < body.size();) {
        std::uint32_t head[2];
        if (body.size() - at < sizeof head) return {};
        std::memcpy(head, body.data() + at, sizeof head);
        at += sizeof head;
        const std::size_t bytes = std::size_t(head[1]) * sizeof(std::uint32_t);
        if (bytes == 0 || body.size() - at < bytes) return {};
        StageCode& stage = code.emplace_back();
        stage.stage = static_cast<ShaderStageBits>(head[0]);
        stage.words.resize(head[1]);
        std::memcpy(stage.words.data(), body.data() + at, bytes);
        if (stage.words[0] != kSpirvMagic) return {};
        at += bytes;
    }
    return code;
}

std::filesystem::path fileOf(const std::filesystem::path& folder, const std::string& key) {
    return folder / (key + ".spv");
}

}  // namespace

std::vector<StageCode> SpirvCache::load(const std::string& key) const {
    if (!folder_) return {};
    try {
        std::error_code error;
        const auto file = fileOf(*folder_, key);
        if (!std::filesystem::is_regular_file(file, error)) return {};
        return deserialise(readText(file, kMaxBytes));
    } catch (const Error&) {
        return {};
    }
}

void SpirvCache::store(const std::string& key, const std::vector<StageCode>& code) const {
    if (!folder_) return;
    try {
        writeFileAtomically(fileOf(*folder_, key), serialise(code));
    } catch (const Error&) {
        // A full or read-only disk costs time, not correctness.
    }
}

}  // namespace crevice
