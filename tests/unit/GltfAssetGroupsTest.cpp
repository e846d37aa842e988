// Rows of the groups of Khronos' glTF-Asset-Generator that other tests do not have: what its tables say must be seen,
// as numbers of the scene. The files are our own.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "GltfTestTools.h"

namespace crevice {
namespace {

using test::append;
using test::contains;
using test::errorOf;
using Document = test::GltfText;
using test::Listener;
using test::TempFolder;

Scene loadAt(const Document& document, float time, Listener& listener) {
    const TempFolder folder;
    return loadGltf(folder.write("t.gltf", document.json()), {.log = listener.log, .time = time});
}

Scene loadAt(const Document& document, float time) {
    Listener listener;
    return loadAt(document, time, listener);
}

glm::vec3 placeOf(const Scene& scene, std::size_t instance = 0) {
    return glm::vec3(scene.instances.at(instance).world[3]);
}

/// Appends bytes as a view of their own; returns its index.
template <class T>
int addView(Document& document, std::initializer_list<T> values) {
    while (document.bytes.size() % 4) document.bytes.push_back(0);
    const std::size_t start = document.bytes.size();
    append<T>(document.bytes, values);
    document.views +=
        fmt::format(R"(, {{"buffer": 0, "byteOffset": {}, "byteLength": {}}})", start, document.bytes.size() - start);
    return int(std::count(document.views.begin(), document.views.end(), '{')) - 1;
}

// Negative/Mesh_PrimitiveRestart: the largest index that its type holds is a vertex like others, if there is one.
TEST(GltfAssetGroups, TheLargestIndexIsAVertex) {
    const auto documentOf = [](int vertices, int mode) {
        Document document;
        document.bytes.clear();
        for (int i = 0; i < vertices; ++i)
            append<float>(document.bytes, {i == 0 ? 1.0f : 0.0f, i == 1 ? 1.0f : 0.0f, float(i)});
        const std::size_t start = document.bytes.size();
        append<std::uint8_t>(document.bytes, {0, 1, 1, 255, 255, 0});
        document.attributes = R"("POSITION": 0, "NORMAL": 0)";  // shared vertices keep their numbers
        document.views = fmt::format(
            R"({{"buffer": 0, "byteLength": {}}}, {{"buffer": 0, "byteOffset": {}, "byteLength": 6}})", start, start);
        document.accessors = fmt::format(
            R"({{"bufferView": 0, "componentType": 5126, "count": {}, "type": "VEC3"}},
               {{"bufferView": 1, "componentType": 5121, "count": 6, "type": "SCALAR"}})",
            vertices);
        document.primitive = fmt::format(R"(, "indices": 1, "mode": {})", mode);
        return document;
    };
    for (int mode = 0; mode <= 6; ++mode) {
        Listener listener;
        const Scene scene = documentOf(256, mode).load(&listener);
        const std::vector<std::uint32_t>& indices = scene.meshes.at(0).indices;
        EXPECT_TRUE(std::count(indices.begin(), indices.end(), 255u)) << mode;
        EXPECT_TRUE(contains(listener.text, "255")) << mode << listener.text;
        EXPECT_TRUE(contains(documentOf(255, mode).error(), "255")) << mode;
    }
    EXPECT_EQ(documentOf(256, 3).load().meshes[0].indices,
              (std::vector<std::uint32_t>{0, 1, 1, 1, 1, 255, 255, 255, 255, 0}))
        << "no line is cut off";
}

/// One channel that moves node 0 along x. `times` and `values`: accessors.
std::string moving(const std::string& times, const std::string& values) {
    return R"(, "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
        "samplers": [{"input": )" +
           times + R"(, "output": )" + values + "}]}]";
}

// Accessor_Sparse 00, 01 and Accessor_SparseType 06.
TEST(GltfAssetGroups, KeysMayBeSparse) {
    Document document;
    const int times = addView<float>(document, {0, 1, 2}),
              values = addView<float>(document, {0, 0, 0, 4, 0, 0, 0, 0, 0});
    const int one = addView<std::uint8_t>(document, {1}), later = addView<float>(document, {1.5f});
    const int other = addView<float>(document, {0, 8, 0});
    const std::string sparse =
        fmt::format(R"("sparse": {{"count": 1, "indices": {{"bufferView": {}, "componentType": 5121}},
                                              "values": {{"bufferView": )",
                    one);
    const std::string scalar = R"("componentType": 5126, "count": 3, "type": "SCALAR", "min": [0], "max": [2])";
    const std::string vector = R"("componentType": 5126, "count": 3, "type": "VEC3")";
    document.accessors +=
        fmt::format(R"(, {{"bufferView": {}, {}}}, {{"bufferView": {}, {}}})", times, scalar, values, vector);
    document.accessors += fmt::format(R"(, {{"bufferView": {}, {}, {}{}}}}}}})", times, scalar, sparse, later);   // 4
    document.accessors += fmt::format(R"(, {{"bufferView": {}, {}, {}{}}}}}}})", values, vector, sparse, other);  // 5
    document.accessors += fmt::format(R"(, {{{}, {}{}}}}}}})", vector, sparse, other);                            // 6
    const auto at = [&](const char* input, const char* output, float time) {
        document.rest = moving(input, output);
        return placeOf(loadAt(document, time));
    };
    EXPECT_EQ(at("2", "3", 1.0f), glm::vec3(4, 0, 0)) << "as they are";
    EXPECT_EQ(at("4", "3", 1.5f), glm::vec3(4, 0, 0)) << "the second key half a second later";
    EXPECT_EQ(at("4", "3", 0.75f), glm::vec3(2, 0, 0));
    EXPECT_EQ(at("2", "5", 1.0f), glm::vec3(0, 8, 0)) << "another second value";
    EXPECT_EQ(at("2", "6", 0.5f), glm::vec3(0, 4, 0)) << "the rest are zeros";
    EXPECT_EQ(at("2", "6", 2.0f), glm::vec3(0, 0, 0));
}

// Animation_SamplerType 01 and 02.
TEST(GltfAssetGroups, TurnsMayBeNormalisedIntegers) {
    const auto turned = [](auto largest, int type) {
        using T = decltype(largest);
        Document document;
        const int times = addView<float>(document, {0, 2});
        const int values = addView<T>(document, {0, 0, 0, largest, 0, 0, largest, 0});  // none, then half about z
        document.accessors += fmt::format(
            R"(, {{"bufferView": {}, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [2]}},
               {{"bufferView": {}, "componentType": {}, "normalized": true, "count": 2, "type": "VEC4"}})",
            times, values, type);
        document.rest = R"(, "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}],
            "samplers": [{"input": 2, "output": 3}]}])";
        return glm::vec3(loadAt(document, 1).instances.at(0).world[0]);
    };
    EXPECT_LT(glm::distance(turned(std::int8_t(127), 5120), glm::vec3(0, 1, 0)), 1e-6f);
    EXPECT_LT(glm::distance(turned(std::int16_t(32767), 5122), glm::vec3(0, 1, 0)), 1e-6f);
}

