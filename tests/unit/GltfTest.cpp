// glTF files small enough to read here, and what they become.
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
using test::kPng;
using test::Listener;
using test::TempFolder;

TEST(Gltf, TriangleWithoutNormalsGetsFlatOnes) {
    const Scene scene = Document{}.load();
    ASSERT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.name, "square");
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_FALSE(mesh.hasTangents);
    for (const Vertex& vertex : mesh.vertices) {
        EXPECT_EQ(vertex.normal, glm::vec3(0, 0, 1));
        EXPECT_EQ(vertex.color, glm::vec4(1));
    }
    EXPECT_EQ(mesh.bounds.max, glm::vec3(1, 1, 0));
}

TEST(Gltf, StripsAndFansBecomeTriangleLists) {
    // Normals keep the vertices shared, so that the indices can be compared.
    Document document;
    document.attributes = R"("POSITION": 0, "NORMAL": 0)";
    document.accessors.replace(document.accessors.find(R"("count": 3)"), 10, R"("count": 4)");
    document.primitive = R"(, "indices": 1, "mode": 5)";
    EXPECT_EQ(document.load().meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
    document.primitive = R"(, "indices": 1, "mode": 6)";
    EXPECT_EQ(document.load().meshes[0].indices, (std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0}));
    document.primitive = R"(, "mode": 6)";  // no indices
    EXPECT_EQ(document.load().meshes[0].indices, (std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0}));
}

// glTF 2.0, 3.7.2.1: loops close, strips share ends; 3.9.7: without normals they are not lit.
TEST(Gltf, PointsAndLinesKeepTheirTopology) {
    using Indices = std::vector<std::uint32_t>;
    Document document;
    const auto meshOf = [&](int mode) {
        document.primitive = R"(, "mode": )" + std::to_string(mode);
        const Scene scene = document.load();
        EXPECT_TRUE(scene.materials[scene.instances.at(0).material].unlit);
        return scene.meshes.at(0);
    };
    EXPECT_EQ(meshOf(0).topology, MeshTopology::Points);
    EXPECT_EQ(meshOf(0).indices, (Indices{0, 1, 2, 3}));
    EXPECT_EQ(meshOf(1).topology, MeshTopology::Lines);
    EXPECT_EQ(meshOf(1).indices, (Indices{0, 1, 2, 3}));
    EXPECT_EQ(meshOf(2).indices, (Indices{0, 1, 1, 2, 2, 3, 3, 0}));
    EXPECT_EQ(meshOf(3).indices, (Indices{0, 1, 1, 2, 2, 3}));
    document.attributes = R"("POSITION": 0, "NORMAL": 0)";
    document.primitive = R"(, "mode": 1)";
    const Scene lit = document.load();
    EXPECT_FALSE(lit.materials[lit.instances[0].material].unlit);
}

TEST(Gltf, NormalisedColoursOfEveryTypeAndInterleaving) {
    Document document;
    document.bytes.clear();
    for (int i = 0; i < 3; ++i) {  // 20 bytes per vertex: position, colour u8 × 4, colour u16 (2 of 4)
        append<float>(document.bytes, {float(i), float(i == 1), 0});
        append<std::uint8_t>(document.bytes, {255, 51, 0, 102});
        append<std::int16_t>(document.bytes, {32767, -32768});
    }
    document.views =
        R"({"buffer": 0, "byteLength": 48, "byteStride": 16}, {"buffer": 0, "byteLength": 60, "byteStride": 20})";
    document.accessors = R"({"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"},
        {"bufferView": 1, "byteOffset": 12, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC4"},
        {"bufferView": 1, "byteOffset": 16, "componentType": 5122, "normalized": true, "count": 3, "type": "VEC2"})";
    document.attributes = R"("POSITION": 0, "COLOR_0": 1, "TEXCOORD_0": 2)";
    document.primitive = "";
    const Mesh mesh = document.load().meshes.at(0);
    EXPECT_EQ(mesh.vertices[1].position, glm::vec3(1, 1, 0));
    EXPECT_LT(glm::distance(mesh.vertices[1].color, glm::vec4(1, 0.2f, 0, 0.4f)), 1e-6f);
    EXPECT_EQ(mesh.vertices[2].uv0, glm::vec2(1, -1));
}

