// One test for each extension that is read, with values worked out by hand.
#include <cmath>
#include <cstring>

#include <meshoptimizer.h>
#include <webp/encode.h>

#include "GltfTestTools.h"

namespace crevice {
namespace {

using test::append;
using test::contains;
using Document = test::GltfText;
using test::kPng;
using test::Listener;

Document withMaterial(const std::string& material, const std::string& more = {}) {
    Document document;
    document.primitive = R"(, "indices": 1, "material": 0)";
    document.attributes = R"("POSITION": 0, "TEXCOORD_0": 2, "TEXCOORD_1": 3)";
    document.views += R"(, {"buffer": 0, "byteOffset": 0, "byteLength": 48, "byteStride": 12})";
    document.accessors += R"(, {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
        {"bufferView": 2, "byteOffset": 4, "componentType": 5126, "count": 4, "type": "VEC2"})";
    document.rest = R"(, "materials": [)" + material + R"(], "textures": [{"source": 0}],
        "images": [{"uri": "data:image/png;base64,)" +
                    std::string(kPng) + R"("}])" + more;
    return document;
}

TEST(GltfExtensions, UnlitMaterialsKeepOnlyTheirBaseColour) {
    const Scene scene =
        withMaterial(R"({"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.25, 1], "metallicFactor": 0.5},
        "emissiveFactor": [1, 1, 1], "normalTexture": {"index": 0}, "extensions": {"KHR_materials_unlit": {}}})")
            .load();
    const SceneMaterial& material = scene.materials.at(0);
    EXPECT_TRUE(material.unlit);
    EXPECT_EQ(material.baseColor, glm::vec4(1, 0.5f, 0.25f, 1));
    EXPECT_EQ(material.emissive, glm::vec3(0));
    EXPECT_FALSE(material.normalMap);
}

TEST(GltfExtensions, EmissiveStrengthMultipliesTheFactor) {
    const Scene scene = withMaterial(R"({"emissiveFactor": [1, 0.5, 0],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}})")
                            .load();
    EXPECT_EQ(scene.materials.at(0).emissive, glm::vec3(8, 4, 0));
}

TEST(GltfExtensions, TextureTransformsScaleTurnAndShift) {
    const Scene scene =
        withMaterial(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 0, "extensions":
        {"KHR_texture_transform": {"offset": [0.5, 0.25], "scale": [2, 4], "rotation": 1.5707963, "texCoord": 1}}}},
        "occlusionTexture": {"index": 0}})")
            .load();
    const TextureRef& map = scene.materials.at(0).baseColorMap;
    EXPECT_EQ(map.texcoord, 1);
    // (1, 0) is scaled to (2, 0), turned by a quarter (the picture counter-clockwise) to (0, -2), and shifted.
    EXPECT_LT(glm::distance(map.transform.apply({1, 0}), glm::vec2(0.5f, -1.75f)), 1e-5f);
    EXPECT_LT(glm::distance(map.transform.apply({0, 1}), glm::vec2(4.5f, 0.25f)), 1e-5f);
    EXPECT_TRUE(scene.materials[0].occlusionMap.transform.isIdentity());
}

TEST(GltfExtensions, QuantizedPositionsAreNumbers) {
    Document document;
    document.bytes.clear();
    append<std::int16_t>(document.bytes, {-100, 50, 0, 0, 200, -7, 3, 0, 1, 2, 300, 0});
    document.views = R"({"buffer": 0, "byteLength": 24, "byteStride": 8})";
    document.accessors = R"({"bufferView": 0, "componentType": 5122, "count": 3, "type": "VEC3"})";
    document.primitive = "";
    document.rest = R"(, "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"])";
    const Mesh mesh = document.load().meshes.at(0);
    EXPECT_EQ(mesh.vertices[0].position, glm::vec3(-100, 50, 0));
    EXPECT_EQ(mesh.vertices[2].position, glm::vec3(1, 2, 300));
}

TEST(GltfExtensions, InstancingCopiesTheMesh) {
    Document document;
    append<float>(document.bytes, {1, 2, 3, 4, 5, 6, 2, 2, 2, 1, 1, 1});
    document.views += R"(, {"buffer": 0, "byteOffset": 56, "byteLength": 48})";
    document.accessors += R"(, {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"},
        {"bufferView": 2, "byteOffset": 24, "componentType": 5126, "count": 2, "type": "VEC3"})";
    document.nodes = R"({"mesh": 0, "translation": [10, 0, 0],
        "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2, "SCALE": 3}}}})";
    const Scene scene = document.load();
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(glm::vec3(scene.instances[0].world * glm::vec4(1, 0, 0, 1)), glm::vec3(13, 2, 3));
    EXPECT_EQ(glm::vec3(scene.instances[1].world * glm::vec4(1, 0, 0, 1)), glm::vec3(15, 5, 6));
}

std::vector<unsigned char> compressedSquare(const Document& document) {
    std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(4, 12));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), document.bytes.data(), 4, 12));
    return packed;
}

Document compressed() {
    Document document;
    std::vector<unsigned char> packed = compressedSquare(document);
    const std::size_t length = packed.size();
    while (packed.size() % 4) packed.push_back(0);
    const std::size_t indices = packed.size();
    append<std::uint16_t>(packed, {0, 1, 2, 3});
    document.bytes = packed;
    document.views = R"({"buffer": 1, "byteLength": 48, "byteStride": 12, "extensions": {"EXT_meshopt_compression":
        {"buffer": 0, "byteOffset": 0, "byteLength": )" +
                     std::to_string(length) + R"(, "byteStride": 12, "count": 4, "mode": "ATTRIBUTES"}}},
        {"buffer": 0, "byteOffset": )" +
                     std::to_string(indices) + R"(, "byteLength": 8})";
    document.moreBuffers = R"(, {"byteLength": 48, "extensions": {"EXT_meshopt_compression": {"fallback": true}}})";
    return document;
}

