// The .glb container: a header and chunks. glTF 2.0 specification, 4 "GLB File Format Specification".
#include <cstring>

#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

constexpr std::uint32_t kJsonChunk = 0x4e4f534a;  // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

[[noreturn]] void refuse(const File& file, const std::string& why) {
    throw Error(SourceLoc{file.name}, "broken .glb: " + why, "the file may be truncated: export or download it again");
}

std::size_t checkHeader(const File& file) {
    const std::span<const std::byte> bytes = file.content;
    if (bytes.size() < kHeaderBytes + kChunkHeaderBytes)
        refuse(file, fmt::format("{} bytes are less than its header", bytes.size()));
    if (word(bytes, 4) == 1)
        throw Error(SourceLoc{file.name}, "this is glTF 1.0; Crevice reads glTF 2.0", "convert it to glTF 2.0");
    if (word(bytes, 4) != 2) refuse(file, fmt::format("container version {} is not 2", word(bytes, 4)));
    const std::size_t length = word(bytes, 8);
    if (length > bytes.size())
        refuse(file, fmt::format("its header says {} bytes, the file has {}", length, bytes.size()));
    if (length < kHeaderBytes + kChunkHeaderBytes) refuse(file, fmt::format("its header says {} bytes", length));
    if (length < bytes.size())
        file.fault(SourceLoc{file.name},
                   fmt::format("{} bytes follow the end of the .glb and are ignored", bytes.size() - length));
    return length;
}

}  // namespace

std::string_view readContainer(File& file) {
    const std::size_t length = checkHeader(file);
    const std::span<const std::byte> bytes(file.content.data(), length);
    std::string_view json;
    std::size_t chunk = 0;
    for (std::size_t at = kHeaderBytes; at < length; ++chunk) {
        if (length - at < kChunkHeaderBytes) refuse(file, fmt::format("chunk {} has no header", chunk));
        const std::size_t size = word(bytes, at);
        const std::uint32_t kind = word(bytes, at + 4);
        at += kChunkHeaderBytes;
        if (size > length - at) refuse(file, fmt::format("chunk {} reaches beyond the file", chunk));
        if (size % 4)
            file.fault(SourceLoc{file.name}, fmt::format("the length of chunk {} is not a multiple of 4", chunk));
        if (chunk == 0 && kind != kJsonChunk) refuse(file, "the first chunk is not JSON");
        if (chunk > 0 && kind == kJsonChunk) refuse(file, "it has two JSON chunks");
        if (kind == kBinaryChunk) {
            if (file.hasBinaryChunk) refuse(file, "it has two chunks of binary data");
            if (chunk != 1) file.fault(SourceLoc{file.name}, "the chunk of binary data is not the second one");
            file.binaryChunk = bytes.subspan(at, size);
            file.hasBinaryChunk = true;
        }
        if (chunk == 0) json = {reinterpret_cast<const char*>(bytes.data()) + at, size};
        at += size;
    }
    if (json.empty()) refuse(file, "its JSON chunk is empty");
    return json;
}

}  // namespace crevice::gltf