TEST(Gltf, SparseAccessorsOverwriteTheirBase) {
    Document document;
    append<float>(document.bytes, {9, 8, 7});
    document.views +=
        R"(, {"buffer": 0, "byteOffset": 52, "byteLength": 2}, {"buffer": 0, "byteOffset": 56, "byteLength": 12})";
    const auto withSparse = [&](const std::string& sparse) {
        document.accessors = R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse": )" +
                             sparse + R"(}, {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"})";
    };
    // Byte 52 holds the index 2.
    withSparse(R"({"count": 1, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}})");
    EXPECT_EQ(document.load().meshes[0].vertices[2].position, glm::vec3(9, 8, 7));
    withSparse(R"({"count": 2, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}})");
    EXPECT_TRUE(contains(document.error(), "accessors[0]: 'sparse.indices'")) << document.error();
    withSparse(R"({"count": 1})");
    EXPECT_TRUE(contains(document.error(), "accessors[0]: in 'sparse': 'indices' is missing")) << document.error();
    document.bytes[52] = 4;
    withSparse(R"({"count": 1, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}})");
    EXPECT_TRUE(contains(document.error(), "sparse index 4 at 0 is not below 'count' 4")) << document.error();
}

TEST(Gltf, EqualPrimitivesShareTheirMesh) {
    Document document;
    document.nodes = R"({"mesh": 0, "children": [1]}, {"mesh": 0, "translation": [0, 0, 5], "scale": [2, 2, 2]})";
    const Scene scene = document.load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(glm::vec3(scene.instances[1].world * glm::vec4(1, 0, 0, 1)), glm::vec3(2, 0, 5));
}

TEST(Gltf, NodesComposeMatricesAndTurns) {
    Document document;
    document.nodes = R"({"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 10,0,0,1], "children": [1]},
                        {"mesh": 0, "rotation": [0, 0.70710678, 0, 0.70710678]})";
    const Scene scene = document.load();
    const glm::vec3 moved(scene.instances[0].world * glm::vec4(1, 0, 0, 1));
    EXPECT_LT(glm::distance(moved, glm::vec3(10, 0, -1)), 1e-5f);
    EXPECT_FALSE(scene.instances[0].flipped);
}

TEST(Gltf, NegativeScaleIsMarkedAsFlipped) {
    Document document;
    document.nodes = R"({"mesh": 0, "scale": [-1, 1, 1]})";
    EXPECT_TRUE(document.load().instances[0].flipped);
    document.nodes = R"({"mesh": 0, "scale": [-1, -1, 1]})";
    EXPECT_FALSE(document.load().instances[0].flipped);
}

TEST(Gltf, CamerasAndLightsStandInTheWorld) {
    Document document;
    document.nodes = R"({"mesh": 0}, {"camera": 0, "translation": [1, 2, 3]}, {"camera": 1},
        {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [4, 5, 6], "rotation": [0, 1, 0, 0]})";
    document.roots = "0, 1, 2, 3";
    document.rest = R"(, "extensionsRequired": ["KHR_lights_punctual"], "cameras": [
        {"type": "perspective", "name": "wide", "perspective": {"yfov": 1.5, "znear": 0.25}},
        {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0, "zfar": 10}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "color": [1, 0.5, 0], "intensity": 20, "range": 9,
            "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}]}})";
    const Scene scene = document.load();
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "wide");
    EXPECT_FLOAT_EQ(scene.cameras[0].fovY, 1.5f);
    EXPECT_FLOAT_EQ(scene.cameras[0].near, 0.25f);
    EXPECT_EQ(scene.cameras[0].far, 0);
    EXPECT_LT(glm::distance(scene.cameras[0].position(), {1, 2, 3}), 1e-6f);
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_FLOAT_EQ(scene.cameras[1].orthoHeight, 4);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].type, LightType::Spot);
    EXPECT_EQ(scene.lights[0].position, glm::vec3(4, 5, 6));
    EXPECT_LT(glm::distance(scene.lights[0].direction, glm::vec3(0, 0, 1)), 1e-6f);  // turned half round from -z
    EXPECT_FLOAT_EQ(scene.lights[0].outerAngle, 0.5f);
    EXPECT_FLOAT_EQ(scene.lights[0].range, 9);
}

