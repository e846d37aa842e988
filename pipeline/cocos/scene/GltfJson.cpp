// glTF 2.0 specification, 4 "GLB File Format Specification": a header of three words, then chunks of length, kind,
// data.
#include "cocos/scene/GltfJson.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "core/Error.h"
#include "core/LimitedFiles.h"
#include "core/Picture.h"

namespace crevice::cocos {
namespace {

constexpr DocumentLimits kJsonLimits{.maxBytes = 256u << 20, .maxDepth = 64, .maxNodes = 8'000'000};
constexpr std::size_t kHeader = 12, kChunkHeader = 8;

/// The data of the chunk that begins at `at`, which moves behind it; cut off where the file ends.
std::span<const std::byte> chunkAt(std::span<const std::byte> bytes, std::size_t& at) {
    if (at > bytes.size() || bytes.size() - at < kChunkHeader) return {};
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + at, sizeof size);
    at += kChunkHeader;
    const auto data = bytes.subspan(at, std::min<std::size_t>(size, bytes.size() - at));
    at += data.size();
    return data;
}

const Value* itemOf(const Value& json, const char* list, std::int64_t index) {
    const Value* items = json.isObject() ? json.find(list) : nullptr;
    const bool inside = items && items->isArray() && index >= 0 && index < std::ssize(items->items());
    return inside ? &items->items()[std::size_t(index)] : nullptr;
}

std::int64_t numberOf(const Value* object, const char* key, std::int64_t otherwise) {
    const Value* value = object && object->isObject() ? object->find(key) : nullptr;
    return value && value->isInteger() ? value->integer() : otherwise;
}

}  // namespace

GltfJson readGltfJson(const std::filesystem::path& path, const Limits& limits) {
    GltfJson file;
    file.bytes = readBytesWithin(path, limits.maxFileBytes);
    std::span<const std::byte> text(file.bytes);
    if (text.size() > kHeader && std::memcmp(text.data(), "glTF", 4) == 0) {
        std::size_t at = kHeader;
        text = chunkAt(file.bytes, at);
        file.binary = chunkAt(file.bytes, at);
    }
    file.json = parseJson({reinterpret_cast<const char*>(text.data()), text.size()}, path.string(), kJsonLimits);
    return file;
}

Image readEmbeddedPicture(const std::filesystem::path& path, int index, const Limits& limits) {
    const GltfJson file = readGltfJson(path, limits);
    const Value* image = itemOf(file.json, "images", index);
    const Value* view = itemOf(file.json, "bufferViews", numberOf(image, "bufferView", -1));
    const std::int64_t offset = numberOf(view, "byteOffset", 0), size = numberOf(view, "byteLength", 0);
    const auto all = std::ssize(file.binary);
    const bool inside =
        view && numberOf(view, "buffer", -1) == 0 && offset >= 0 && size > 0 && size <= all && offset <= all - size;
    const std::string name = fmt::format("picture {} of '{}'", index, path.filename().string());
    if (!inside)
        throw Error(SourceLoc{.file = path.string()}, name + " is not in its binary chunk",
                    "store it beside the model");
    return decodePicture(file.binary.subspan(std::size_t(offset), std::size_t(size)), name, limits);
}

}  // namespace crevice::cocos
