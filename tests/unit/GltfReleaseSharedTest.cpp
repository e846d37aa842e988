// What other parts of a big glTF read of the same bytes stays until they have; and the counting of it is bounded.
#include "GltfReleaseTools.h"

namespace crevice {
namespace {

using Document = test::GltfText;
using test::kCount;
using test::Listener;
using test::Opened;

/// One more view of the places.
std::string sameBytes() { return fmt::format(R"(, {{"buffer": 0, "byteLength": {}}})", 12 * kCount); }

/// bigGltf() and a second mesh.
Document withMesh(const std::string& primitive) {
    Document document = test::bigGltf(0);
    document.primitive = R"(}]}, {"primitives": [{)" + primitive;
    return document;
}

TEST(GltfReleaseShared, BytesOfPicturesMatricesAndInstancesStay) {
    const std::string pictures = R"(, "images": [{"bufferView": 2, "mimeType": "image/png"}])";
    const std::string matrices = R"(, "skins": [{"joints": [0], "inverseBindMatrices": 2}])";
    const std::string instances =
        R"(, {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}})";
    const auto placesAfter = [](const std::string& accessor, const std::string& nodes, const std::string& rest) {
        Document document = test::bigGltf(0);
        document.views += sameBytes();
        document.accessors += accessor;
        document.nodes += nodes;
        document.rest = rest;
        Opened opened(document, {{0, 1}});
        opened.read();
        return opened.placesThere();
    };
    const std::string accessor = R"(, {"bufferView": 2, "componentType": 5126, )";
    const std::string matrix = accessor + fmt::format(R"("count": {}, "type": "MAT4"}})", kCount * 12 / 64);
    const std::string vector = accessor + fmt::format(R"("count": {}, "type": "VEC3"}})", kCount);
    EXPECT_LT(placesAfter(matrix, "", ""), kCount / 10) << "nobody reads them";
    EXPECT_EQ(placesAfter("", "", pictures), kCount);
    EXPECT_EQ(placesAfter(matrix, "", matrices), kCount);
    EXPECT_EQ(placesAfter(vector, instances, ""), kCount);
}

void expectKeptForSecondMesh(const Document& document) {
    Opened opened(document, {{0, 1}, {1, 1}});
    opened.read(0);
    EXPECT_EQ(opened.placesThere(), kCount);
    opened.read(1);
    EXPECT_LT(opened.placesThere(), kCount / 10);
}

TEST(GltfReleaseShared, BytesOfMorphTargetsStay) {
    expectKeptForSecondMesh(withMesh(R"("attributes": {"POSITION": 1}, "targets": [{"POSITION": 0}])"));
}

TEST(GltfReleaseShared, BytesOfIndicesStay) {
    Document document = withMesh(R"("attributes": {"POSITION": 1}, "indices": 2)");
    document.views += sameBytes();
    document.accessors +=
        fmt::format(R"(, {{"bufferView": 2, "componentType": 5125, "count": {}, "type": "SCALAR"}})", 3 * kCount);
    expectKeptForSecondMesh(document);
}

// All places are sparse: their values are those of the first mesh, their indices one of its attributes.
TEST(GltfReleaseShared, BytesOfSparseAccessorsStay) {
    Document document = withMesh(R"("attributes": {"POSITION": 2})");
    const std::size_t start = document.bytes.size();
    for (std::uint32_t i = 0; i < kCount; ++i) test::append<std::uint32_t>(document.bytes, {i});
    document.views += fmt::format(R"(, {{"buffer": 0, "byteOffset": {}, "byteLength": {}}})", start, 4 * kCount);
    document.accessors += fmt::format(
        R"(, {{"componentType": 5126, "count": {0}, "type": "VEC3", "sparse": {{"count": {0},
               "indices": {{"bufferView": 2, "componentType": 5125}}, "values": {{"bufferView": 0}}}}}},
            {{"bufferView": 2, "componentType": 5125, "count": {0}, "type": "SCALAR"}})",
        kCount);
    document.attributes += R"(, "_ID": 3)";
    Opened opened(document, {{0, 1}, {1, 1}});
    const auto indicesThere = [&] {
        std::size_t there = 0;
        for (std::uint32_t i = 1; i < kCount; ++i)
            there += std::memcmp(opened.file.model.bufferViews[2].bytes.data() + 4 * i, &i, 4) == 0;
        return there;
    };
    opened.read(0);
    EXPECT_EQ(opened.placesThere(), kCount);
    EXPECT_EQ(indicesThere(), kCount - 1);
    opened.read(1);
    EXPECT_LT(opened.placesThere(), kCount / 10);
    EXPECT_LT(indicesThere(), kCount / 5);
}

