// Broken and hostile glTF files end in an Error that names the place, never in a crash.
#include <cmath>
#include <cstring>
#include <string>

#include "GltfTestTools.h"

namespace crevice {
namespace {

using test::append;
using test::contains;
using test::errorOf;
using Document = test::GltfText;
using test::Listener;
using test::TempFolder;

TEST(GltfHostile, AccessorsAreCheckedAgainstTheirBytes) {
    const auto errorWith = [](const std::string& accessor) {
        Document document;
        document.accessors = accessor + R"(, {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"})";
        return document.error();
    };
    const auto expect = [&](const std::string& accessor, const std::string& message) {
        const std::string error = errorWith(accessor);
        EXPECT_TRUE(contains(error, "accessors[0]: " + message)) << error;
        EXPECT_TRUE(contains(error, "test.gltf:4:")) << error;
    };
    expect(R"({"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3"})", "the range of 5 elements");
    expect(R"({"bufferView": 0, "byteOffset": 4, "componentType": 5126, "count": 4, "type": "VEC3"})",
           "the range of 4");
    expect(R"({"bufferView": 0, "byteOffset": 9007199254740000, "componentType": 5126, "count": 4, "type": "VEC3"})",
           "the range");
    expect(R"({"bufferView": 0, "componentType": 5126, "count": 4611686018427387905, "type": "VEC3"})",
           "'count' is not");
    expect(R"({"bufferView": 0, "componentType": 5126, "count": 9007199254740000, "type": "VEC3"})", "the range of");
    EXPECT_TRUE(contains(errorWith(R"({"componentType": 5126, "count": 900719925474099, "type": "VEC3"})"),
                         "meshes[0]: the scene has more than 100000000 vertices"));
    expect(R"({"bufferView": 9, "componentType": 5126, "count": 4, "type": "VEC3"})",
           "'bufferView' names bufferViews[9], the file has 2");
    expect(R"({"bufferView": 0, "componentType": 5126, "count": -1, "type": "VEC3"})", "'count' is not");
    expect(R"({"bufferView": 0, "componentType": 5126, "count": 0, "type": "VEC3"})", "'count' is 0");
    expect(R"({"bufferView": 0, "componentType": 5124, "count": 4, "type": "VEC3"})", "'componentType' 5124");
}

TEST(GltfHostile, BufferViewsAreCheckedAgainstTheirBuffer) {
    Document document;
    document.views = R"({"buffer": 0, "byteLength": 49, "byteOffset": 8}, {"buffer": 0, "byteLength": 8})";
    EXPECT_TRUE(contains(document.error(), "bufferViews[0]: 'byteOffset' 8 and 'byteLength' 49 reach beyond"))
        << document.error();
    document.views = R"({"buffer": 0, "byteLength": 48}, {"buffer": 3, "byteLength": 8})";
    EXPECT_TRUE(contains(document.error(), "bufferViews[1]: 'buffer'")) << document.error();
    document.views = R"({"buffer": 0, "byteLength": 1e300}, {"buffer": 0, "byteLength": 8})";
    EXPECT_TRUE(contains(document.error(), "bufferViews[0]: 'byteLength'")) << document.error();
    document.views = R"({"buffer": 0, "byteLength": 48, "byteStride": 8}, {"buffer": 0, "byteLength": 8})";
    EXPECT_TRUE(contains(document.error(), "'byteStride' 8 is less than")) << document.error();
}

TEST(GltfHostile, IndicesMustNameVertices) {
    Document document;
    document.bytes[52] = 4;  // the third index
    EXPECT_TRUE(contains(document.error(), "accessors[1]: index 4 at 2 is not below the 4 vertices"))
        << document.error();
}

TEST(GltfHostile, AttributesMustAgreeInCountAndType) {
    Document document;
    document.attributes = R"("POSITION": 0, "TEXCOORD_0": 1)";
    EXPECT_TRUE(contains(document.error(), "accessors[1]: 'count' is 3, but POSITION")) << document.error();
    document.attributes = R"("POSITION": 0, "TEXCOORD_0": 0)";
    EXPECT_TRUE(contains(document.error(), "accessors[0]: 'type' does not fit TEXCOORD_0")) << document.error();
    document.attributes = R"("POSITION": 7)";
    EXPECT_TRUE(contains(document.error(), "accessors[7]")) << document.error();
}

TEST(GltfHostile, PositionsMustBeFinite) {
    Document document;
    const float nan = std::nanf("");
    std::memcpy(document.bytes.data() + 4, &nan, sizeof nan);
    EXPECT_TRUE(contains(document.error(), "not a finite number")) << document.error();
}

TEST(GltfHostile, NodeCyclesAndDepthAreRefused) {
    Document document;
    document.nodes = R"({"children": [1]}, {"children": [0], "mesh": 0})";
    EXPECT_TRUE(contains(document.error(), "nodes[0]: it has two parents or is its own ancestor")) << document.error();
    document.nodes = R"({"children": [5]})";
    EXPECT_TRUE(contains(document.error(), "nodes[5]")) << document.error();
    document.nodes.clear();
    for (int i = 0; i < 300; ++i) document.nodes += R"({"children": [)" + std::to_string(i + 1) + "]}, ";
    document.nodes += R"({"mesh": 0})";
    EXPECT_TRUE(contains(document.error(), "nested deeper than 256")) << document.error();
}

