// Small glTF files that ask for a great deal of work or memory: what is checked grows with the file, not with products
// of what it names.
#include <fmt/format.h>

#include "GltfTestTools.h"
#include "scene/GltfParts.h"

namespace crevice {
namespace {

using test::contains;
using test::errorOf;
using Document = test::GltfText;
using test::Listener;
using test::TempFolder;

/// Opens a file, which checks everything in it, and says what that took.
gltf::WorkDone workOf(const Document& document, Listener& listener) {
    const TempFolder folder;
    const LoadOptions options{.log = listener.log};
    return gltf::open(folder.write("t.gltf", document.json()), options).work;
}

std::string repeat(int count, const std::string& text) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

// 600 nodes × 600 primitives × 16384 numbers are 6e9. None of the nodes is shown.
TEST(GltfWork, JointsOfManyNodesAndPrimitivesAreReadOnce) {
    Document document;
    document.bytes.assign(4096 * 12, 0);
    document.bytes[7] = 2;  // vertex 1 names joint 2, of 2
    document.views = R"({"buffer": 0, "byteLength": 49152}, {"buffer": 0, "byteLength": 16384})";
    document.accessors = R"({"bufferView": 0, "componentType": 5126, "count": 4096, "type": "VEC3"},
        {"bufferView": 1, "componentType": 5121, "count": 4096, "type": "VEC4"},
        {"bufferView": 1, "componentType": 5121, "normalized": true, "count": 4096, "type": "VEC4"})";
    document.attributes = R"("POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2)";
    document.primitive = repeat(599, "}, {\"attributes\": {" + document.attributes + "}");
    document.nodes = R"({"children": [1, 2]}, {}, {})" + repeat(600, R"(, {"mesh": 0, "skin": 1})");
    document.rest = R"(, "skins": [{"joints": [0, 1, 2]}, {"joints": [1, 2]}])";
    Listener listener;
    EXPECT_EQ(workOf(document, listener).jointNumbers, 16384u);
    EXPECT_TRUE(contains(listener.text, "accessors[1]: it names joint 2, skins[1] has 2")) << listener.text;
}

