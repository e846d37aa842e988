// A glTF large enough that its bytes are given back, and how much of it is still there; shared by tests of that.
#pragma once

#include <cstring>
#include <map>

#include <fmt/format.h>

#include "GltfTestTools.h"
#include "scene/GltfRelease.h"

namespace crevice::test {

inline constexpr std::size_t kCount = 600'000;  // vertices of 12 bytes: 7.2 MB, 27 blocks

/// Places (i, 1, 2) and normals, one after the other (stride 0) or interleaved.
inline GltfText bigGltf(std::size_t stride) {
    GltfText document;
    document.bytes.assign(24 * kCount, 0);
    const std::size_t apart = stride ? stride : 12, normals = stride ? 12 : 12 * kCount;
    for (std::size_t i = 0; i < kCount; ++i) {
        const float place[3] = {float(i), 1, 2}, normal[3] = {0, 1, 0};
        std::memcpy(&document.bytes[i * apart], place, 12);
        std::memcpy(&document.bytes[normals + i * apart], normal, 12);
    }
    const std::string more = stride ? fmt::format(R"(, "byteStride": {})", stride) : "";
    document.views = fmt::format(
        R"({{"buffer": 0, "byteLength": {0}{2}}}, {{"buffer": 0, "byteOffset": {1}, "byteLength": {0}{2}}})",
        stride ? 24 * kCount - 12 : 12 * kCount, normals, more);
    document.accessors = fmt::format(
        R"({{"bufferView": 0, "componentType": 5126, "count": {0}, "type": "VEC3", "min": [0, 1, 2], "max": [{1}, 1, 2]}},
           {{"bufferView": 1, "componentType": 5126, "count": {0}, "type": "VEC3"}})",
        kCount, kCount - 1);
    document.attributes = R"("POSITION": 0, "NORMAL": 1)";
    document.primitive = "";
    return document;
}

/// The opened file, and how many of its positions read as they should.
struct Opened {
    explicit Opened(const GltfText& document, const std::map<int, std::size_t>& times)
        : options{.log = listener.log},
          file(gltf::open(folder.write("t.glb", document.glb()), options)),
          release(file) {
        release.expect(times);
    }
    std::size_t placesThere() const {
        const auto& accessor = file.model.accessors[0];
        const auto& view = file.model.bufferViews[std::size_t(accessor.bufferView)];
        std::size_t there = 0;
        for (std::size_t i = 0; i < kCount; ++i) {
            float y = 0;
            std::memcpy(&y, view.bytes.data() + i * (view.byteStride ? view.byteStride : 12) + 4, 4);
            there += y == 1;
        }
        return there;
    }
    const gltf::PrimitivePart& primitive(std::size_t mesh = 0, std::size_t index = 0) const {
        return file.model.meshes[mesh].primitives[index];
    }
    void read(std::size_t mesh = 0, std::size_t index = 0) {
        const gltf::Release::Reading reading(release, primitive(mesh, index));
    }

    TempFolder folder;
    Listener listener;
    LoadOptions options;
    gltf::File file;
    gltf::Release release;
};

}  // namespace crevice::test
