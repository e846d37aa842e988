// Cocos' block CCShadow: rows of the projection that a shader can undo, and a block with which everything is lit.
#include "flow/CocosShadow.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>

#include "flow/CocosFrame.h"
#include "flow/CocosMacros.h"

namespace crevice {
namespace {

template <class Block>
Block blockOf(Profile profile, const ShadowView* view, const Light* light) {
    const std::vector<std::byte> bytes =
        shadowBlock(profile, view, light, {.bias = 0.01f, .pcf = 2, .size = {512, 256}});
    EXPECT_EQ(bytes.size(), sizeof(Block));
    Block block;
    std::memcpy(&block, bytes.data(), sizeof block);
    return block;
}

Scene litScene(LightType type) {
    Scene scene;
    Light light;
    light.type = type;
    light.position = {0, 10, 0};
    light.direction = {0, -1, 0};
    light.outerAngle = 0.5f;
    scene.lights.push_back(light);
    return scene;
}

Aabb unitBox() {
    Aabb box;
    box.add(glm::vec3(-1));
    box.add(glm::vec3(1));
    return box;
}

TEST(CocosShadow, MembersStandWhereTheVersionsHaveThem) {
    EXPECT_EQ(offsetof(ShadowBlock, invProjDepthInfo), 192u);
    EXPECT_EQ(offsetof(ShadowBlock, nearFar), 240u);
    EXPECT_EQ(offsetof(ShadowBlock, color), 288u);
    EXPECT_EQ(offsetof(ShadowBlock36, lightViewProj), 64u);
    EXPECT_EQ(offsetof(ShadowBlock36, projInfo), 160u);
    EXPECT_EQ(offsetof(ShadowBlock36, typeNormal), 208u);
    EXPECT_EQ(offsetof(ShadowBlock36, planar), 240u);
}

TEST(CocosShadow, ADirectionalMapsDepthCanBeUndone) {
    const Scene scene = litScene(LightType::Directional);
    const auto view = directionalShadowView(scene, unitBox());
    ASSERT_TRUE(view);
    const auto block = blockOf<ShadowBlock>(Profile::Cocos33, &*view, &scene.lights[0]);
    // View depth from clip depth as the engine's shaders find it: (z - y) / x.
    const glm::vec4 seen = block.lightView * glm::vec4(0.25f, 0.5f, -0.5f, 1);
    const glm::vec4 clip = block.lightViewProj * glm::vec4(0.25f, 0.5f, -0.5f, 1);
    EXPECT_NEAR((clip.z - block.projDepthInfo.y) / block.projDepthInfo.x, seen.z, 1e-4);
    EXPECT_NEAR(seen.x * block.projInfo.x + view->projection[3][0], clip.x, 1e-5);
    EXPECT_NEAR(block.projInfo.x * block.projInfo.z, 1, 1e-6);
    EXPECT_LT(block.projInfo.y, 0);  // clip space points down
    EXPECT_EQ(glm::vec3(block.sizeBias), glm::vec3(512, 256, 2));
    EXPECT_NEAR(block.sizeBias.w, 0.01f * (view->far - view->near), 1e-6);
    EXPECT_EQ(block.typeNormal, glm::vec4(0));
    EXPECT_EQ(block.nearFar, glm::vec4(view->near, view->far, 0, 0));
}

TEST(CocosShadow, ASpotsMapsDepthCanBeUndone) {
    Scene scene = litScene(LightType::Spot);
    scene.lights[0].shadow = LightShadow{.bias = 0.125f, .normalBias = 0.5f, .pcf = 1, .saturation = 0.25f};
    const auto view = spotShadowView(scene, unitBox());
    ASSERT_TRUE(view);
    const auto block = blockOf<ShadowBlock36>(Profile::Cocos36, &*view, &scene.lights[0]);
    const glm::vec4 seen = block.lightView * glm::vec4(0.25f, 0.5f, -0.5f, 1);
    const glm::vec4 clip = block.lightViewProj * glm::vec4(0.25f, 0.5f, -0.5f, 1);
    EXPECT_NEAR(clip.z * block.invProjDepthInfo.x + clip.w * block.invProjDepthInfo.y, seen.z, 1e-4);
    EXPECT_NEAR(clip.x * block.projInfo.z, seen.x, 1e-5);
    EXPECT_NEAR(clip.y * block.projInfo.w, seen.y, 1e-5);
    EXPECT_NEAR(seen.z * block.projDepthInfo.x + block.projDepthInfo.y, clip.z, 1e-4);
    EXPECT_NEAR(seen.z * block.projDepthInfo.z, clip.w, 1e-5);
    EXPECT_EQ(glm::vec2(block.sizeBias.z, block.sizeBias.w), glm::vec2(1, 0.125f));  // the light's own
    EXPECT_EQ(block.typeNormal, glm::vec4(1, 0, 0.5f, 0));
    EXPECT_EQ(block.nearFar.w, 0.75f);
}

TEST(CocosShadow, WithoutAMapEveryPointIsOutsideOfIt) {
    for (const glm::vec3 point : {glm::vec3(0), glm::vec3(1e4f, -3, 7)}) {
        const auto block = blockOf<ShadowBlock36>(Profile::Cocos36, nullptr, nullptr);
        const glm::vec4 clip = block.lightViewProj * glm::vec4(point, 1);
        EXPECT_EQ(glm::vec3(clip) / clip.w * 0.5f + 0.5f, glm::vec3(1.5f));
        // And after the way over view space: (x, y) there and back, z by its row.
        const float z = clip.z * block.invProjDepthInfo.x + clip.w * block.invProjDepthInfo.y;
        EXPECT_EQ(clip.x * block.projInfo.z * block.projInfo.x, 2);
        EXPECT_EQ(z * block.projDepthInfo.x + block.projDepthInfo.y, 2);
        EXPECT_EQ(z * block.projDepthInfo.z, 1);
    }
}

TEST(CocosShadow, AMapIsAsLargeAsItsTarget) {
    PipelineDesc desc;
    desc.profile = Profile::Cocos36;
    TargetDesc& main = desc.targets.emplace_back();
    main.name = "cc_shadowMap";
    main.size = glm::uvec2(512, 256);
    desc.targets.emplace_back().name = "cc_spotShadowMap";
    EXPECT_EQ(shadowSettings(desc, false, {640, 361}).size, glm::vec2(512, 256));
    EXPECT_EQ(shadowSettings(desc, true, {640, 361}).size, glm::vec2(640, 361));
    desc.targets[1].scale = 0.5f;
    EXPECT_EQ(shadowSettings(desc, true, {640, 361}).size, glm::vec2(320, 181));  // rounded up
    EXPECT_EQ(shadowSettings(desc, true, {1, 1}).size, glm::vec2(1));
}

TEST(CocosMacros, FollowWhatTheFrameFills) {
    PipelineDesc desc;
    desc.profile = Profile::Cocos36;
    Scene scene = litScene(LightType::Directional);
    EXPECT_EQ(pipelineMacros(desc, &scene).at("CC_RECEIVE_SHADOW"), "0");
    FlowDesc flow;
    flow.stages.emplace_back().stageClass = "ShadowStage";
    desc.flows.push_back(flow);
    EXPECT_EQ(pipelineMacros(desc, &scene).at("CC_SHADOW_TYPE"), "0");  // there is no map to draw into
    desc.targets.emplace_back().name = "cc_shadowMap";
    Defines macros = pipelineMacros(desc, &scene);
    EXPECT_EQ(macros.at("CC_RECEIVE_SHADOW"), "1");
    EXPECT_EQ(macros.at("CC_SHADOW_TYPE"), "2");
    EXPECT_EQ(macros.at("CC_DIR_LIGHT_SHADOW_TYPE"), "1");
    EXPECT_EQ(macros.at("CC_DIR_SHADOW_PCF_TYPE"), "2");  // 3x3
    desc.flows[0].stages[0].params = parseJson(R"({"pcf": "1x1"})", "p");
    EXPECT_EQ(pipelineMacros(desc, &scene).at("CC_DIR_SHADOW_PCF_TYPE"), "0");
    scene.lights[0].shadow = LightShadow{.pcf = 3};
    EXPECT_EQ(pipelineMacros(desc, &scene).at("CC_DIR_SHADOW_PCF_TYPE"), "3");
    desc.flows[0].stages[0].enabled = false;
    EXPECT_EQ(pipelineMacros(desc, &scene).at("CC_RECEIVE_SHADOW"), "0");

    EXPECT_EQ(pipelineMacros(desc, &scene).at("CC_USE_IBL"), "0");
    scene.environment = defaultEnvironment();
    EXPECT_EQ(pipelineMacros(desc, &scene).at("CC_USE_IBL"), "1");
    EXPECT_EQ(pipelineMacros(desc, &scene).at("CC_USE_DIFFUSEMAP"), "1");
    desc.profile = Profile::Cocos33;
    EXPECT_EQ(pipelineMacros(desc, &scene).count("CC_USE_DIFFUSEMAP"), 0u);
    const FogType types[] = {FogType::Linear, FogType::Exp, FogType::Exp2, FogType::Layered, FogType::None};
    for (std::size_t i = 0; i < std::size(types); ++i) {
        scene.fog.type = types[i];
        EXPECT_EQ(pipelineMacros(desc, &scene).at("CC_USE_FOG"), std::to_string(i));
    }
}

TEST(CocosFrame, ASingleLightIsOneOfTheBlock) {
    Scene scene = litScene(LightType::Spot);
    scene.lights[0].intensity = 8;
    scene.lights[0].size = 2;
    scene.lights[0].range = 30;
    FrameView view;
    view.exposure = 0.5f;
    const SingleLightBlock block = singleLight(cocosLights(view, scene, {0}, {.spotShadows = true}), 0);
    EXPECT_EQ(block.position, glm::vec4(0, 10, 0, 1));
    EXPECT_EQ(block.color.w, 8 * 0.5f / 4);
    EXPECT_EQ(block.sizeRangeAngle, glm::vec4(2, 30, std::cos(0.5f), 1));
    EXPECT_EQ(block.direction, glm::vec4(0, -1, 0, 1));
    scene.lights[0].castsShadow = false;
    EXPECT_EQ(singleLight(cocosLights(view, scene, {0}, {.spotShadows = true}), 0).sizeRangeAngle.w, 0);
}

}  // namespace
}  // namespace crevice