TEST(GltfHostile, RequiredExtensionsAreNamedOptionalOnesNoted) {
    Document document;
    document.rest =
        R"(, "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"])";
    EXPECT_TRUE(contains(document.error(), "requires the extension 'KHR_draco_mesh_compression'")) << document.error();
    document.rest = R"(, "extensionsUsed": ["KHR_materials_sheen"])";
    Listener listener;
    EXPECT_EQ(document.load(&listener).instances.size(), 1u);
    EXPECT_TRUE(contains(listener.text, "'KHR_materials_sheen'")) << listener.text;
}

TEST(GltfHostile, VersionOneIsRefusedByName) {
    Document document;
    document.version = "1.0";
    EXPECT_TRUE(contains(document.error(), "glTF 1.0")) << document.error();
    document.version = "3.0";
    EXPECT_TRUE(contains(document.error(), "'asset.version'")) << document.error();
}

TEST(GltfHostile, BuffersAreReadOnlyFromTheScenesFolder) {
    const TempFolder folder;
    const Document bytes;
    const std::string content(bytes.bytes.begin(), bytes.bytes.end());
    folder.write("secret.bin", content);
    folder.write("scene/a b.bin", content + "more than is used");
    Document document;
    Listener listener;
    const auto load = [&](const std::string& uri) {
        document.uri = uri;
        return loadGltf(folder.write("scene/test.gltf", document.json()), {.log = listener.log});
    };
    EXPECT_EQ(load("a%20b.bin").instances.size(), 1u);
    for (const char* outside : {"../secret.bin", "x/../../secret.bin", "%2e%2e/secret.bin", "/etc/hostname"}) {
        const std::string error = errorOf([&] { load(outside); });
        EXPECT_TRUE(contains(error, "buffers[0]: ")) << error;
        EXPECT_TRUE(contains(error, "lies outside the scene's folder")) << error;
    }
    std::filesystem::create_symlink(folder.path() / "secret.bin", folder.path() / "scene/link.bin");
    EXPECT_TRUE(contains(errorOf([&] { load("link.bin"); }), "lies outside"));
    EXPECT_TRUE(contains(errorOf([&] { load("none.bin"); }), "buffers[0]: cannot read 'none.bin'"));
    folder.write("scene/short.bin", content.substr(1));
    EXPECT_TRUE(contains(errorOf([&] { load("short.bin"); }), "'short.bin' has 55 bytes, 'byteLength' says 56"));
    EXPECT_EQ(loadGltf(folder.write("scene/test.gltf", (document.uri = "../secret.bin", document.json())),
                       {.log = listener.log, .allowedRoots = {folder.path()}})
                  .instances.size(),
              1u);
}

TEST(GltfHostile, BinaryFilesLoadAndEveryTruncationIsAnError) {
    const TempFolder folder;
    const std::string whole = Document{}.glb();
    Listener listener;
    const auto load = [&](std::string_view content) {
        return loadGltf(folder.write("t.glb", content), {.log = listener.log});
    };
    EXPECT_EQ(test::triangleCount(load(whole)), 1u);
    for (std::size_t length = 0; length < whole.size(); ++length)
        ASSERT_NE(errorOf([&] { load(std::string_view(whole).substr(0, length)); }), "no error") << length;
    std::string old = whole;
    old[4] = 1;
    EXPECT_TRUE(contains(errorOf([&] { load(old); }), "glTF 1.0"));
}

TEST(GltfHostile, LimitsAreKept) {
    const TempFolder folder;
    Listener listener;
    Document document;
    const auto errorWith = [&](const LoadLimits& limits) {
        return errorOf(
            [&] { loadGltf(folder.write("t.gltf", document.json()), {.log = listener.log, .limits = limits}); });
    };
    EXPECT_EQ(errorWith({}), "no error");
    EXPECT_TRUE(contains(errorWith({.maxVertices = 3}), "more than 3 vertices")) << errorWith({.maxVertices = 3});
    EXPECT_TRUE(contains(errorWith({.maxInstances = 0}), "more than 0 instances"));
    EXPECT_NE(errorWith({.maxFileBytes = 100}), "no error");
}

// Any change of one byte ends in a scene or in an Error, never otherwise.
TEST(GltfHostile, MutatedFilesLoadOrAreRefused) {
    const TempFolder folder;
    Listener listener;
    Document document;
    document.accessors +=
        R"(, {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse": {"count": 1,
        "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}}})";
    document.attributes = R"("POSITION": 2)";
    document.rest =
        R"(, "materials": [{"alphaMode": "BLEND"}], "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])";
    std::uint32_t state = 12345;
    const auto random = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
    int loaded = 0, refused = 0;
    for (const std::string& whole : {document.json(), document.glb()})
        for (int i = 0; i < 1500; ++i) {
            std::string content = whole;
            constexpr char kLetters[] = "0123456789-[]{}\",:.eE \xff\x80n";
            content[random() % content.size()] = kLetters[random() % (sizeof kLetters - 1)];
            const auto path = folder.write(whole[0] == '{' ? "m.gltf" : "m.glb", content);
            errorOf([&] { loadGltf(path, {.log = listener.log}); }) == "no error" ? ++loaded : ++refused;
        }
    EXPECT_GT(loaded, 100);
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace crevice
