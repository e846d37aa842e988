// Small glTF files that name the same bytes any number of times: each byte is looked at a few times, each picture kept
// once, or the file is refused.
#include <cstring>

#include <fmt/format.h>

#include "GltfTestTools.h"
#include "core/Picture.h"
#include "scene/GltfRelease.h"

namespace crevice {
namespace {

using test::append;
using test::contains;
using test::errorOf;
using Document = test::GltfText;
using test::Listener;
using test::TempFolder;

std::string repeat(int count, const std::string& text) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

template <class T>
const unsigned char* bytesOf(const std::vector<T>& values) {
    return reinterpret_cast<const unsigned char*>(values.data());
}

TEST(GltfShared, IncreasingRunsAreWalkedOnce) {
    std::vector<std::uint16_t> values(1000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::uint16_t(3 * i);
    const unsigned char* bytes = bytesOf(values);
    gltf::IncreasingRuns runs;
    EXPECT_EQ(runs.findBreak(bytes + 1000, gltf::kUShort, 100), 100u);
    EXPECT_EQ(runs.visited(), 99u);
    EXPECT_EQ(runs.findBreak(bytes + 1000, gltf::kUShort, 100), 100u);
    EXPECT_EQ(runs.findBreak(bytes + 1100, gltf::kUShort, 50), 50u) << "inside";
    EXPECT_EQ(runs.visited(), 99u);
    EXPECT_EQ(runs.findBreak(bytes, gltf::kUShort, 1000), 1000u) << "before, across and behind";
    EXPECT_LE(runs.visited(), 99u + 500 + 400);
    for (std::size_t i = 0; i < 999; ++i) EXPECT_EQ(runs.findBreak(bytes + 2 * i, gltf::kUShort, 1000 - i), 1000 - i);
    EXPECT_LE(runs.visited(), 1000u);
}

TEST(GltfShared, BreaksAreFoundFromEveryBeginning) {
    std::vector<std::uint32_t> values = {1, 5, 9, 9, 10, 4, 6};
    const unsigned char* bytes = bytesOf(values);
    // The first element, counted from the beginning, that is not above the one before.
    const std::size_t expected[] = {3, 2, 1, 2, 1, 2, 1};
    for (const bool backwards : {false, true}) {
        gltf::IncreasingRuns runs;
        for (std::size_t k = 0; k < 7; ++k) {
            const std::size_t i = backwards ? 6 - k : k;
            EXPECT_EQ(runs.findBreak(bytes + 4 * i, gltf::kUInt, 7 - i), expected[i]) << i;
        }
        EXPECT_EQ(runs.findBreak(bytes, gltf::kUInt, 3), 3u) << "up to the break";
    }
    // Other types see other numbers in the same bytes: 1 0 0 0 5 …
    gltf::IncreasingRuns runs;
    EXPECT_EQ(runs.findBreak(bytes, gltf::kUInt, 3), 3u);
    EXPECT_EQ(runs.findBreak(bytes, gltf::kUByte, 12), 1u);
}

// 3000 accessors × 8192 sparse indices are 2.4e7, twice each.
TEST(GltfShared, SparseIndicesOfManyAccessorsAreWalkedOnce) {
    Document document;
    const std::size_t start = document.bytes.size();
    for (int i = 0; i < 8192; ++i) append<std::uint16_t>(document.bytes, {std::uint16_t(i)});
    document.views += fmt::format(R"(, {{"buffer": 0, "byteOffset": {}, "byteLength": 16384}})", start);
    for (int i = 0; i < 3000; ++i)
        document.accessors += fmt::format(
            R"(, {{"componentType": 5121, "count": {0}, "type": "SCALAR", "sparse": {{"count": {0},
                "indices": {{"bufferView": 2, "componentType": 5123}}, "values": {{"bufferView": 2}}}}}})",
            8192 - i % 100);
    const TempFolder folder;
    Listener listener;
    const LoadOptions options{.log = listener.log};
    const gltf::File file = gltf::open(folder.write("t.gltf", document.json()), options);
    EXPECT_EQ(file.model.accessors.size(), 3002u);
    EXPECT_LT(file.increasing.visited(), 8192u);
}

