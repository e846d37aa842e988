// Macros from what a scene has: nothing is left out that some light, shadow, fog or environment needs.
#include <gtest/gtest.h>

#include "flow/SceneDefines.h"

namespace crevice {
namespace {

constexpr ShadowMaps kBoth{true, true};

Scene sceneWith(std::vector<Light> lights) {
    Scene scene;
    scene.lights = std::move(lights);
    return scene;
}

Light light(LightType type, bool castsShadow) {
    Light made;
    made.type = type;
    made.castsShadow = castsShadow;
    return made;
}

std::string macro(const Scene& scene, const std::string& name, ShadowMaps maps = kBoth) {
    return sceneDefines(&scene, maps).at(name);
}

TEST(SceneDefines, WithoutASceneNothingIsLeftOutButEnvironments) {
    const Defines expected = {
        {"CC_USE_IBL", "0"}, {"SKY_ENVIRONMENT", "0"}, {"CC_MAIN_SHADOW", "1"}, {"CC_LIGHTS", "2"}, {"CC_FOG", "1"}};
    EXPECT_EQ(sceneDefines(nullptr, {}), expected);
}

TEST(SceneDefines, AnEmptySceneNeedsNothing) {
    for (const auto& [name, value] : sceneDefines(&static_cast<const Scene&>(Scene{}), kBoth))
        EXPECT_EQ(value, "0") << name;
}

TEST(SceneDefines, TheMainLightIsNoOther) {
    EXPECT_EQ(macro(sceneWith({light(LightType::Directional, true)}), "CC_LIGHTS"), "0");
    EXPECT_EQ(macro(sceneWith({light(LightType::Directional, true), light(LightType::Directional, true)}), "CC_LIGHTS"),
              "1");
    EXPECT_EQ(macro(sceneWith({light(LightType::Point, true)}), "CC_LIGHTS"), "1");
}

TEST(SceneDefines, OnlyASpotLightThatCastsWithAStageForItHasAMap) {
    const Scene casts = sceneWith({light(LightType::Point, true), light(LightType::Spot, true)});
    EXPECT_EQ(macro(casts, "CC_LIGHTS"), "2");
    EXPECT_EQ(macro(casts, "CC_LIGHTS", {.main = true, .spot = false}), "1");
    EXPECT_EQ(macro(sceneWith({light(LightType::Spot, false)}), "CC_LIGHTS"), "1");
}

TEST(SceneDefines, TheMainShadowNeedsLightAndStage) {
    const Scene casts = sceneWith({light(LightType::Directional, true)});
    EXPECT_EQ(macro(casts, "CC_MAIN_SHADOW"), "1");
    EXPECT_EQ(macro(casts, "CC_MAIN_SHADOW", {.main = false, .spot = true}), "0");
    EXPECT_EQ(macro(sceneWith({light(LightType::Directional, false)}), "CC_MAIN_SHADOW"), "0");
    EXPECT_EQ(macro(sceneWith({light(LightType::Spot, true)}), "CC_MAIN_SHADOW"), "0");
}

TEST(SceneDefines, EveryKindOfFogCounts) {
    for (const FogType type : {FogType::Linear, FogType::Exp, FogType::Exp2}) {
        Scene scene;
        scene.fog.type = type;
        EXPECT_EQ(macro(scene, "CC_FOG"), "1");
    }
}

}  // namespace
}  // namespace crevice
