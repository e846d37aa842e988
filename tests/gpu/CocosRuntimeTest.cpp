// What Cocos' effects are drawn with: the quad, attributes, passes, lights, warnings. Effects and documents are the
// tests' own, in Cocos' dialect.
#include "CocosRuntimeFixture.h"

namespace crevice {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(CocosRuntime, QuadHasTheTextureCoordinatesOfItsPixels) {
    writeFullscreen("uv", "  vec4 frag () { return vec4(v_uv, 0.0, 1.0); }\n");
    loadCocos(R"({"stage": "FullscreenStage", "effect": "uv", "writes": ["finalColor"]})");
    renderer_->setScene(darkScene());
    const Image image = renderer_->render(sized(16, 8));
    for (std::uint32_t y = 0; y < 8; ++y) {
        for (std::uint32_t x = 0; x < 16; ++x) {
            EXPECT_NEAR(image.at(x, y).x, (float(x) + 0.5f) / 16, 0.5f / 255) << x << ' ' << y;
            EXPECT_NEAR(image.at(x, y).y, (float(y) + 0.5f) / 8, 0.5f / 255) << x << ' ' << y;
        }
    }
}

TEST_F(CocosRuntime, SamplersThatNothingFeedsShowTheChecker) {
    writeFullscreen(
        "checker",
        "  uniform sampler2D strange;\n"
        "  vec4 frag () { return vec4(textureLod(strange, (floor(v_uv * 16.0) + 0.5) / 16.0, 0.0).rgb, 1.0); }\n");
    loadCocos(R"({"stage": "FullscreenStage", "effect": "checker", "writes": ["finalColor"]})");
    renderer_->setScene(darkScene());
    const Image image = renderer_->render(sized(16, 16));
    for (std::uint32_t i = 0; i < 256; ++i) {
        const bool light = (i % 16 < 8) == (i / 16 < 8);
        EXPECT_NEAR(image.at(i % 16, i / 16).x * 255, light ? 221 : 85, 0.6) << i;
    }
}

TEST_F(CocosRuntime, PicturesOfStagesAreSampledAsTheirNamesSay) {
    Image picture(2, 1, Format::RGBA8);
    for (std::size_t i = 0; i < 8; ++i) picture.pixels[i] = std::byte(i < 4 ? 0 : 255);
    writeImage(folder_ / "two.png", picture);
    writeCocos("two",
               "CCEffect %{\n  techniques:\n  - passes:\n    - vert: quad-vs:vert\n      frag: test-fs:frag\n"
               "      properties: { two: { value: white } }\n"
               "      depthStencilState: { depthTest: false, depthWrite: false }\n}%\n" +
                   std::string(kQuadVertex) +
                   "CCProgram test-fs %{\n  precision highp float;\n  in vec2 v_uv;\n  uniform sampler2D two;\n"
                   "  vec4 frag () { return vec4(textureLod(two, vec2(0.0, 0.5), 0.0).r, textureLod(two, vec2(0.5, "
                   "0.5), 0.0).r, v_uv.x * 0.0, 1.0); }\n}%\n");
    const auto texelWith = [&](const std::string& words) {
        loadCocos(R"({"stage": "FullscreenStage", "effect": "two", "writes": ["finalColor"], "material": {"two": ")" +
                  (folder_ / "two.png").string() + words + "\"}}");
        renderer_->setScene(darkScene());
        return renderer_->render(sized(4, 4)).at(1, 1);
    };
    // At the left edge both texels meet when the picture repeats; in its middle they meet unless the nearest one
    // counts.
    EXPECT_NEAR(texelWith("").x, 0.5f, 0.01f);
    EXPECT_NEAR(texelWith("").y, 0.5f, 0.01f);
    EXPECT_EQ(texelWith("#clamp").x, 0.0f);
    EXPECT_NEAR(texelWith("#clamp").y, 0.5f, 0.01f);
    EXPECT_EQ(texelWith("#nearest,clamp").y, 1.0f);
}

TEST_F(CocosRuntime, AttributesThatMeshesLackAreZero) {
    writeSurface("plain", "    - { vert: 'vs:vert', frag: 'fs:frag' }\n",
                 "  in vec4 a_color1;\n  in vec4 a_lightingMapUVParam;\n  in float a_dyn_batch_id;\n",
                 "vec4(0.0, 0.6, 0.0, 1.0) + a_color1 + a_lightingMapUVParam + vec4(a_dyn_batch_id)");
    loadCocos(forward());
    const glm::vec4 color = centreOf(wallWith({.effect = "plain", .technique = 0, .passes = {}}));
    EXPECT_NEAR(color.x, 0, 1e-6);
    EXPECT_NEAR(color.y, 0.6, 0.5 / 255);
    EXPECT_NEAR(color.w, 1, 1e-6);
}