TEST(Gltf, MaterialsKeepTheirNumbersAndTextures) {
    Document document;
    document.primitive = R"(, "indices": 1, "material": 0)";
    document.rest = R"(, "extensionsUsed": ["KHR_materials_emissive_strength"],
        "materials": [{"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 0.75], "metallicFactor": 0.5,
            "roughnessFactor": 0.25, "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0, "texCoord": 1}},
            "emissiveFactor": [1, 0.5, 0], "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}}],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728, "minFilter": 9984}],
        "images": [{"uri": "data:image/png;base64,)" +
                    std::string(kPng) + R"("}])";
    const Scene scene = document.load();
    ASSERT_EQ(scene.materials.size(), 1u);
    const SceneMaterial& material = scene.materials[0];
    EXPECT_EQ(material.name, "paint");
    EXPECT_EQ(material.baseColor, glm::vec4(0.5f, 0.25f, 1, 0.75f));
    EXPECT_EQ(material.emissive, glm::vec3(4, 2, 0));
    EXPECT_EQ(material.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(material.alphaCutoff, 0.25f);
    EXPECT_TRUE(material.doubleSided);
    EXPECT_EQ(material.metallicRoughnessMap.texcoord, 1);
    // One image, used as colour and as data.
    ASSERT_EQ(scene.textures.size(), 2u);
    EXPECT_TRUE(scene.textures[material.baseColorMap.texture].srgb);
    EXPECT_FALSE(scene.textures[material.metallicRoughnessMap.texture].srgb);
    const SamplerDesc expected{.wrapU = TextureWrap::Clamp,
                               .wrapV = TextureWrap::Mirror,
                               .linearMag = false,
                               .linearMin = false,
                               .mipmaps = true,
                               .linearMip = false};
    EXPECT_EQ(scene.textures[0].sampler, expected);
    const Image& image = scene.textures[0].image;
    ASSERT_EQ(image.format, Format::RGBA8);
    EXPECT_EQ(image.width, 2u);
    EXPECT_EQ(image.height, 1u);
}

TEST(Gltf, MissingAndBrokenImagesAreWhiteWithAWarning) {
    for (const char* image : {R"({"uri": "none.png"})", R"({"uri": "data:image/png;base64,iVBORw0KGgo="})",
                              R"({"bufferView": 0, "mimeType": "image/png"})"}) {
        Document document;
        Listener listener;
        document.primitive = R"(, "indices": 1, "material": 0)";
        document.rest =
            R"(, "materials": [{"emissiveTexture": {"index": 0}}], "textures": [{"source": 0}], "images": [)" +
            std::string(image) + "]";
        const Scene scene = document.load(&listener);
        ASSERT_EQ(scene.textures.size(), 1u);
        EXPECT_EQ(scene.textures[0].image.at(0, 0), glm::vec4(1));
        EXPECT_TRUE(contains(listener.text, "images[0]")) << listener.text;
        EXPECT_TRUE(contains(listener.text, "shown white")) << listener.text;
    }
}

TEST(Gltf, HugePicturesAreNotDecoded) {
    // A PNG header that claims 2^31 - 1 pixels a side.
    std::vector<unsigned char> png = {0x89, 'P',  'N',  'G',  '\r', '\n', 0x1a, '\n', 0,    0, 0, 13, 'I', 'H', 'D',
                                      'R',  0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff, 8, 6, 0,  0,   0};
    Document document;
    Listener listener;
    document.primitive = R"(, "indices": 1, "material": 0)";
    document.rest = R"(, "materials": [{"emissiveTexture": {"index": 0}}], "textures": [{"source": 0}],
        "images": [{"uri": "data:image/png;base64,)" +
                    test::encodeBase64(png) + R"("}])";
    EXPECT_EQ(document.load(&listener).textures.at(0).image.width, 1u);
    EXPECT_TRUE(contains(listener.text, "2147483647 x 2147483647")) << listener.text;
}

// glTF 2.0 specification, 2.7: 1.0 and 1e0 are integers, wherever they stand.
TEST(Gltf, IntegersMayBeWrittenAsDecimals) {
    Document document;
    document.attributes = R"("POSITION": 0.0)";
    document.primitive = R"(, "indices": 1e0, "mode": 4.0)";
    document.views = R"({"buffer": 0.0, "byteLength": 4.8e1}, {"buffer": 0, "byteOffset": 48.0, "byteLength": 8.0})";
    document.accessors = R"({"bufferView": 0.0, "componentType": 5126.0, "count": 4.0, "type": "VEC3"},
                            {"bufferView": 1.0, "componentType": 5123.0, "count": 3.0, "type": "SCALAR"})";
    document.nodes = R"({"children": [1.0]}, {"mesh": 0.0})";
    document.roots = "0.0";
    Listener listener;
    const Scene scene = document.load(&listener);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.meshes.at(0).indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_FALSE(contains(listener.text, "fraction")) << listener.text;
}