// The smallest of the skins counts, whatever the order of the nodes.
TEST(GltfWork, AMeshOfSeveralSkinsIsHeldAgainstTheSmallest) {
    Document document;
    test::append<std::uint8_t>(document.bytes, {0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
    document.views += R"(, {"buffer": 0, "byteOffset": 56, "byteLength": 16})";
    document.accessors += R"(, {"bufferView": 2, "componentType": 5121, "count": 4, "type": "VEC4"},
        {"bufferView": 2, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4"})";
    document.attributes = R"("POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3)";
    const auto toldWith = [&](int first, int second) {
        document.nodes = fmt::format(
            R"({{"children": [1]}}, {{}}, {{"mesh": 0, "skin": {}}}, {{"mesh": 0, "skin": {}}})", first, second);
        Listener listener;
        document.load(&listener);
        return listener.text;
    };
    document.rest = R"(, "skins": [{"joints": [0, 1]}, {"joints": [0]}])";
    EXPECT_TRUE(contains(toldWith(0, 1), "accessors[2]: it names joint 1, skins[1] has 1"));
    EXPECT_TRUE(contains(toldWith(1, 0), "accessors[2]: it names joint 1, skins[1] has 1"));
    EXPECT_FALSE(contains(toldWith(0, 0), "it names joint"));
}

// Walking from each of 30000 joints up to the root, in each of 60 scenes, are 3e10 steps.
TEST(GltfWork, LongChainsOfJointsAreWalkedOnce) {
    Document document;
    const int length = 30000;
    std::string joints = "1";
    document.nodes = "{}";
    for (int i = 1; i < length; ++i) {
        document.nodes += fmt::format(R"(, {{"children": [{}]}})", i + 1);
        joints += fmt::format(", {}", i + 1);
    }
    document.nodes += R"(, {}, {"mesh": 0, "skin": 0})";
    document.scenes = repeat(60, fmt::format(R"(, {{"nodes": [1, {}]}})", length + 1));
    document.rest = R"(, "skins": [{"skeleton": 1, "joints": [)" + joints + "]}]";
    Listener listener;
    // Into each node and out again; one question for its root and one for the skeleton for each joint.
    EXPECT_LT(workOf(document, listener).treeSteps, std::size_t(4 * length + 100));
    EXPECT_FALSE(contains(listener.text, "skins[0]")) << listener.text;
    document.rest = R"(, "skins": [{"skeleton": 3, "joints": [)" + joints + "]}]";
    Listener other;
    document.load(&other);
    EXPECT_TRUE(contains(other.text, "skins[0]: 'skeleton' is not above the joint nodes[1]")) << other.text;
}

TEST(GltfWork, ScenesAreToldThatLackATreeOfJoints) {
    Document document;
    document.nodes = R"({}, {"children": [2]}, {}, {"children": [4]}, {"mesh": 0, "skin": 0})";
    document.scenes = R"(, {"nodes": [3]}, {"nodes": [3, 1]}, {"nodes": [1]})";
    document.rest = R"(, "skins": [{"joints": [2]}])";
    Listener listener;
    document.load(&listener);
    EXPECT_TRUE(contains(listener.text, "scenes[1]: it shows a mesh of skins[0], but not its joints"));
    for (const char* right : {"scenes[0]", "scenes[2]", "scenes[3]"}) EXPECT_FALSE(contains(listener.text, right));
}

// 30000 materials × 512² pixels are 8e9.
TEST(GltfWork, PicturesAreLookedThroughOnceForAllMaterials) {
    Scene scene;
    const Image blank(512, 512, Format::RGBA8);
    scene.textures.resize(2, {.name = "whole", .image = blank, .srgb = true, .sampler = {}});
    for (SceneTexture& texture : scene.textures)
        std::fill(texture.image.pixels.begin(), texture.image.pixels.end(), std::byte(255));
    scene.textures[1].image.pixels.back() = std::byte(254);
    SceneMaterial material;
    material.alphaMode = AlphaMode::Blend;
    material.baseColorMap.texture = 0;
    scene.materials.assign(30000, material);
    scene.materials[7].baseColorMap.texture = 1;
    scene.meshes.resize(1);
    scene.instances.resize(29999);
    for (int i = 0; i < 29999; ++i) scene.instances[std::size_t(i)].material = i;
    EXPECT_EQ(gltf::drawOpaqueWhatIs(scene), 2u * 512 * 512);
    EXPECT_EQ(scene.materials[6].alphaMode, AlphaMode::Opaque);
    EXPECT_EQ(scene.materials[7].alphaMode, AlphaMode::Blend) << "its picture has a hole";
    EXPECT_EQ(scene.materials[29998].alphaMode, AlphaMode::Opaque);
    EXPECT_EQ(scene.materials[29999].alphaMode, AlphaMode::Blend) << "nothing is drawn with it";
}

/// Right with --strict as well.
Document makeStrict() {
    Document document;
    document.accessors = R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                             "min": [0, 0, 0], "max": [1, 1, 0]},
                            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"})";
    return document;
}

std::string strictError(const Document& document) {
    const TempFolder folder;
    Listener listener;
    return errorOf([&] { loadGltf(folder.write("t.gltf", document.json()), {.log = listener.log, .strict = true}); });
}

// 5e8 matrices would be 32 GB.
TEST(GltfWork, StrictDoesNotReadZerosThatAreNotStored) {
    Document document = makeStrict();
    const auto add = [&](const std::string& count) {
        document.accessors += R"(, {"componentType": 5126, "type": "MAT4", "max": [1], "count": )" + count +
                              R"(, "sparse": {"count": 1, "indices": {"bufferView": 1, "componentType": 5123},
                                              "values": {"bufferView": 2}}})";
    };
    document.bytes.resize(56 + 64);
    document.views += R"(, {"buffer": 0, "byteOffset": 56, "byteLength": 64})";
    add("500000000");
    EXPECT_EQ(strictError(document), "no error");
    add("4096");
    EXPECT_TRUE(contains(strictError(document), "accessors[3]: 'max' has not 16 numbers")) << strictError(document);
}

// 2500 × 4096 elements are more than the 1e7 that are looked at; the bounds of the last ones are wrong.
TEST(GltfWork, ElementsThatAreLookedAtAreLimitedButNotWithStrict) {
    Document document = makeStrict();
    document.bytes.resize(4096);
    document.views += R"(, {"buffer": 0, "byteLength": 4096})";
    const auto accessor = [](const std::string& bounds) {
        return R"(, {"bufferView": 2, "componentType": 5121, "count": 4096, "type": "SCALAR")" + bounds + "}";
    };
    const auto told = [&] {
        Listener listener;
        document.load(&listener);
        return listener.text;
    };
    const std::string start = document.accessors;
    document.accessors = start + repeat(2400, accessor("")) + accessor(R"(, "max": [300])");
    EXPECT_TRUE(contains(told(), "accessors[2402]: 'max' says 300"));
    document.accessors = start + repeat(2500, accessor("")) + accessor(R"(, "max": [300])");
    EXPECT_FALSE(contains(told(), "accessors[2502]"));
    EXPECT_TRUE(contains(strictError(document), "accessors[2502]: 'max' says 300")) << strictError(document);
}

TEST(GltfWork, ListsOfExtensionsHoldNames) {
    Document document;
    const auto expect = [&](const std::string& rest, const std::string& message) {
        document.rest = rest;
        EXPECT_TRUE(contains(document.error(), message)) << document.error();
        EXPECT_TRUE(contains(strictError(document), message)) << strictError(document);
    };
    for (const std::string key : {"extensionsUsed", "extensionsRequired"}) {
        expect(", \"" + key + "\": [1]", "'" + key + "' holds a number");
        expect(", \"" + key + "\": [\"KHR_materials_unlit\", null]", "'" + key + "' holds");
        expect(", \"" + key + "\": 5", "'" + key + "' is not a list");
    }
}