// Within one reading, too: indices are read after the attributes.
TEST(GltfReleaseShared, WhatOnePrimitiveReadsTwiceStaysToItsEnd) {
    Document document = test::bigGltf(0);
    document.views += sameBytes();
    document.accessors +=
        fmt::format(R"(, {{"bufferView": 2, "componentType": 5125, "count": {}, "type": "SCALAR"}})", 3 * kCount);
    document.primitive = R"(, "indices": 2)";
    Opened opened(document, {{0, 1}});
    {
        gltf::Release::Reading reading(opened.release, opened.primitive());
        reading.passed(kCount / 2);
        EXPECT_EQ(opened.placesThere(), kCount);
    }
    EXPECT_LT(opened.placesThere(), kCount / 10);
}

// Attributes of other counts are legal in files as long as nobody reads them.
TEST(GltfReleaseShared, AttributesThatEndEarlyTakeNothingElse) {
    Document document = test::bigGltf(0);
    constexpr std::size_t kBefore = 1 << 20;
    document.bytes.insert(document.bytes.begin(), kBefore, 0);
    document.views =
        fmt::format(R"({{"buffer": 0, "byteOffset": {}, "byteLength": {}}}, {{"buffer": 0, "byteLength": 120}})",
                    kBefore, 12 * kCount);
    document.accessors = fmt::format(
        R"({{"bufferView": 0, "componentType": 5126, "count": {}, "type": "VEC3"}},
           {{"bufferView": 1, "componentType": 5126, "count": 10, "type": "VEC3"}})",
        kCount);
    document.attributes = R"("POSITION": 0, "_SHORT": 1)";
    Opened opened(document, {{0, 2}});
    gltf::Release::Reading first(opened.release, opened.primitive());
    first.passed(kCount - 1);
    EXPECT_EQ(opened.placesThere(), kCount);
}

// The same bytes 12 and 24 apart: the slower of the two says what goes. Shorter ones, that nobody reads, do not matter.
TEST(GltfReleaseShared, StreamsOfOtherStridesStayForTheSlowest) {
    Document document = test::bigGltf(0);
    document.views += fmt::format(R"(, {{"buffer": 0, "byteLength": {}, "byteStride": 24}})", 24 * kCount);
    document.accessors += fmt::format(
        R"(, {{"bufferView": 2, "componentType": 5126, "count": {}, "type": "VEC3"}},
            {{"bufferView": 0, "componentType": 5126, "count": 10, "type": "VEC3"}})",
        kCount);
    document.attributes = R"("POSITION": 0, "NORMAL": 2, "_SHORT": 3)";
    Opened opened(document, {{0, 1}});
    {
        gltf::Release::Reading reading(opened.release, opened.primitive());
        for (const std::size_t element : {std::size_t(11), kCount / 2}) {
            reading.passed(element);
            EXPECT_GE(opened.placesThere(), kCount - element);
        }
    }
    EXPECT_LT(opened.placesThere(), kCount / 10);
}

