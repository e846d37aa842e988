// Effects of a test's own in Cocos' dialect, and documents that draw with them.
#pragma once

#include "CocosFixture.h"

namespace crevice {

inline constexpr const char* kQuadVertex = R"(
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

inline constexpr const char* kCamera = R"(
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

}  // namespace crevice