// Whatever is in a material that no reader knows: what is searched for each primitive is what the tables have.
TEST(GltfShared, UnknownMembersAreDropped) {
    Document document;
    std::string junk;
    for (int i = 0; i < 5000; ++i) junk += fmt::format(R"("x{0}Texture": {{"index": 0, "texCoord": {0}}}, )", i);
    document.rest =
        ", \"materials\": [{" + junk + R"("extras": {"aTexture": {"index": 0}}, "doubleSided": true,
        "pbrMetallicRoughness": {)" +
        junk + R"("roughnessFactor": 0.5}, "extensions": {"UNKNOWN_one": {)" + junk +
        R"("x": 1}, "KHR_materials_unlit": {}}}], "extensionsUsed": ["KHR_materials_unlit", "UNKNOWN_one"])";
    document.primitive = R"(, "indices": 1, "material": 0)";
    document.primitive = repeat(3000, document.primitive + "}, {\"attributes\": {" + document.attributes + "}");
    const TempFolder folder;
    Listener listener;
    const LoadOptions options{.log = listener.log};
    const gltf::File file = gltf::open(folder.write("t.gltf", document.json()), options);
    // All that 3000 primitives look through:
    const Value& material = file.item("materials", 0);
    EXPECT_EQ(material.members().size(), 3u);
    EXPECT_EQ(material.find("pbrMetallicRoughness")->members().size(), 1u);
    EXPECT_EQ(material.find("extensions")->members().size(), 1u);
    EXPECT_TRUE(contains(listener.text, "glTF 2.0 has no such words")) << "they are told all the same";
}

std::string withImages(int textures) {
    std::string text = R"("images": [{"uri": "data:image/png;base64,)" + std::string(test::kPng) + R"("}],
        "samplers": [)";
    for (int i = 0; i < textures; ++i)
        text += fmt::format(R"({}{{"wrapS": {}, "wrapT": {}}})", i ? ", " : "", i % 2 ? 33071 : 10497,
                            i / 2 % 2 ? 33071 : 10497);
    text += "], \"textures\": [";
    for (int i = 0; i < textures; ++i) text += fmt::format(R"({}{{"source": 0, "sampler": {}}})", i ? ", " : "", i);
    text += "], \"materials\": [";
    for (int i = 0; i < textures; ++i)
        text += fmt::format(R"({}{{"emissiveTexture": {{"index": {}}}}})", i ? ", " : "", i);
    return ", " + text + "]";
}

// A picture of 2 × 1 pixels has 8 bytes; each way of reading it is a copy.
TEST(GltfShared, CopiesOfPicturesCountAgainstTheLimit) {
    Document document;
    document.rest = withImages(4);
    const TempFolder folder;
    const auto path = folder.write("t.gltf", document.json());
    const auto widthAt = [&](std::size_t limit) {
        Listener listener;
        LoadOptions options{.log = listener.log};
        options.limits.maxImageBytes = limit;
        const Scene scene = loadGltf(path, options);
        EXPECT_EQ(scene.textures.size(), 4u);
        EXPECT_EQ(contains(listener.text, "beyond the limit"), limit < 32) << listener.text;
        return scene.textures.at(3).image.width;
    };
    EXPECT_EQ(widthAt(32), 2u);
    EXPECT_EQ(widthAt(31), 1u) << "white";
}

TEST(GltfShared, EqualSamplersAndEqualBytesAreOneTexture) {
    Document document;
    document.rest = withImages(400);
    EXPECT_EQ(document.load().textures.size(), 4u) << "four ways to wrap";
    document.bytes.resize(64);
    const std::string picture = test::kPng;
    document.views +=
        R"(, {"buffer": 0, "byteOffset": 56, "byteLength": 8}, {"buffer": 0, "byteOffset": 56, "byteLength": 8})";
    document.rest =
        R"(, "images": [{"bufferView": 2, "mimeType": "image/png"}, {"bufferView": 3, "mimeType": "image/png"}],
        "textures": [{"source": 0}, {"source": 1}],
        "materials": [{"emissiveTexture": {"index": 0}}, {"emissiveTexture": {"index": 1}}])";
    EXPECT_EQ(document.load().textures.size(), 1u);
}

// Pictures that begin at every byte of 1 MiB would be 5e11 bytes to decode.
TEST(GltfShared, PicturesThatOverlapAreRefused) {
    const auto errorWith = [](int pictures) {
        Document document;
        document.bytes.resize(400000);
        std::string images, textures, materials;
        for (int i = 0; i < pictures; ++i) {
            const char* comma = i ? ", " : "";
            document.views += fmt::format(R"(, {{"buffer": 0, "byteOffset": {}, "byteLength": 399000}})", i);
            images += fmt::format(R"({}{{"bufferView": {}, "mimeType": "image/png"}})", comma, i + 2);
            textures += fmt::format(R"({}{{"source": {}}})", comma, i);
            materials += fmt::format(R"({}{{"emissiveTexture": {{"index": {}}}}})", comma, i);
        }
        document.rest =
            ", \"images\": [" + images + "], \"textures\": [" + textures + "], \"materials\": [" + materials + "]";
        return document.error();
    };
    // Twice what the file and its buffer have (0.5 and 0.4 MB), and 1 MiB.
    EXPECT_EQ(errorWith(7), "no error");
    EXPECT_TRUE(contains(errorWith(8), "the pictures share their bytes")) << errorWith(8);
}