// Joints and weights are read last; two skins read the mesh twice.
TEST(GltfReleaseShared, SkinnedMeshesAreReadRightly) {
    constexpr std::size_t kSkinned = 200'000;
    Document document;
    document.bytes.assign(32 * kSkinned, 0);
    for (std::size_t i = 0; i < kSkinned; ++i) {
        const float place[3] = {float(i), 1, 2}, weight = 1;
        std::memcpy(&document.bytes[12 * i], place, 12);
        std::memcpy(&document.bytes[16 * (kSkinned + i)], &weight, 4);
    }
    document.views =
        fmt::format(R"({{"buffer": 0, "byteLength": {}}}, {{"buffer": 0, "byteOffset": {}, "byteLength": {}}},
                                    {{"buffer": 0, "byteOffset": {}, "byteLength": {}}})",
                    12 * kSkinned, 12 * kSkinned, 4 * kSkinned, 16 * kSkinned, 16 * kSkinned);
    document.accessors = fmt::format(
        R"({{"bufferView": 0, "componentType": 5126, "count": {0}, "type": "VEC3", "min": [0, 1, 2], "max": [{1}, 1, 2]}},
           {{"bufferView": 1, "componentType": 5121, "count": {0}, "type": "VEC4"}},
           {{"bufferView": 2, "componentType": 5126, "count": {0}, "type": "VEC4"}})",
        kSkinned, kSkinned - 1);
    document.attributes = R"("POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2)";
    document.primitive = R"(, "mode": 0)";
    document.nodes = R"({"mesh": 0, "skin": 0}, {"mesh": 0, "skin": 1}, {"translation": [0, 0, 5]},
                        {"translation": [0, 0, 7]})";
    document.roots = "0, 1, 2, 3";
    document.rest = R"(, "skins": [{"joints": [2]}, {"joints": [3]}])";
    const test::TempFolder folder;
    Listener listener;
    const Scene scene = loadGltf(folder.write("t.glb", document.glb()), {.log = listener.log});
    ASSERT_EQ(scene.meshes.size(), 2u);
    for (std::size_t mesh = 0; mesh < 2; ++mesh) {
        ASSERT_EQ(scene.meshes[mesh].vertices.size(), kSkinned);
        for (std::size_t i = 0; i < kSkinned; ++i)
            ASSERT_EQ(scene.meshes[mesh].vertices[i].position, glm::vec3(float(i), 1, mesh ? 9 : 7)) << i;
    }
}

/// One primitive for each of 40 buffers of 16 KiB, and a large one that makes the counting worth it.
struct SmallBuffers {
    static constexpr std::size_t kBuffers = 40, kPlaces = 1365;
    static Document document() {
        Document document;
        document.bytes.assign(5 << 20, 0);
        std::vector<unsigned char> bytes;
        for (std::size_t i = 0; i < kPlaces; ++i) test::append<float>(bytes, {1, 1, 1});
        const std::string uri = "data:application/octet-stream;base64," + test::encodeBase64(bytes);
        document.views = document.accessors = document.primitive = "";
        for (std::size_t i = 0; i < kBuffers; ++i) {
            const char* comma = i ? ", " : "";
            document.moreBuffers += fmt::format(R"(, {{"byteLength": {}, "uri": "{}"}})", bytes.size(), uri);
            document.views += fmt::format(R"({}{{"buffer": {}, "byteLength": {}}})", comma, i + 1, bytes.size());
            document.accessors += fmt::format(
                R"({}{{"bufferView": {}, "componentType": 5126, "count": {}, "type": "VEC3"}})", comma, i, kPlaces);
            if (i > 0) document.primitive += fmt::format(R"(}}, {{"attributes": {{"POSITION": {}}})", i);
        }
        return document;
    }
    static std::size_t placesThere(const Opened& opened, std::size_t buffer) {
        const std::span<const std::byte> bytes = opened.file.model.bufferViews[buffer].bytes;
        std::size_t there = 0;
        for (std::size_t i = 0; i < kPlaces; ++i) there += bytes[12 * i + 3] != std::byte(0);  // of 1.0
        return there;
    }
};

