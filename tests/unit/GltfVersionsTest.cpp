// Files of later versions and with things nobody knows: read as far as glTF 2.0 goes, or refused when they ask for
// more.
#include "GltfTestTools.h"

namespace crevice {
namespace {

using test::contains;
using Document = test::GltfText;

// The models of the family "Compatibility" of Khronos' glTF-Asset-Generator, in our own words.
TEST(GltfVersions, LaterMinorVersionsLoadAndUnknownThingsAreIgnored) {
    Document document;
    document.version = "2.1";
    document.rest = R"(, "light": {"color": "blue"}, "materials": [{"alphaMode": "BLEND", "alphaMode2": "QUANTUM",
        "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}}])";
    document.nodes = R"({"mesh": 0, "light": 3})";
    document.primitive = R"(, "indices": 1, "material": 0)";
    const Scene scene = document.load();
    EXPECT_EQ(scene.instances.size(), 1u);
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_EQ(scene.materials.at(0).alphaMode, AlphaMode::Blend);
}

TEST(GltfVersions, AHigherLeastVersionIsRefused) {
    Document document;
    document.version = R"(2.1", "minVersion": "2.1)";
    EXPECT_TRUE(contains(document.error(), "'asset.minVersion' asks for more than glTF 2.0")) << document.error();
    document.version = R"(2.1", "minVersion": "2.0)";
    EXPECT_EQ(document.load().instances.size(), 1u);
}

// The schema allows any string here, for versions to come: a warning, and what every reader can show.
TEST(GltfVersions, AnUnknownAlphaModeIsOpaque) {
    Document document;
    document.rest =
        R"(, "materials": [{"alphaMode": "QUANTUM", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0]}}])";
    document.primitive = R"(, "indices": 1, "material": 0)";
    test::Listener listener;
    EXPECT_EQ(document.load(&listener).materials.at(0).alphaMode, AlphaMode::Opaque);
    EXPECT_TRUE(contains(listener.text, "'alphaMode' is 'QUANTUM'")) << listener.text;
}

// Metallic-roughness beside the specular-glossiness extension: its own numbers, as long as they are no makeshift.
TEST(GltfVersions, GlossinessGoesBeforeAMakeshift) {
    const auto metallicOf = [](const std::string& members, const std::string& more = {}) {
        Document document;
        // A black diffuse and a white specular colour: converted, a metal.
        document.rest = R"(, "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0.25)" + members +
                        R"(}, "extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0, 0, 0, 1])" +
                        more;
        document.primitive = R"(, "indices": 1, "material": 0)";
        return document.load().materials.at(0).metallic;
    };
    const std::string image = R"(, "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,)" +
                              std::string(test::kPng) + R"("}])";
    EXPECT_EQ(metallicOf("", "}}}]"), 0.25f);
    EXPECT_NEAR(metallicOf("", R"(}}}], "extensionsRequired": ["KHR_materials_pbrSpecularGlossiness"])"), 1, 1e-3f);
    EXPECT_NEAR(metallicOf("", R"(, "diffuseTexture": {"index": 0}}}}])" + image), 1, 1e-3f);
    EXPECT_EQ(metallicOf(R"(, "baseColorTexture": {"index": 0})", R"(, "diffuseTexture": {"index": 0}}}}])" + image),
              0.25f);
}

// Four sets of texture coordinates reach the shaders; a fifth is told.
TEST(GltfVersions, AFifthSetOfCoordinatesIsAWarning) {
    Document document;
    const auto info = [](int set) { return R"({"index": 0, "texCoord": )" + std::to_string(set) + "}"; };
    document.rest = R"(, "materials": [{"pbrMetallicRoughness": {"baseColorTexture": )" + info(0) +
                    R"(, "metallicRoughnessTexture": )" + info(1) + R"(}, "normalTexture": )" + info(2) +
                    R"(, "occlusionTexture": )" + info(3) + R"(, "emissiveTexture": )" + info(4) +
                    R"(}], "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,)" +
                    std::string(test::kPng) + R"("}])";
    document.primitive = R"(, "indices": 1, "material": 0)";
    test::Listener listener;
    const SceneMaterial material = document.load(&listener).materials.at(0);
    EXPECT_EQ(material.occlusionMap.texcoord, 3);
    EXPECT_EQ(material.emissiveMap.texcoord, 0);
    EXPECT_TRUE(contains(listener.text, "it reads 5 sets of texture coordinates")) << listener.text;
}

}  // namespace
}  // namespace crevice