TEST(GltfShared, JpegHeadersAreNotSearchedForEver) {
    std::vector<unsigned char> bytes = {0xff, 0xd8};
    const auto withSegments = [&](int count) {
        std::vector<unsigned char> all = bytes;
        for (int i = 0; i < count; ++i) append<unsigned char>(all, {0xff, 0xe0, 0, 2});
        append<unsigned char>(all, {0xff, 0xc0, 0, 11, 8, 0, 3, 0, 5, 1, 1, 0x11, 0});
        return readPictureHeader(std::as_bytes(std::span(all)));
    };
    ASSERT_TRUE(withSegments(300));
    EXPECT_EQ(withSegments(300)->width, 5u);
    EXPECT_FALSE(withSegments(5000));
}

std::string strictError(const Document& document) {
    const TempFolder folder;
    Listener listener;
    return errorOf([&] { loadGltf(folder.write("t.gltf", document.json()), {.log = listener.log, .strict = true}); });
}

// 3000 × 4000 numbers of the same 4000 bytes are more than 1e7 and four times the file.
TEST(GltfShared, StrictRefusesFilesThatNameTheirBytesTooOften) {
    Document document;
    document.accessors = R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                             "min": [0, 0, 0], "max": [1, 1, 0]},
                            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"})";
    document.bytes.resize(4000);
    document.views += R"(, {"buffer": 0, "byteLength": 4000})";
    const std::string accessor = R"(, {"bufferView": 2, "componentType": 5121, "count": 4000, "type": "SCALAR"})";
    const std::string start = document.accessors;
    document.accessors = start + repeat(1000, accessor);
    EXPECT_EQ(strictError(document), "no error");
    document.accessors = start + repeat(3000, accessor);
    EXPECT_TRUE(contains(strictError(document), "name the same bytes so often")) << strictError(document);
    EXPECT_TRUE(contains(strictError(document), "leave --strict out"));
    EXPECT_EQ(document.error(), "no error");
}

TEST(GltfShared, MorphTargetsAndSetsOfJointsCountAsVertices) {
    Document document;
    const TempFolder folder;
    const auto errorAt = [&](std::size_t limit) {
        Listener listener;
        LoadOptions options{.log = listener.log};
        options.limits.maxVertices = limit;
        return errorOf([&] { loadGltf(folder.write("t.gltf", document.json()), options); });
    };
    // Four vertices; a triangle without normals is then three of its own.
    document.attributes += R"(, "NORMAL": 0)";
    EXPECT_EQ(errorAt(4), "no error");
    EXPECT_TRUE(contains(errorAt(3), "the scene has more than 3 vertices"));
    document.primitive += R"(, "targets": [)" + repeat(9, R"({"POSITION": 0}, )") + R"({"POSITION": 0}])";
    EXPECT_EQ(errorAt(4), "no error") << "without weights they are not read";
    document.nodes = R"({"mesh": 0, "weights": [0, 1, 0, 1, 0, 0, 0, 0, 0, 1]})";
    EXPECT_EQ(errorAt(16), "no error") << "three targets";
    EXPECT_TRUE(contains(errorAt(15), "the scene has more than 15 vertices"));
}

// 3000 nodes × 3000 joints are 9e6 matrices, and 3000 nodes × 3000 primitives as many look-ups.
TEST(GltfShared, JointsOfASkinAreMadeOnce) {
    Document document;
    document.nodes = "{}";
    std::string joints = "0", roots = "0";
    for (int i = 1; i < 3000; ++i) {
        document.nodes += ", {}";
        joints += fmt::format(", {}", i);
        roots += fmt::format(", {}", i);
    }
    for (int i = 0; i < 3000; ++i) {
        document.nodes += R"(, {"mesh": 1, "skin": 0})";
        roots += fmt::format(", {}", 3000 + i);
    }
    document.roots = roots;
    document.rest = R"(, "skins": [{"joints": [)" + joints + "]}]";
    // The second mesh has no places to draw.
    const std::string empty = R"({"attributes": {"NORMAL": 0}})";
    document.primitive +=
        R"(}]}, {"primitives": [)" + empty + repeat(2998, ", " + empty) + R"(, {"attributes": {"NORMAL": 0})";
    const TempFolder folder;
    Listener listener;
    const LoadOptions options{.log = listener.log};
    gltf::File file = gltf::open(folder.write("t.gltf", document.json()), options);
    Scene scene;
    gltf::Images images(file);
    const gltf::Materials materials = gltf::readMaterials(file, images);
    gltf::Release release(file);
    gltf::Meshes meshes(file, materials, release, scene.meshes);
    gltf::readNodes(file, meshes, scene);
    EXPECT_EQ(scene.instances.size(), 0u);
    EXPECT_EQ(file.work.jointMatrices, 3000u);
    EXPECT_EQ(meshes.readings(), 3000u);
}