TEST(GltfReleaseShared, SmallBuffersThatShareABlockStayForEachOther) {
    constexpr std::size_t kBuffers = SmallBuffers::kBuffers, kPlaces = SmallBuffers::kPlaces;
    Opened opened(SmallBuffers::document(), {{0, 1}});
    const auto blockOf = [&](std::size_t buffer) {
        return reinterpret_cast<std::uintptr_t>(opened.file.model.bufferViews[buffer].bytes.data()) >> 18;
    };
    std::size_t neighbours = 0;
    for (std::size_t i = 1; i < kBuffers; ++i) neighbours += blockOf(i) == blockOf(i - 1);
    ASSERT_GT(neighbours, kBuffers / 2) << "the allocator puts them side by side";
    for (std::size_t i = 0; i < kBuffers; i += 2) opened.read(0, i);
    for (std::size_t i = 1; i < kBuffers; i += 2) EXPECT_EQ(SmallBuffers::placesThere(opened, i), kPlaces) << i;
    for (std::size_t i = 1; i < kBuffers; i += 2) opened.read(0, i);
    std::size_t there = 0;
    for (std::size_t i = 0; i < kBuffers; ++i) there += SmallBuffers::placesThere(opened, i);
    EXPECT_LE(there, kBuffers * kPlaces / 2) << "of each at least two whole pages";
}

// 3 vertices, 2000 targets that name one sparse accessor in 6 MB: of each view a few bytes are read.
TEST(GltfReleaseShared, BlocksThatManyTargetsReadAreDroppedOnce) {
    Document document;
    document.bytes.assign(6 << 20, 0);
    document.views = fmt::format(R"({{"buffer": 0, "byteLength": {}}})", document.bytes.size());
    document.accessors = R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
        {"componentType": 5126, "count": 3, "type": "VEC3", "sparse": {"count": 1,
         "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}}})";
    document.primitive = R"(, "targets": [{"POSITION": 1})";
    for (int i = 1; i < 2000; ++i) document.primitive += R"(, {"POSITION": 1})";
    document.primitive += "]";
    const auto dropsAmong = [&](std::size_t times) {
        Opened opened(document, {{0, times}});
        opened.read();
        return opened.release.drops();
    };
    for (const std::size_t times : {1, 2000}) {
        EXPECT_GE(dropsAmong(times), 1u);
        EXPECT_LE(dropsAmong(times), 2u) << "36 bytes, across a boundary perhaps";
    }
    EXPECT_EQ(dropsAmong(30'000), 0u) << "6e7 look-ups of targets are not worth it";
}

// Each block once: 55 or 56, as the allocator places them.
TEST(GltfReleaseShared, BlocksThatManyAttributesReadAreDroppedOnce) {
    for (const std::size_t stride : {0, 24}) {
        Document document = test::bigGltf(stride);
        for (int i = 0; i < 20; ++i) document.attributes += fmt::format(R"(, "_{0}A": 0, "_{0}B": 1)", i);
        Opened opened(document, {{0, 1}});
        opened.read();
        EXPECT_NEAR(double(opened.release.drops()), 55.5, 1);
        EXPECT_LT(opened.placesThere(), kCount / 10);
    }
}

TEST(GltfReleaseShared, SoManyReadingsAreNotCounted) {
    const auto dropsAmong = [&](std::size_t times) {
        Opened opened(test::bigGltf(0), {{0, times}});
        opened.read();
        if (times > 1) {
            EXPECT_EQ(opened.placesThere(), kCount);
        }
        return opened.release.drops();
    };
    EXPECT_NEAR(double(dropsAmong(1)), 55.5, 1);
    EXPECT_NEAR(double(dropsAmong(100'000)), 55.5, 1);
    EXPECT_EQ(dropsAmong(1'000'000), 0u) << "5.5e7";
}

}  // namespace
}  // namespace crevice
