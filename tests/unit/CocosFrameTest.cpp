// Cocos' blocks, lights and units against the layouts and rules of its engine, written out by hand.
#include "flow/CocosFrame.h"

#include "flow/CocosMacros.h"

#include <cstddef>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "plan/GlobalNames.h"

namespace crevice {
namespace {

FrameView viewFrom(const glm::vec3& eye, float exposure) {
    FrameView view;
    view.camera.view = glm::lookAt(eye, eye + glm::vec3(0, 0, -1), glm::vec3(0, 1, 0));
    view.camera.near = 0.5f;
    view.camera.far = 200;
    view.extent = {320, 180};
    view.projection = glm::perspective(1.0f, 16.0f / 9.0f, 0.5f, 200.0f);
    view.projection[1][1] *= -1;
    view.exposure = exposure;
    return view;
}

Light pointAt(const glm::vec3& position, float candela, float range = 0) {
    Light light;
    light.type = LightType::Point;
    light.position = position;
    light.intensity = candela;
    light.range = range;
    return light;
}

TEST(CocosBlocks, Of331HaveItsOffsets) {
    EXPECT_EQ(sizeof(GlobalBlock), 48u);
    EXPECT_EQ(offsetof(GlobalBlock, screenSize), 16u);
    EXPECT_EQ(offsetof(GlobalBlock, nativeSize), 32u);
    EXPECT_EQ(offsetof(CameraBlock, viewProjInv), 320u);
    EXPECT_EQ(offsetof(CameraBlock, position), 384u);
    EXPECT_EQ(offsetof(CameraBlock, screenScale), 400u);
    EXPECT_EQ(offsetof(CameraBlock, exposure), 416u);
    EXPECT_EQ(offsetof(CameraBlock, mainLitDir), 432u);
    EXPECT_EQ(offsetof(CameraBlock, mainLitColor), 448u);
    EXPECT_EQ(offsetof(CameraBlock, ambientSky), 464u);
    EXPECT_EQ(offsetof(CameraBlock, ambientGround), 480u);
    EXPECT_EQ(offsetof(CameraBlock, fogColor), 496u);
    EXPECT_EQ(offsetof(CameraBlock, fogAdd), 528u);
    EXPECT_EQ(sizeof(CameraBlock), 544u);
    EXPECT_EQ(offsetof(ShadowBlock, nearFar), 240u);
    EXPECT_EQ(offsetof(ShadowBlock, color), 288u);
    EXPECT_EQ(sizeof(ShadowBlock), 304u);
    EXPECT_EQ(offsetof(ForwardLightBlock, color), 160u);
    EXPECT_EQ(offsetof(ForwardLightBlock, sizeRangeAngle), 320u);
    EXPECT_EQ(offsetof(ForwardLightBlock, direction), 480u);
    EXPECT_EQ(sizeof(ForwardLightBlock), 640u);
}

TEST(CocosBlocks, Of361HaveItsOffsets) {
    EXPECT_EQ(offsetof(GlobalBlock36, debugViewMode), 48u);
    EXPECT_EQ(offsetof(GlobalBlock36, debugViewPacks), 64u);
    EXPECT_EQ(sizeof(GlobalBlock36), 112u);
    EXPECT_EQ(offsetof(CameraBlock36, position), 384u);
    EXPECT_EQ(offsetof(CameraBlock36, surfaceTransform), 400u);
    EXPECT_EQ(offsetof(CameraBlock36, screenScale), 416u);
    EXPECT_EQ(offsetof(CameraBlock36, exposure), 432u);
    EXPECT_EQ(offsetof(CameraBlock36, mainLitDir), 448u);
    EXPECT_EQ(offsetof(CameraBlock36, mainLitColor), 464u);
    EXPECT_EQ(offsetof(CameraBlock36, ambientSky), 480u);
    EXPECT_EQ(offsetof(CameraBlock36, ambientGround), 496u);
    EXPECT_EQ(offsetof(CameraBlock36, fogColor), 512u);
    EXPECT_EQ(offsetof(CameraBlock36, fogBase), 528u);
    EXPECT_EQ(offsetof(CameraBlock36, fogAdd), 544u);
    EXPECT_EQ(offsetof(CameraBlock36, nearFar), 560u);
    EXPECT_EQ(offsetof(CameraBlock36, viewPort), 576u);
    EXPECT_EQ(sizeof(CameraBlock36), 592u);
    EXPECT_EQ(offsetof(ShadowBlock36, invProjDepthInfo), 128u);
    EXPECT_EQ(offsetof(ShadowBlock36, nearFar), 176u);
    EXPECT_EQ(offsetof(ShadowBlock36, sizeBias), 192u);
    EXPECT_EQ(offsetof(ShadowBlock36, typeNormal), 208u);
    EXPECT_EQ(offsetof(ShadowBlock36, color), 224u);
    EXPECT_EQ(offsetof(ShadowBlock36, planar), 240u);
    EXPECT_EQ(sizeof(ShadowBlock36), 256u);
    EXPECT_EQ(offsetof(CsmBlock36, atlas), 192u);
    EXPECT_EQ(offsetof(CsmBlock36, viewProj), 256u);
    EXPECT_EQ(offsetof(CsmBlock36, projDepthInfo), 512u);
    EXPECT_EQ(offsetof(CsmBlock36, splits), 640u);
    EXPECT_EQ(sizeof(CsmBlock36), 656u);
    EXPECT_EQ(offsetof(LocalBlock36, localShadowBias), 144u);
    EXPECT_EQ(sizeof(LocalBlock36), 160u);
}

TEST(CocosFrame, ConventionsAreThoseOfItsVulkanBackEnd) {
    const FrameView view = viewFrom({1, 2, 3}, 0.25f);
    const CameraBlock36 block = cocosCamera36(view, {}, {.hdr = true});
    EXPECT_EQ(block.position, glm::vec4(1, 2, 3, 0));  // w: both signs of y point down
    EXPECT_LT(block.proj[1][1], 0);
    EXPECT_EQ(block.nearFar, glm::vec4(0.5f, 200, 0, 0));
    EXPECT_EQ(block.viewPort, glm::vec4(0, 0, 320, 180));  // pixels
    EXPECT_EQ(block.screenScale, glm::vec4(1));
    EXPECT_EQ(block.surfaceTransform.x, 0);  // not rotated
    const GlobalBlock36 global = cocosGlobal36(view);
    EXPECT_EQ(global.screenSize, glm::vec4(320, 180, 1 / 320.0f, 1 / 180.0f));
    EXPECT_EQ(global.debugViewMode.x, 0);
}

TEST(CocosFrame, LightArrivesExposed) {
    Scene scene;
    Light sun;
    sun.intensity = 65000;
    sun.color = {1, 0.5f, 0.25f};
    scene.lights.push_back(sun);
    scene.ambient = Ambient{.sky = glm::vec3(20000, 10000, 20000), .ground = glm::vec3(4000)};
    const float exposure = 1 / 38400.0f;  // f/16, 1/125 s, ISO 100: the demo scene's
    for (const bool hdr : {false, true}) {
        const CameraBlock block = cocosCamera33(viewFrom({}, exposure), scene, {.hdr = hdr});
        EXPECT_EQ(glm::vec3(block.mainLitColor), glm::vec3(1, 0.5f, 0.25f));
        EXPECT_NEAR(block.mainLitColor.w, 1.6927, 1e-4);
        EXPECT_EQ(block.mainLitDir, glm::vec4(0, 0, -1, 0));  // w = 0: its shadow map is not drawn
        EXPECT_NEAR(block.ambientSky.w, 0.5208, 1e-4);
        EXPECT_EQ(glm::vec3(block.ambientSky), glm::vec3(1, 0.5f, 1));
        EXPECT_NEAR(block.ambientGround.x, 0.2, 1e-6);
        EXPECT_NEAR(block.exposure.x, 2.604e-5, 1e-8);
        EXPECT_NEAR(block.exposure.y, 38400, 1e-1);
        EXPECT_EQ(block.exposure.z, hdr ? 1 : 0);
        EXPECT_NEAR(block.exposure.w, 38400, 1e-1);
    }
    EXPECT_EQ(cocosCamera33(viewFrom({}, 1), {}, {.hdr = true}).ambientSky, glm::vec4(0));
}

TEST(CocosFrame, HdrIsOffFor33AndOnFor36UnlessTheDocumentSaysOtherwise) {
    PipelineDesc desc;
    desc.profile = Profile::Cocos33;
    EXPECT_FALSE(cocosHdr(desc));
    desc.profile = Profile::Cocos36;
    EXPECT_TRUE(cocosHdr(desc));
    desc.macros = Value::makeObject();
    desc.macros.set("CC_USE_HDR", Value::makeInteger(0));
    EXPECT_FALSE(cocosHdr(desc));
    desc.macros.set("CC_USE_HDR", Value::makeBool(true));
    EXPECT_TRUE(cocosHdr(desc));
}

TEST(CocosLights, AreSpheresWhoseLuminanceGivesTheirCandela) {
    Scene scene;
    scene.lights.push_back(Light{});  // directional: not among them
    scene.lights.push_back(pointAt({0, 0, -5}, 80, 14));
    Light spot = pointAt({1, 0, -5}, 20, 9);
    spot.type = LightType::Spot;
    spot.size = 0.5f;
    spot.direction = {0, -1, 0};
    spot.outerAngle = 1.0471975f;
    scene.lights.push_back(spot);
    const FrameView view = viewFrom({}, 0.5f);
    int left = -1;
    const std::vector<std::size_t> lights = relevantLights(view, scene, left);
    EXPECT_EQ(lights, (std::vector<std::size_t>{1, 2}));
    EXPECT_EQ(left, 0);
    const ForwardLightBlock block = cocosLights(view, scene, lights);
    EXPECT_EQ(block.position[0], glm::vec4(0, 0, -5, 0));
    EXPECT_EQ(block.position[1], glm::vec4(1, 0, -5, 1));
    // Luminance in ten thousands of candela a square metre: w x radius² / distance² = candela x exposure / distance².
    EXPECT_NEAR(block.color[0].w * 0.15 * 0.15, 80 * 0.5, 1e-3);
    EXPECT_NEAR(block.color[1].w * 0.5 * 0.5, 20 * 0.5, 1e-4);
    EXPECT_NEAR(block.sizeRangeAngle[1].x, 0.5, 0);
    EXPECT_NEAR(block.sizeRangeAngle[1].y, 9, 0);
    EXPECT_NEAR(block.sizeRangeAngle[1].z, 0.5, 1e-6);  // cosine of 60 degrees
    EXPECT_EQ(glm::vec3(block.direction[1]), glm::vec3(0, -1, 0));
    EXPECT_EQ(block.direction[0].w, 2);
    EXPECT_EQ(block.direction[1].w, 0);
}

TEST(CocosLights, TheTenBrightestAtTheCameraAreTakenInThatOrder) {
    Scene scene;
    for (int i = 0; i < 12; ++i) scene.lights.push_back(pointAt({0, 0, -2.0f - float(i)}, 10));
    scene.lights.push_back(pointAt({0, 0, -2}, 10));        // as bright as the first: follows it
    scene.lights.push_back(pointAt({0, 0, 50}, 1e6f, 10));  // behind the camera, and does not reach into the view
    int left = 0;
    const std::vector<std::size_t> lights = relevantLights(viewFrom({}, 1), scene, left);
    EXPECT_EQ(lights, (std::vector<std::size_t>{0, 12, 1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(left, 3);
    EXPECT_EQ(cocosLights(viewFrom({}, 1), scene, lights).direction[0].w, 10);
}

struct Numbered {
    const char* name;
    std::uint32_t binding;
};

void expectNumbers(const GlobalLayout& layout, std::uint32_t set, std::initializer_list<Numbered> expected) {
    for (const Numbered& one : expected) {
        ASSERT_TRUE(layout.bindings().contains(one.name)) << one.name;
        EXPECT_EQ(layout.bindings().at(one.name), (BindingSlot{set, one.binding})) << one.name;
    }
}

GlobalLayout ssaoLayout(Profile profile) {
    GlobalNames names({}, profile);
    names.addTarget("cc_ssaoMap", {}, {"a.json", 1, 1, 1});
    names.addBlock("CCSsao", 1040, {}, {"a.json", 2, 1, 1});
    return names.freeze();
}

TEST(CocosNumbers, Of331AndTheArticles) {
    const GlobalLayout layout = ssaoLayout(Profile::Cocos33);
    expectNumbers(layout, 0,
                  {{"CCGlobal", 0},
                   {"CCCamera", 1},
                   {"CCShadow", 2},
                   {"cc_shadowMap", 3},
                   {"cc_environment", 4},
                   {"cc_spotLightingMap", 5},
                   {"cc_gbuffer_albedoMap", 6},
                   {"cc_gbuffer_positionMap", 7},
                   {"cc_gbuffer_normalMap", 8},
                   {"cc_gbuffer_emissiveMap", 9},
                   {"cc_lighting_resultMap", 10},
                   {"cc_ssaoMap", 11},
                   {"CCSsao", 12}});
    expectNumbers(layout, 2,
                  {{"CCLocal", 0},
                   {"CCLocalBatched", 0},
                   {"CCForwardLight", 1},
                   {"CCSkinningAnimation", 2},
                   {"CCSkinning", 3},
                   {"CCSkinningTexture", 3},
                   {"CCMorph", 4},
                   {"cc_jointTexture", 5},
                   {"cc_realtimeJoint", 5},
                   {"cc_PositionDisplacements", 6},
                   {"cc_NormalDisplacements", 7},
                   {"cc_TangentDisplacements", 8},
                   {"cc_lightingMap", 9},
                   {"cc_spriteTexture", 10},
                   {"cc_reflectionTexture", 11},
                   {"cc_reflectionStorage", 12}});
    EXPECT_EQ(layout.find("CCCamera")->size, 544u);
    EXPECT_EQ(layout.find("CCPunctualLights"), nullptr);
}

TEST(CocosNumbers, Of361AndTheDemos) {
    const GlobalLayout layout = ssaoLayout(Profile::Cocos36);
    expectNumbers(layout, 0,
                  {{"CCGlobal", 0},
                   {"CCCamera", 1},
                   {"CCShadow", 2},
                   {"CCCSM", 3},
                   {"cc_shadowMap", 4},
                   {"cc_environment", 5},
                   {"cc_spotShadowMap", 6},
                   {"cc_diffuseMap", 7},
                   {"cc_ssaoMap", 8},
                   {"CCSsao", 9}});
    expectNumbers(layout, 2,
                  {{"CCLocal", 0},
                   {"CCWorldBound", 0},
                   {"CCForwardLight", 1},
                   {"CCUILocal", 5},
                   {"cc_jointTexture", 6},
                   {"cc_PositionDisplacements", 7},
                   {"cc_TangentDisplacements", 9},
                   {"cc_lightingMap", 10},
                   {"cc_spriteTexture", 11},
                   {"cc_reflectionTexture", 12},
                   {"cc_reflectionStorage", 13}});
    EXPECT_EQ(layout.find("CCGlobal")->size, 112u);
    EXPECT_EQ(layout.find("CCCamera")->size, 592u);
    EXPECT_EQ(layout.find("CCShadow")->size, 256u);
    EXPECT_EQ(layout.find("CCCSM")->size, 656u);
    EXPECT_FALSE(layout.bindings().contains("cc_gbuffer_albedoMap"));  // the material's from 3.4 on
}

}  // namespace
}  // namespace crevice