// 4000 channels × 100000 keys are 4e8.
TEST(GltfShared, KeysThatManyChannelsShareAreCheckedOnce) {
    Document document;
    const std::size_t start = document.bytes.size();
    for (int i = 0; i < 100000; ++i) append<float>(document.bytes, {0.001f * float(i)});
    document.views += fmt::format(R"(, {{"buffer": 0, "byteOffset": {}, "byteLength": 400000}})", start);
    document.accessors += R"(, {"bufferView": 2, "componentType": 5126, "count": 100000, "type": "SCALAR",
                                "min": [0], "max": [99.999]},
                            {"bufferView": 2, "componentType": 5126, "count": 33333, "type": "VEC3"},
                            {"bufferView": 2, "componentType": 5126, "count": 33333, "type": "SCALAR",
                                "min": [0], "max": [33.332]})";
    std::string channels, nodes = R"({"mesh": 0})", roots = "0";
    for (int i = 0; i < 4000; ++i) {
        nodes += ", {}";
        roots += fmt::format(", {}", i + 1);
        channels +=
            fmt::format(R"({}{{"sampler": 0, "target": {{"node": {}, "path": "translation"}}}})", i ? ", " : "", i);
    }
    document.nodes = nodes;
    document.roots = roots;
    document.rest = R"(, "animations": [{"channels": [)" + channels + R"(], "samplers": [{"input": 4, "output": 3}]}])";
    const TempFolder folder;
    Listener listener;
    const auto path = folder.write("t.gltf", document.json());
    const LoadOptions options{.log = listener.log, .time = 10.0005f};
    const gltf::File file = gltf::open(path, options);
    const std::size_t before = file.spent;
    EXPECT_EQ(gltf::readPose(file).translations.size(), 4000u);
    EXPECT_EQ(file.spent - before, 33333u + 33333u + 4000u * 3) << "the keys once, of each channel its three numbers";
    const Scene scene = loadGltf(path, options);
    // Key 10000 at 10 s holds the numbers 30000 to 30002 of the list.
    EXPECT_NEAR(scene.instances.at(0).world[3].x, 30.0015f, 1e-4f);
    EXPECT_NEAR(scene.instances.at(0).world[3].z, 30.0035f, 1e-4f);
}

TEST(GltfShared, LongNamesAreCutForCopies) {
    Document document;
    const std::string umlauts = repeat(5000, "ä");
    document.nodes = R"({"mesh": 0, "name": ")" + umlauts + R"("})";
    const Scene scene = document.load();
    EXPECT_EQ(scene.instances.at(0).name, repeat(100, "ä"));
    EXPECT_EQ(gltf::shortened("x" + umlauts), "x" + repeat(99, "ä")) << "no half letters";
}

// Without the limit each material would get 2 textures of its own.
TEST(GltfShared, ConvertedTexturesAreSharedAndCount) {
    Document document;
    const auto load = [&](std::size_t limit, const std::string& materials, std::string& told) {
        document.rest = R"(, "images": [{"uri": "data:image/png;base64,)" + std::string(test::kPng) +
                        R"("}], "textures": [{"source": 0}], "materials": [)" + materials +
                        R"(], "extensionsUsed": ["KHR_materials_pbrSpecularGlossiness"])";
        const TempFolder folder;
        Listener listener;
        LoadOptions options{.log = listener.log};
        options.limits.maxImageBytes = limit;
        Scene scene = loadGltf(folder.write("t.gltf", document.json()), options);
        told = listener.text;
        return scene;
    };
    const auto material = [](const char* glossiness) {
        return std::string(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness":
            {"specularGlossinessTexture": {"index": 0}, "glossinessFactor": )") +
               glossiness + "}}}";
    };
    std::string told;
    const std::string same = material("0.5") + repeat(9, ", " + material("0.5"));
    EXPECT_EQ(load(24, same, told).textures.size(), 3u) << "its own 8 bytes and two of 8";
    EXPECT_FALSE(contains(told, "no room")) << told;
    EXPECT_EQ(load(24, same + ", " + material("0.25"), told).textures.size(), 3u);
    EXPECT_TRUE(contains(told, "materials[10]: no room for textures")) << told;
    EXPECT_EQ(load(40, same + ", " + material("0.25"), told).textures.size(), 5u);
}

}  // namespace
}  // namespace crevice
