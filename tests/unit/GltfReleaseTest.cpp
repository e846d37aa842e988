// Bytes of a big glTF are given back when no mesh needs them any more, and not before.
#include "GltfReleaseTools.h"
#include "core/Memory.h"

namespace crevice {
namespace {

using Document = test::GltfText;
using test::kCount;
using test::Listener;
using test::Opened;
using test::TempFolder;

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
        Document document = test::bigGltf(stride);
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

TEST(GltfRelease, BytesGoAsTheyArePassed) {
    constexpr std::size_t kBlock = (1 << 18) / 12 + 1;  // places
    for (const std::size_t stride : {0, 24}) {
        Opened opened(test::bigGltf(stride), {{0, 1}});
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
    Opened opened(test::bigGltf(0), {{0, 2}});
    opened.read();
    EXPECT_EQ(opened.placesThere(), kCount);
    opened.read();
    EXPECT_LT(opened.placesThere(), kCount / 10);
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