// The limit grows with the file as it was opened; to ask for it walks through nothing, so later parts do not count.
TEST(GltfWork, BytesHeldAreCountedOnce) {
    const TempFolder folder;
    Listener listener;
    const LoadOptions options{.log = listener.log};
    gltf::File file = gltf::open(folder.write("t.gltf", Document().json()), options);
    std::size_t bytes = file.content.size();
    for (const auto& part : file.storage) bytes += part.size();
    EXPECT_EQ(file.bytesHeld, bytes);
    file.storage.emplace_back(1000);
    file.spend(10'000'000 + 4 * bytes - file.spent);
    EXPECT_TRUE(contains(errorOf([&] { file.spend(1); }), "name the same bytes so often"));
}

// 200 trees show 200 skins each, in 260 scenes: 1.04e7 looks for a tree of joints.
TEST(GltfWork, StrictRefusesScenesThatShowSkinsTooOften) {
    Document document = makeStrict();
    test::append<std::uint8_t>(document.bytes, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    test::append<std::uint8_t>(document.bytes, {255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0});
    document.views +=
        R"(, {"buffer": 0, "byteOffset": 56, "byteLength": 16}, {"buffer": 0, "byteOffset": 72, "byteLength": 16})";
    document.accessors += R"(, {"bufferView": 2, "componentType": 5121, "count": 4, "type": "VEC4"},
        {"bufferView": 3, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4"})";
    document.attributes = R"("POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3)";
    constexpr int kTrees = 200;
    std::string joints, parents, leaves, skins;  // nodes 0 … 199, 200 … 399 and what is below these
    for (int i = 0; i < kTrees; ++i) {
        document.roots += i ? fmt::format(", {}, {}", i, kTrees + i) : fmt::format(", {}", kTrees);
        joints += "{}, ";
        skins += fmt::format(R"({}{{"joints": [{}]}})", i ? ", " : "", i);
        std::string children;
        for (int k = 0; k < kTrees; ++k) {
            children += fmt::format("{}{}", k ? ", " : "", (2 + i) * kTrees + k);
            leaves += fmt::format(R"(, {{"mesh": 0, "skin": {}}})", k);
        }
        parents += fmt::format(R"({}{{"children": [{}]}})", i ? ", " : "", children);
    }
    document.nodes = joints + parents + leaves;
    document.rest = R"(, "skins": [)" + skins + "]";
    const auto errorWith = [&](int scenes, bool strict) {
        document.scenes = repeat(scenes - 1, R"(, {"nodes": [)" + document.roots + "]}");
        const TempFolder folder;
        Listener listener;
        const LoadOptions options{.log = listener.log, .strict = strict};
        return errorOf([&] { gltf::open(folder.write("t.gltf", document.json()), options); });
    };
    EXPECT_EQ(errorWith(240, true), "no error");
    EXPECT_TRUE(contains(errorWith(260, true), "their joints are looked for more than 10000000 times"));
    EXPECT_EQ(errorWith(260, false), "no error");
}

// Nodes of as many skins read a mesh's primitives and targets once each, be there vertices or not.
TEST(GltfWork, MeshesAreDeformedALimitedNumberOfTimes) {
    const TempFolder folder;
    const auto errorOfNodes = [&](Document document, int count) {
        std::string skins;
        document.nodes.clear();
        document.roots.clear();
        for (int i = 0; i < count; ++i) {
            document.nodes += fmt::format(R"({}{{"mesh": 0, "skin": {}}})", i ? ", " : "", i);
            document.roots += fmt::format("{}{}", i ? ", " : "", i);
            skins += fmt::format(R"({}{{"joints": [0]}})", i ? ", " : "");
        }
        document.rest = R"(, "skins": [)" + skins + "]";
        Listener listener;
        LoadOptions options{.log = listener.log};
        options.limits.maxInstances = 500;  // 2000 readings
        return errorOf([&] { loadGltf(folder.write("t.gltf", document.json()), options); });
    };
    const std::string message = "meshes[0]: nodes deform meshes so often that more than 2000 primitives and targets";
    Document empty;
    empty.attributes = R"("NORMAL": 0)";
    empty.primitive = R"(}, {"attributes": {"NORMAL": 0})";
    EXPECT_EQ(errorOfNodes(empty, 1000), "no error");
    EXPECT_TRUE(contains(errorOfNodes(empty, 1001), message)) << errorOfNodes(empty, 1001);
    EXPECT_TRUE(contains(errorOfNodes(empty, 1001), "--limit instances=N"));
    Document targets;  // 6400 of weight 0 are 100 readings
    targets.primitive = R"(, "targets": [{"POSITION": 0})" + repeat(6399, R"(, {"POSITION": 0})") +
                        R"(]}], "weights": [0)" + repeat(6399, ", 0") + R"(], "extras": [{)";
    EXPECT_EQ(errorOfNodes(targets, 19), "no error");
    EXPECT_TRUE(contains(errorOfNodes(targets, 20), message)) << errorOfNodes(targets, 20);
}

}  // namespace
}  // namespace crevice