TEST(GltfExtensions, CompressedViewsAreDecompressed) {
    const Scene scene = compressed().load();
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.vertices[1].position, glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.vertices[2].position, glm::vec3(1, 1, 0));
}

TEST(GltfExtensions, BrokenCompressionIsRefused) {
    Document document = compressed();
    document.bytes[0] ^= 0xff;
    EXPECT_TRUE(contains(document.error(), "bufferViews[0]: EXT_meshopt_compression: the compressed data is broken"))
        << document.error();
    document = compressed();
    document.views.replace(document.views.find("\"count\": 4"), 10, "\"count\": 9");
    EXPECT_TRUE(contains(document.error(), "9 elements of 12 bytes do not fit")) << document.error();
}

TEST(GltfExtensions, WebpPicturesAreDecoded) {
    const std::uint8_t pixels[] = {255, 0, 0, 255, 0, 255, 0, 128};
    std::uint8_t* encoded = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(pixels, 2, 1, 8, &encoded);
    const std::vector<unsigned char> bytes(encoded, encoded + size);
    WebPFree(encoded);
    Document document;
    document.primitive = R"(, "indices": 1, "material": 0)";
    document.rest = R"(, "extensionsUsed": ["EXT_texture_webp"], "materials": [{"emissiveTexture": {"index": 0}}],
        "textures": [{"extensions": {"EXT_texture_webp": {"source": 0}}}],
        "images": [{"uri": "data:image/webp;base64,)" +
                    test::encodeBase64(bytes) + R"("}])";
    const Scene scene = document.load();
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.textures[0].image.width, 2u);
    EXPECT_EQ(scene.textures[0].image.pixel(1, 0)[1], std::byte(255));
    EXPECT_EQ(scene.textures[0].image.pixel(1, 0)[3], std::byte(128));
}

// A specular colour of 0.04 is a dielectric: diffuse × (1 - 0.04) / (1 - 0.04) is the base colour. A black diffuse and
// a bright specular colour is a metal of that colour.
TEST(GltfExtensions, SpecularGlossinessIsConverted) {
    const auto convert = [](const std::string& numbers) {
        return withMaterial(R"({"extensions": {"KHR_materials_pbrSpecularGlossiness": {)" + numbers + "}}}").load();
    };
    const SceneMaterial plastic =
        convert(
            R"("diffuseFactor": [0.5, 0.25, 0.125, 0.75], "specularFactor": [0.04, 0.04, 0.04], "glossinessFactor": 0.25)")
            .materials.at(0);
    EXPECT_NEAR(plastic.metallic, 0, 1e-3f);
    EXPECT_NEAR(plastic.roughness, 0.75f, 1e-6f);
    EXPECT_LT(glm::distance(plastic.baseColor, glm::vec4(0.5f, 0.25f, 0.125f, 0.75f)), 2e-3f);
    const SceneMaterial gold =
        convert(R"("diffuseFactor": [0, 0, 0, 1], "specularFactor": [1, 0.75, 0.25])").materials.at(0);
    EXPECT_NEAR(gold.metallic, 1, 1e-3f);
    EXPECT_NEAR(gold.roughness, 0, 1e-6f);
    EXPECT_LT(glm::distance(gold.baseColor, glm::vec4(1, 0.75f, 0.25f, 1)), 2e-3f);
    // With a texture each texel is converted: kPng is white and red.
    const Scene textured = convert(
        R"("specularFactor": [0, 0, 0], "specularGlossinessTexture": {"index": 0}, "diffuseTexture": {"index": 0})");
    const SceneMaterial& material = textured.materials.at(0);
    const SceneTexture& colour = textured.textures.at(std::size_t(material.baseColorMap.texture));
    EXPECT_TRUE(colour.srgb);
    EXPECT_FALSE(textured.textures.at(std::size_t(material.metallicRoughnessMap.texture)).srgb);
    EXPECT_NEAR(int(colour.image.pixel(0, 0)[1]), 255, 1);
    EXPECT_NEAR(int(colour.image.pixel(1, 0)[1]), 0, 1);
}

// The hidden node's own mesh and light, and those below it; cameras stay.
TEST(GltfExtensions, HiddenNodesAndTheirChildrenAreNotShown) {
    Document document;
    document.nodes = R"({"mesh": 0, "name": "shown", "extensions": {"KHR_node_visibility": {"visible": true}}},
        {"mesh": 0, "name": "hidden", "children": [2], "translation": [1, 0, 0],
         "extensions": {"KHR_node_visibility": {"visible": false}, "KHR_lights_punctual": {"light": 0}}},
        {"mesh": 0, "name": "child", "camera": 0, "extensions": {"KHR_node_visibility": {}}},
        {"extensions": {"KHR_lights_punctual": {"light": 0}}})";
    document.roots = "0, 1, 3";
    document.rest = R"(, "extensionsUsed": ["KHR_node_visibility", "KHR_lights_punctual"],
        "extensionsRequired": ["KHR_node_visibility"],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}})";
    Listener listener;
    const Scene scene = document.load(&listener);
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.instances[0].name, "shown");
    EXPECT_EQ(scene.lights.size(), 1u);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].position(), glm::vec3(1, 0, 0)) << "places count, hidden or not";
    EXPECT_FALSE(contains(listener.text, "not read")) << listener.text;
    document.nodes = R"({"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": 1}}})";
    document.roots = "0";
    document.rest = R"(, "extensionsUsed": ["KHR_node_visibility"])";
    EXPECT_TRUE(contains(document.error(), "'visible' must be true or false, found a number")) << document.error();
}

}  // namespace
}  // namespace crevice
