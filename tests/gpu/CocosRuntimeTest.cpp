// What Cocos' effects are drawn with: the quad, attributes, passes, lights, warnings. Effects and documents are the
// tests' own, in Cocos' dialect.
#include "CocosFixture.h"

namespace crevice {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kQuadVertex = R"(
CCProgram quad-vs %{
  precision highp float;
  in vec2 a_position;
  in vec2 a_texCoord;
  out vec2 v_uv;
  vec4 vert () {
    v_uv = a_texCoord;
    return vec4(a_position.x, -a_position.y, 1.0, 1.0);
  }
}%
)";

constexpr const char* kCamera = R"(
  #pragma builtin(global)
  layout(set = 0, binding = 1) uniform CCCamera {
    mat4 cc_matView; mat4 cc_matViewInv; mat4 cc_matProj; mat4 cc_matProjInv; mat4 cc_matViewProj; mat4 cc_matViewProjInv;
    vec4 cc_cameraPos; vec4 cc_surfaceTransform; vec4 cc_screenScale; vec4 cc_exposure; vec4 cc_mainLitDir;
    vec4 cc_mainLitColor; vec4 cc_ambientSky; vec4 cc_ambientGround; vec4 cc_fogColor; vec4 cc_fogBase; vec4 cc_fogAdd;
    vec4 cc_nearFar; vec4 cc_viewPort;
  };
  #pragma builtin(local)
  layout(set = 2, binding = 0) uniform CCLocal {
    mat4 cc_matWorld; mat4 cc_matWorldIT; vec4 cc_lightingMapUVParam; vec4 cc_localShadowBias;
  };
)";

class CocosRuntime : public CocosTest {
protected:
    void SetUp() override {
        CocosTest::SetUp();
        std::filesystem::create_directories(folder_ / "project/assets");
    }
    void writeCocos(const std::string& name, const std::string& text) const {
        writeFileAtomically(folder_ / "project/assets" / (name + ".effect"), text);
    }
    void writeFullscreen(const std::string& name, const std::string& fragment) const {
        writeCocos(name,
                   "CCEffect %{\n  techniques:\n  - passes:\n    - vert: quad-vs:vert\n      frag: test-fs:frag\n"
                   "      depthStencilState: { depthTest: false, depthWrite: false }\n}%\n" +
                       std::string(kQuadVertex) + "CCProgram test-fs %{\n  precision highp float;\n  in vec2 v_uv;\n" +
                       fragment + "}%\n");
    }
    /// A surface effect: `passes` in the header, `declarations` and the colour that the vertex program gives.
    void writeSurface(const std::string& name, const std::string& passes, const std::string& declarations,
                      const std::string& color) const {
        writeCocos(name, "CCEffect %{\n  techniques:\n  - passes:\n" + passes +
                             "}%\nCCProgram vs %{\n  precision highp float;\n" + kCamera +
                             "  in vec3 a_position;\n  out vec4 v_color;\n" + declarations +
                             "  vec4 vert () {\n    v_color = " + color +
                             ";\n    return cc_matViewProj * cc_matWorld * vec4(a_position, 1.0);\n  }\n}%\n"
                             "CCProgram fs %{\n  precision highp float;\n  in vec4 v_color;\n"
                             "  vec4 frag () {\n    vec4 color = v_color;\n    #if TINT == 1\n    color = vec4(1.0, "
                             "0.0, 0.0, 1.0);\n"
                             "    #endif\n    return color;\n  }\n}%\n");
    }
    void loadCocos(const std::string& stages, const std::string& more = {}) {
        renderer_->effects().addFrontEnd(std::make_unique<cocos::CocosEffects>(
            cocos::Roots{.chunks = {}, .project = folder_ / "project", .engine = {}}));
        const std::string depth =
            stages.find("ForwardStage") == std::string::npos ? "" : R"(, "depth": {"format": "D32F", "clear": 1})";
        loadDocument(
            R"({"profile": "cocos-3.6", "output": "finalColor", "targets": {"finalColor": {"format": "RGBA8"})" +
            depth + "}, " + more + R"("flows": [{"flow": "Main", "stages": [)" + stages + "]}]}");
    }
    static std::string forward(const std::string& phase = "default") {
        return R"({"stage": "ForwardStage", "writes": ["finalColor"], "queues": [{"phase": ")" + phase + R"("}]})";
    }
    Scene wallWith(MaterialEffect effect) {
        Scene scene = darkScene();
        scene.materials[0].name = "wall";
        scene.materials[0].effect = std::move(effect);
        addWall(scene, 10);
        return scene;
    }
    glm::vec4 centreOf(const Scene& scene) {
        renderer_->setScene(scene);
        return renderer_->render(viewOf(frontCamera(), 16, 16)).at(8, 8);
    }
};

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