// Animation_NodeMisc 02, 07 and 08, Instancing 11: other beginnings, other nodes, none; one sampler for two.
TEST(GltfAssetGroups, ChannelsHaveTheirOwnTimesAndNodes) {
    Document document;
    const int early = addView<float>(document, {1, 3}), late = addView<float>(document, {2, 6});
    const int values = addView<float>(document, {0, 0, 0, 8, 0, 0}),
              sizes = addView<float>(document, {1, 1, 1, 3, 3, 3});
    const char* times =
        R"(, {{"bufferView": {}, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [{}], "max": [{}]}})";
    document.accessors += fmt::format(fmt::runtime(times), early, 1, 3) + fmt::format(fmt::runtime(times), late, 2, 6);
    for (const int view : {values, sizes})
        document.accessors +=
            fmt::format(R"(, {{"bufferView": {}, "componentType": 5126, "count": 2, "type": "VEC3"}})", view);
    document.nodes = R"({"mesh": 0}, {"mesh": 0, "scale": [2, 2, 2]})";
    document.roots = "0, 1";
    document.rest = R"(, "animations": [{"channels": [
        {"sampler": 0, "target": {"node": 0, "path": "translation"}}, {"sampler": 1, "target": {"node": 0, "path": "scale"}},
        {"sampler": 0, "target": {"node": 1, "path": "translation"}}, {"sampler": 1, "target": {"path": "scale"}}],
        "samplers": [{"input": 2, "output": 4}, {"input": 3, "output": 5}]}])";
    const Scene scene = loadAt(document, 2);
    EXPECT_EQ(placeOf(scene, 0), glm::vec3(4, 0, 0));
    EXPECT_EQ(placeOf(scene, 1), glm::vec3(4, 0, 0));
    EXPECT_EQ(scene.instances[0].world[0].x, 1) << "its second channel begins now";
    EXPECT_EQ(scene.instances[1].world[0].x, 2) << "the channel without a node moves none";
    EXPECT_EQ(loadAt(document, 4).instances[0].world[0].x, 2);
    EXPECT_EQ(placeOf(loadAt(document, 4), 0), glm::vec3(8, 0, 0)) << "the first has ended";
}

// Whoever asks for a moment of any number of files gets those that do not move, too.
TEST(GltfAssetGroups, ATimeWithoutAnimationsIsTheRestPose) {
    const Document document;
    Listener listener;
    EXPECT_EQ(loadAt(document, 3, listener).instances.size(), 1u);
    EXPECT_TRUE(contains(listener.text, "shown in its rest pose")) << listener.text;
    const TempFolder folder;
    LoadOptions options{.log = listener.log, .animation = "0", .time = 3.0f};
    EXPECT_TRUE(
        contains(errorOf([&] { loadGltf(folder.write("t.gltf", document.json()), options); }), "no animation '0'"));
}

// Specification, 3.9: a primitive without a material has the default one, that of an object without properties.
TEST(GltfAssetGroups, NoMaterialIsAnEmptyMaterial) {
    Document document;
    const Scene without = document.load();
    document.primitive += R"(, "material": 0)";
    document.rest = R"(, "materials": [{}])";
    const Scene empty = document.load();
    ASSERT_EQ(without.materials.size(), 1u);
    ASSERT_EQ(empty.materials.size(), 1u);
    for (const Scene* scene : {&without, &empty}) {
        const SceneMaterial& material = scene->materials[0];
        EXPECT_EQ(material.baseColor, glm::vec4(1));
        EXPECT_EQ(material.metallic, 1);
        EXPECT_EQ(material.roughness, 1);
        EXPECT_EQ(material.emissive, glm::vec3(0));
        EXPECT_EQ(material.alphaMode, AlphaMode::Opaque);
        EXPECT_FALSE(material.doubleSided || material.unlit || material.baseColorMap || material.normalMap);
    }
}

}  // namespace
}  // namespace crevice
