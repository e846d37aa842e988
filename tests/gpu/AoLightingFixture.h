// Lighting under an occlusion map that the test makes itself, so that every pixel has a value to expect.
#pragma once

#include "AoFixture.h"

namespace crevice {

/// Technique `off`; `test-ao` writes the map that lighting samples, `test-material` occlusion of the material.
class AoLightingOptions : public AoTest {
protected:
    static constexpr std::uint32_t kWidth = 64, kHeight = 48;
    /// Openness by pixel: 0 and 1 exactly in places, anything between elsewhere.
    static constexpr const char* kOpenness =
        "clamp(fract(dot(floor(gl_FragCoord.xy), vec2(0.371, 0.137))) * 1.3 - 0.15, 0.0, 1.0)";

    void SetUp() override {
        AoTest::SetUp();
        const std::string percent = "  #pragma define-meta PERCENT range([-1, 100]) default(-1)\n";
        writeFragment("test-ao", percent,
                      std::string("  #if PERCENT < 0\n    result = ") + kOpenness +
                          ";\n  #else\n    result = float(PERCENT) / 100.0;\n  #endif",
                      "float");
        writeFragment("test-bent", "",
                      "    result = mod(floor(gl_FragCoord.x), 2.0) < 0.5 ? vec4(0.51, 0.68, 0.0, 0.0) : vec4(0.0);",
                      "vec4");
        writeFragment("test-material", percent, "    result = vec4(0.0, 0.0, 0.0, float(PERCENT) / 100.0);", "vec4");
    }

    /// A bent normal of direction (0.6, 0.8, 0) in every other column.
    void setBentNormal(bool isOn) { hasBentNormal_ = isOn; }

    /// Openness in percent: of the map (-1: the pattern above), and of the material (100: its own; below, materials
    /// emit nothing).
    void setOpenness(int mapPercent, int materialPercent = 100) {
        mapPercent_ = mapPercent;
        materialPercent_ = materialPercent;
    }

    /// `occluded` false: the map is not written and stays white.
    void loadLighting(const Options& options, bool occluded = true) {
        Options all = options;
        all.emplace("ao", "off");
        loadDocument(R"({ "extends": "ao-deferred",
          "targets": { "bentNormal": { "format": "RGBA16F" },
                       "cc_ssaoBlurMap": { "override": true, "format": "R32F" },
                       "cc_lighting_resultMap": { "override": true, "format": "RGBA32F" } },
          "edits": [
            { "insert": { "stage": "FullscreenStage", "name": "MakeMaterial", "effect": "test-material",
                          "writes": ["cc_gbuffer_emissiveMap"] }, "after": "GbufferStage" },
            { "insert": { "stage": "FullscreenStage", "name": "MakeAo", "effect": "test-ao",
                          "writes": ["cc_ssaoBlurMap"] }, "before": "LightingStage" },
            { "insert": { "stage": "FullscreenStage", "name": "MakeBent", "effect": "test-bent",
                          "writes": ["bentNormal"] }, "before": "LightingStage" } ] })",
                     {{"MakeAo.enabled", occluded ? "true" : "false"},
                      {"MakeAo.defines.PERCENT", std::to_string(mapPercent_)},
                      {"MakeBent.enabled", hasBentNormal_ ? "true" : "false"},
                      {"LightingStage.defines.BENT_NORMALS", hasBentNormal_ ? "1" : "null"},
                      {"MakeMaterial.enabled", materialPercent_ < 100 ? "true" : "false"},
                      {"MakeMaterial.defines.PERCENT", std::to_string(materialPercent_)}},
                     all);
    }
    Image lit(const Scene& scene, const Options& options, bool occluded = true) {
        loadLighting(options, occluded);
        renderer_->setScene(scene);
        return target(view_, "cc_lighting_resultMap");
    }
    Image openness(const Scene& scene) {
        loadLighting({});
        renderer_->setScene(scene);
        return target(view_, "cc_ssaoBlurMap");
    }

    /// Floor, wall and box; coloured dielectrics and a metal.
    static Scene room() {
        Scene scene = wallScene();
        SceneMaterial copper;
        copper.baseColor = {0.9f, 0.55f, 0.35f, 1};
        copper.roughness = 0.35f;
        scene.materials.push_back(copper);
        scene.materials[0].baseColor = {0.8f, 0.5f, 0.15f, 1};
        scene.materials[0].roughness = 0.5f;
        addBox(scene, {1, 0.5f, 0.4f}, {0.7f, 1, 0.7f}, 1);
        scene.ambient = Ambient{};
        return scene;
    }
    static Scene sunlit() {
        Scene scene = room();
        Light sun;
        sun.direction = glm::normalize(glm::vec3(-0.6f, -1, -0.5f));
        sun.intensity = 2;
        scene.lights = {sun};
        return scene;
    }
    static Scene ambientLit(const glm::vec3& radiance = glm::vec3(0.8f, 0.9f, 1.1f)) {
        Scene scene = room();
        scene.ambient = Ambient{radiance, radiance};
        return scene;
    }
    /// A plane seen straight, so that n·v = 1 and the mirrored direction is the normal.
    Scene facingPlane(const glm::vec3& color, float metallic, float roughness) {
        Scene scene = emptyScene();
        scene.materials[0].baseColor = glm::vec4(color, 1);
        scene.materials[0].metallic = metallic;
        scene.materials[0].roughness = roughness;
        addSquare(scene, {0, 0, -5}, {0, 0, 1}, 20);
        Camera camera = Camera::lookAt({0, 0, 0}, {0, 0, -1});
        camera.orthographic = true;
        camera.orthoHeight = 2;
        camera.near = 0.1f;
        camera.far = 60;
        view_ = viewOf(camera, kWidth, kHeight);
        return scene;
    }

    int mapPercent_ = -1, materialPercent_ = 100;
    bool hasBentNormal_ = false;
    View view_ = [] {
        Camera camera = Camera::lookAt({4, 4, 3}, {0.4f, 0.4f, 0.4f});
        camera.near = 0.1f;
        camera.far = 60;
        return viewOf(camera, kWidth, kHeight);
    }();
};

/// Calls `visit(x, y)` for every pixel of the fixture's view.
template <class Visit>
void eachPixel(const Image& image, Visit visit) {
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x) visit(x, y);
}

}  // namespace crevice