// 3.7.2.1: colours are clamped to 0 … 1.
TEST(Gltf, VertexColoursAreClamped) {
    Document document;
    const std::size_t start = document.bytes.size();
    append<float>(document.bytes, {2, -1, 0.5f, 1, 0, 0, 0, 1.5f, 0, 0, 0, 0, 0, 0, 0, 0});
    document.views += R"(, {"buffer": 0, "byteOffset": )" + std::to_string(start) + R"(, "byteLength": 64})";
    document.accessors += R"(, {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC4"})";
    document.attributes += R"(, "NORMAL": 0, "COLOR_0": 2)";
    const Scene scene = document.load();
    EXPECT_EQ(scene.meshes.at(0).vertices.at(0).color, glm::vec4(1, 0, 0.5f, 1));
    EXPECT_EQ(scene.meshes.at(0).vertices.at(1).color, glm::vec4(0, 0, 0, 1));
}

// 3.6.2.5: bounds of an accessor whose data is not in the file may be anything.
TEST(Gltf, BoundsOfAccessorsWithoutDataAreNotChecked) {
    Document document;
    document.accessors = R"({"componentType": 5126, "count": 4, "type": "VEC3", "min": [-7, 0, 0], "max": [9, 9, 9]},
                            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"})";
    Listener listener;
    EXPECT_EQ(document.load(&listener).meshes.at(0).bounds.max, glm::vec3(0));
    EXPECT_EQ(listener.text, "");
}

// 3.10.3: a picture of another aspect ratio neither crops nor stretches what the camera frames.
TEST(Gltf, CamerasFrameAllThatTheySeeAtAnyAspect) {
    Document document;
    document.nodes = R"({"camera": 0}, {"camera": 1}, {"camera": 2})";
    document.roots = "0, 1, 2";
    document.rest = R"(, "cameras": [
        {"type": "orthographic", "orthographic": {"xmag": -3, "ymag": 1, "znear": 0, "zfar": 10}},
        {"type": "perspective", "perspective": {"yfov": 1.5707963, "aspectRatio": 2, "znear": 1}},
        {"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])";
    const TempFolder folder;
    const auto path = folder.write("t.gltf", document.json());
    const auto load = [&](float aspect) {
        Listener listener;
        return loadGltf(path, {.log = listener.log, .aspect = aspect}).cameras;
    };
    for (const float aspect : {0.0f, 3.0f, 4.0f}) {  // unknown, the camera's own, wider
        EXPECT_EQ(load(aspect).at(0).orthoHeight, 2) << aspect;
        EXPECT_FLOAT_EQ(load(aspect).at(1).fovY, 1.5707963f) << aspect;
    }
    EXPECT_FLOAT_EQ(load(1.5f).at(0).orthoHeight, 4) << "6 wide, as the camera's frame";
    EXPECT_FLOAT_EQ(load(1).at(1).fovY, 2 * std::atan(2.0f)) << "as far aside as twice the height of 45 degrees";
    EXPECT_EQ(load(0.5f).at(2).fovY, 1) << "it names no aspect ratio";
}

TEST(Gltf, ProgressIsToldInOrder) {
    Document document;
    document.nodes = R"({"mesh": 0})";
    document.primitive = R"(, "indices": 1, "material": 0)";
    document.rest = R"(, "materials": [{"emissiveTexture": {"index": 0}}], "textures": [{"source": 0}],
        "images": [{"uri": "data:image/png;base64,)" +
                    std::string(kPng) + R"("}])";
    const TempFolder folder;
    std::vector<std::string> told;
    std::vector<float> shares;
    Listener listener;
    loadGltf(folder.write("t.gltf", document.json()), {.log = listener.log, .progress = [&](auto what, float share) {
                                                           if (told.empty() || told.back() != what) {
                                                               told.emplace_back(what);
                                                               shares.push_back(0);
                                                           }
                                                           EXPECT_GE(share, shares.back());
                                                           EXPECT_LE(share, 1);
                                                           shares.back() = share;
                                                       }});
    EXPECT_EQ(told, (std::vector<std::string>{"reading", "checking", "converting geometry", "decoding pictures"}));
    EXPECT_EQ(shares.front(), 1) << "the only buffer";
    EXPECT_EQ(shares.back(), 1) << "the only picture";
    EXPECT_FALSE(contains(listener.text, "converting")) << "a log is no place for it";
}

}  // namespace
}  // namespace crevice
