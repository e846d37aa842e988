// EXT_meshopt_compression: buffer views that come out of meshoptimizer's decoders.
#include <cstdint>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

// The extension's own rules; the decoders assert some of them.
std::string refuse(const Compression& packed, std::size_t length) {
    const bool attributes = packed.mode == "ATTRIBUTES";
    const std::size_t stride = packed.byteStride;
    if (!attributes && packed.mode != "TRIANGLES" && packed.mode != "INDICES")
        return fmt::format("'mode' is '{}'; it may be ATTRIBUTES, TRIANGLES or INDICES", packed.mode);
    if (attributes ? stride == 0 || stride > 256 || stride % 4 : stride != 2 && stride != 4)
        return fmt::format("'byteStride' {} does not fit mode {}", stride, packed.mode);
    if (packed.mode == "TRIANGLES" && packed.count % 3) return "'count' is not a multiple of 3";
    if (packed.count == 0 || packed.count > length / stride)
        return fmt::format("{} elements of {} bytes do not fit the view of {} bytes", packed.count, stride, length);
    if (packed.filter == "NONE") return {};
    if (!attributes) return "'filter' needs mode ATTRIBUTES";
    if (packed.filter == "OCTAHEDRAL") return stride == 4 || stride == 8 ? "" : "OCTAHEDRAL needs a stride of 4 or 8";
    if (packed.filter == "QUATERNION") return stride == 8 ? "" : "QUATERNION needs a stride of 8";
    if (packed.filter == "EXPONENTIAL") return {};
    return fmt::format("'filter' is '{}'", packed.filter);
}

int decode(const Compression& packed, std::span<const std::byte> source, std::byte* out) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(source.data());
    if (packed.mode == "ATTRIBUTES")
        return meshopt_decodeVertexBuffer(out, packed.count, packed.byteStride, bytes, source.size());
    if (packed.mode == "TRIANGLES")
        return meshopt_decodeIndexBuffer(out, packed.count, packed.byteStride, bytes, source.size());
    return meshopt_decodeIndexSequence(out, packed.count, packed.byteStride, bytes, source.size());
}

}  // namespace

std::vector<std::byte> decompress(const File& file, std::size_t view, std::span<const std::byte> source) {
    const BufferViewPart& part = file.model.bufferViews[view];
    const Compression& packed = *part.compression;
    const auto fail = [&](const std::string& why) {
        file.fail("bufferViews", view, "EXT_meshopt_compression: " + why);
    };
    if (const std::string why = refuse(packed, part.byteLength); !why.empty()) fail(why);
    if (source.empty()) fail("there are no compressed bytes");
    std::vector<std::byte> bytes(part.byteLength);
    if (decode(packed, source, bytes.data()) != 0) fail("the compressed data is broken");
    if (packed.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), packed.count, packed.byteStride);
    if (packed.filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), packed.count, packed.byteStride);
    if (packed.filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), packed.count, packed.byteStride);
    return bytes;
}

}  // namespace crevice::gltf