TEST_F(CocosRuntime, AllPassesOfAMaterialDrawInOrderOfPriority) {
    const std::string state = ", depthStencilState: { depthFunc: always }";
    const auto passes = [&](const char* first, const char* second) {
        return "    - { vert: 'vs:vert', frag: 'fs:frag', priority: " + std::string(first) + state +
               ", embeddedMacros: { TINT: 1 } }\n    - { vert: 'vs:vert', frag: 'fs:frag', priority: " + second +
               state + " }\n";
    };
    writeSurface("red-last", passes("130", "128"), "", "vec4(0.0, 1.0, 0.0, 1.0)");
    writeSurface("green-last", passes("128", "128"), "", "vec4(0.0, 1.0, 0.0, 1.0)");
    loadCocos(forward());
    EXPECT_EQ(centreOf(wallWith({.effect = "red-last", .technique = 0, .passes = {}})), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(centreOf(wallWith({.effect = "green-last", .technique = 0, .passes = {}})), glm::vec4(0, 1, 0, 1));
}

TEST_F(CocosRuntime, WhatNoQueueDrawsIsSaid) {
    writeSurface("unlit", "    - { vert: 'vs:vert', frag: 'fs:frag', phase: unlit-phase }\n", "", "vec4(1.0)");
    loadCocos(forward());
    EXPECT_EQ(centreOf(wallWith({.effect = "unlit", .technique = 0, .passes = {}})), glm::vec4(0, 0, 0, 1));
    const std::vector<std::string> warnings = takeWarnings();
    EXPECT_THAT(warnings, Contains(HasSubstr("'ForwardStage' takes the phases 'default', and no material")));
    EXPECT_THAT(warnings, Contains(HasSubstr("material 'wall' is drawn by no queue")));
}

TEST_F(CocosRuntime, NumbersThatContradictNamesAreAnErrorWithoutTheFallback) {
    writeFullscreen("wrong",
                    "  #pragma builtin(global)\n  layout(set = 0, binding = 5) uniform CCGlobal { vec4 cc_time; vec4 "
                    "cc_screenSize; vec4 cc_nativeSize; vec4 a; vec4 b; vec4 c; vec4 d; };\n"
                    "  vec4 frag () { return vec4(cc_screenSize.xy / 255.0, v_uv.x * 0.0, 1.0); }\n");
    const char* stage = R"({"stage": "FullscreenStage", "effect": "wrong", "writes": ["finalColor"]})";
    loadCocos(stage);
    renderer_->setScene(darkScene());
    EXPECT_NEAR(renderer_->render(sized(16, 8)).at(3, 3).x, 16 / 255.0, 1e-6);  // the name decided
    try {
        loadCocos(stage, R"("fallbacks": {"rebindLiterals": false}, )");
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("'CCGlobal' of effect 'wrong' is written for set 0, binding 5, and the pipeline "
                              "has it at set 0, binding 0"));
    }
}

TEST_F(CocosRuntime, MoreThanTenLightsAreSaidOnce) {
    writeFullscreen(
        "lights",
        "  #pragma builtin(local)\n  layout(set = 2, binding = 1) uniform CCForwardLight { vec4 cc_lightPos[10]; "
        "vec4 cc_lightColor[10]; vec4 cc_lightSizeRangeAngle[10]; vec4 cc_lightDir[10]; };\n"
        "  vec4 frag () { return vec4(cc_lightDir[0].w / 255.0, cc_lightPos[9].x, v_uv.x * 0.0, 1.0); }\n");
    loadCocos(R"({"stage": "FullscreenStage", "effect": "lights", "writes": ["finalColor"]})");
    Scene scene = darkScene();
    for (int i = 0; i < 12; ++i) scene.lights.push_back(pointLight({0.5f, 0, -float(i)}, 100));
    renderer_->setScene(scene);
    const View view = viewOf(frontCamera(), 8, 8);
    EXPECT_NEAR(renderer_->render(view).at(4, 4).x, 10 / 255.0, 1e-6);
    EXPECT_NEAR(renderer_->render(view).at(4, 4).y, 0.5, 0.6 / 255);
    EXPECT_THAT(takeWarnings(), ElementsAre(HasSubstr("2 lights more than the 10")));
}

}  // namespace
}  // namespace crevice
