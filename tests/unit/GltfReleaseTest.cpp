// Bytes of a big glTF are given back when no mesh needs them any more, and not before.
#include <cstring>

#include <fmt/format.h>

#include "GltfTestTools.h"
#include "core/Memory.h"
#include "scene/GltfRelease.h"

namespace crevice {
namespace {

using Document = test::GltfText;
using test::Listener;
using test::TempFolder;

constexpr std::size_t kCount = 600'000;  // vertices of 12 bytes: 7.2 MB, 27 blocks

// The same places and normals, one after the other (stride 0) or interleaved; the first place is `first`.
Document bigDocument(std::size_t stride) {
    Document document;
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

void expectVertices(const Mesh& mesh) {
    ASSERT_EQ(mesh.vertices.size(), kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
        ASSERT_EQ(mesh.vertices[i].position, glm::vec3(float(i), 1, 2)) << i;
        ASSERT_EQ(mesh.vertices[i].normal, glm::vec3(0, 1, 0)) << i;
    }
}

TEST(GltfRelease, BigMeshesAreReadRightly) {
    for (const std::size_t stride : {0, 24}) {
        const TempFolder folder;
        Listener listener;
        Document document = bigDocument(stride);
        // Twice the same primitive, and twice more of another mesh.
        document.primitive = "}, {\"attributes\": {" + document.attributes +
                             "}}]}, {\"primitives\": [{\"attributes\": {" + document.attributes + "}";
        document.nodes = R"({"mesh": 0}, {"mesh": 1}, {"mesh": 0})";
        document.roots = "0, 1, 2";
        const Scene scene = loadGltf(folder.write("t.glb", document.glb()), {.log = listener.log});
        EXPECT_EQ(listener.text, "");
        ASSERT_EQ(scene.meshes.size(), 3u);
        for (const Mesh& mesh : scene.meshes) expectVertices(mesh);
    }
}

/// The opened file, and how many of its positions read as they should.
struct Opened {
    explicit Opened(const Document& document, const std::map<int, std::size_t>& times)
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
    const gltf::PrimitivePart& primitive() const { return file.model.meshes[0].primitives[0]; }

    TempFolder folder;
    Listener listener;
    LoadOptions options;
    gltf::File file;
    gltf::Release release;
};

TEST(GltfRelease, BytesGoAsTheyArePassed) {
    constexpr std::size_t kBlock = (1 << 18) / 12 + 1;  // places
    for (const std::size_t stride : {0, 24}) {
        Opened opened(bigDocument(stride), {{0, 1}});
        EXPECT_EQ(opened.placesThere(), kCount);
        {
            gltf::Release::Reading reading(opened.release, opened.primitive());
            EXPECT_EQ(opened.placesThere(), kCount);
            reading.passed(kCount / 2);
            EXPECT_GE(opened.placesThere(), kCount / 2) << "those that are still to come";
            EXPECT_LE(opened.placesThere(), kCount / 2 + 2 * kBlock);
        }
        EXPECT_LE(opened.placesThere(), 2 * kBlock);
    }
}

TEST(GltfRelease, WhatIsReadAgainStays) {
    Opened opened(bigDocument(0), {{0, 2}});
    { const gltf::Release::Reading first(opened.release, opened.primitive()); }
    EXPECT_EQ(opened.placesThere(), kCount);
    { const gltf::Release::Reading second(opened.release, opened.primitive()); }
    EXPECT_LT(opened.placesThere(), kCount / 10);
}

TEST(GltfRelease, WhatOthersReadStays) {
    Document document = bigDocument(0);
    document.views += fmt::format(R"(, {{"buffer": 0, "byteLength": {}}})", 12 * kCount);
    document.rest = R"(, "images": [{"bufferView": 2, "mimeType": "image/png"}])";
    Opened opened(document, {{0, 1}});
    { const gltf::Release::Reading reading(opened.release, opened.primitive()); }
    EXPECT_EQ(opened.placesThere(), kCount);
}

// With indices that name each vertex once, and without any.
TEST(GltfRelease, FlatNormalsOfTrianglesThatShareNothing) {
    for (const char* primitive : {R"(, "indices": 1)", ""}) {
        Document document;
        document.bytes.clear();
        // Two triangles: one faces +z, one +x.
        test::append<float>(document.bytes, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1});
        test::append<std::uint16_t>(document.bytes, {0, 1, 2, 3, 4, 5});
        document.views = R"({"buffer": 0, "byteLength": 72}, {"buffer": 0, "byteOffset": 72, "byteLength": 12})";
        document.accessors = R"({"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3"},
                                {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"})";
        document.primitive = primitive;
        const Scene scene = document.load();
        ASSERT_EQ(scene.meshes.at(0).vertices.size(), 6u);
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_EQ(scene.meshes[0].vertices[i].normal, i < 3 ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0));
    }
}

TEST(Memory, WholePagesAreGivenBack) {
    std::vector<std::byte> bytes(1 << 20, std::byte(7));
    releasePages(std::span(bytes).subspan(5, 100));
    EXPECT_EQ(bytes[50], std::byte(7)) << "less than a page";
    releasePages(std::span(bytes).subspan(0, 1 << 19));
    EXPECT_EQ(bytes[1 << 18], std::byte(0));
    EXPECT_EQ(bytes[(1 << 19) + 1], std::byte(7));
    bytes[1 << 18] = std::byte(3);
    EXPECT_EQ(bytes[1 << 18], std::byte(3));
}

}  // namespace
}  // namespace crevice
