// A scene's material as macros, values and textures of an effect.
#include "flow/Surface.h"

#include <gtest/gtest.h>

namespace crevice {
namespace {

TEST(Surface, APlainMaterialTurnsEverythingOff) {
    const SurfaceInputs inputs = surfaceInputs(SceneMaterial{}, false);
    for (const auto& [name, value] : inputs.defines) EXPECT_EQ(value, "0") << name;
    EXPECT_TRUE(inputs.textures.empty());
    for (const char* name :
         {"USE_BASE_COLOR_MAP", "USE_METALLIC_ROUGHNESS_MAP", "USE_NORMAL_MAP", "USE_OCCLUSION_MAP", "USE_EMISSIVE_MAP",
          "USE_ALPHA_TEST", "USE_ALPHA_BLEND", "USE_DOUBLE_SIDED", "HAS_TANGENTS"})
        EXPECT_TRUE(inputs.defines.contains(name)) << name;
    EXPECT_FALSE(inputs.defines.contains("BASE_COLOR_UV"));
}

TEST(Surface, ModesAndMeshesAreMacros) {
    SceneMaterial material;
    material.alphaMode = AlphaMode::Mask;
    material.doubleSided = true;
    SurfaceInputs inputs = surfaceInputs(material, true);
    EXPECT_EQ(inputs.defines.at("USE_ALPHA_TEST"), "1");
    EXPECT_EQ(inputs.defines.at("USE_ALPHA_BLEND"), "0");
    EXPECT_EQ(inputs.defines.at("USE_DOUBLE_SIDED"), "1");
    EXPECT_EQ(inputs.defines.at("HAS_TANGENTS"), "1");
    material.alphaMode = AlphaMode::Blend;
    inputs = surfaceInputs(material, true);
    EXPECT_EQ(inputs.defines.at("USE_ALPHA_TEST"), "0");
    EXPECT_EQ(inputs.defines.at("USE_ALPHA_BLEND"), "1");
}

TEST(Surface, EachMapHasItsSamplerAndTextureCoordinates) {
    struct Row {
        TextureRef SceneMaterial::*map;
        const char *sampler, *use, *uv;
    };
    const Row rows[] = {
        {&SceneMaterial::baseColorMap, "baseColorMap", "USE_BASE_COLOR_MAP", "BASE_COLOR_UV"},
        {&SceneMaterial::metallicRoughnessMap, "metallicRoughnessMap", "USE_METALLIC_ROUGHNESS_MAP",
         "METALLIC_ROUGHNESS_UV"},
        {&SceneMaterial::normalMap, "normalMap", "USE_NORMAL_MAP", "NORMAL_UV"},
        {&SceneMaterial::occlusionMap, "occlusionMap", "USE_OCCLUSION_MAP", "OCCLUSION_UV"},
        {&SceneMaterial::emissiveMap, "emissiveMap", "USE_EMISSIVE_MAP", "EMISSIVE_UV"},
    };
    for (const Row& row : rows) {
        for (const int set : {0, 1}) {
            SceneMaterial material;
            material.*row.map = {.texture = 3, .texcoord = set};
            const SurfaceInputs inputs = surfaceInputs(material, false);
            EXPECT_EQ(inputs.defines.at(row.use), "1");
            EXPECT_EQ(inputs.defines.at(row.uv), std::to_string(set));
            ASSERT_EQ(inputs.textures.size(), 1u);
            EXPECT_EQ(inputs.textures[0].first, row.sampler);
            EXPECT_EQ(inputs.textures[0].second.texture, 3);
        }
    }
}

TEST(Surface, ValuesAreTheMaterials) {
    SceneMaterial material;
    material.baseColor = {0.25f, 0.5f, 0.75f, 0.125f};
    material.metallic = 0.5f;
    material.roughness = 0.25f;
    material.emissive = {4, 8, 16};
    material.alphaCutoff = 0.625f;
    const Value values = surfaceInputs(material, false).properties;
    EXPECT_EQ(values.find("baseColor")->items()[3].number(), 0.125);
    EXPECT_EQ(values.find("metallic")->number(), 0.5);
    EXPECT_EQ(values.find("roughness")->number(), 0.25);
    EXPECT_EQ(values.find("emissive")->items().size(), 3u);
    EXPECT_EQ(values.find("emissive")->items()[2].number(), 16);
    EXPECT_EQ(values.find("alphaCutoff")->number(), 0.625);
}

}  // namespace
}  // namespace crevice
