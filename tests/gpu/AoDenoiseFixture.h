// Denoising tests: ao-deferred with a technique of the test, which packs whatever values the test asks for, so that
// nothing but denoisers, upsampling and the last step is judged.
#pragma once

#include "AoFixture.h"

namespace crevice {

/// The choices of the option `denoiser` that filter, and those of them that stop at edges.
inline constexpr const char* kDenoisers[] = {"box", "gaussian", "bilateral", "edge-packed", "atrous"};
inline constexpr const char* kEdgeAware[] = {"bilateral", "edge-packed", "atrous"};

class AoDenoiseTest : public AoTest {
protected:
    /// GLSL of the values that the technique packs. It may use `texel` (of the map), `pixel` (centre of the frame's
    /// pixel that it stands for), `depth`, `random` (0 … 1, another for each texel); it sets `openness` and may set
    /// `weight`.
    void loadValues(const std::string& body, Options options = {}, Sets sets = {}) {
        std::filesystem::create_directories(folder_ / "flows" / "ao");
        const std::string effect = newName();
        writeFileAtomically(folder_ / "flows" / "ao" / "test.flow.json",
                            R"({ "stages": [ { "stage": "FullscreenStage", "name": "AoMain", "effect": ")" + effect +
                                R"(", "writes": ["cc_ssaoMap", "aoPacked"] } ] })");
        writeEffect(effect, std::string(kHead) + body + kFoot);
        sets.insert(sets.begin(), {{.path = "cc_ssaoBlurMap.format", .value = "R32F"},
                                   {.path = "cc_ssaoMap.format", .value = "R32F"}});
        options.insert({{"shadows", "false"}, {"fxaa", "false"}});
        loadDocument(R"({ "extends": "ao-deferred",
          "options": { "ao": { "override": true, "choices": ["off", "test"], "default": "test" } } })",
                     std::move(sets), std::move(options));
    }

    /// Of an effect: a renderer reads each name once.
    std::string newName() { return "test-" + std::to_string(++effects_); }

    FloatMap denoised(const View& view) { return map(view, "cc_ssaoBlurMap"); }

private:
    int effects_ = 0;

    static constexpr const char* kHead = R"(CCEffect %{
  techniques:
  - passes:
    - vert: fullscreen-vs
      frag: test-fs
      rasterizerState: { cullMode: none }
      depthStencilState: { depthTest: false, depthWrite: false }
}%
CCProgram test-fs %{
  precision highp float;
  #include <ao-view>
  #include <ao-packed>
  #include <noise>
  in vec2 v_uv;
  layout(location = 0) out float raw;
  layout(location = 1) out uint packedOut;
  void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec2 pixel = aoDepthPixel(v_uv, vec2(imageSize(viewDepth)));
    float depth = imageLoad(viewDepth, ivec2(pixel)).r;
    float random = hashNoise(uvec2(texel));
    float openness = 1.0;
    float weight = 1.0;
)";
    static constexpr const char* kFoot = R"(
    raw = openness;
    packedOut = packAo(openness, weight, depth);
  }
}%
)";
};

inline double variance(const FloatMap& map, std::uint32_t border = 0) {
    double sum = 0, squares = 0, count = 0;
    for (std::uint32_t y = border; y + border < map.height; ++y) {
        for (std::uint32_t x = border; x + border < map.width; ++x) {
            sum += map.at(x, y);
            squares += double(map.at(x, y)) * map.at(x, y);
            ++count;
        }
    }
    return squares / count - sum / count * (sum / count);
}

/// A plane tilted by so many degrees that fills the frame of tiltCamera().
inline Scene tiltScene(float degrees) {
    const float tilt = glm::radians(degrees);
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, -5}, {std::sin(tilt) * 0.3f, std::sin(tilt) * std::sqrt(1 - 0.09f), std::cos(tilt)}, 300);
    return scene;
}

inline Camera tiltCamera(float degrees, bool orthographic) {
    Camera camera;
    camera.orthographic = orthographic;
    camera.fovY = glm::radians(degrees > 70 ? 9.0f : 26.0f);
    camera.orthoHeight = degrees > 70 ? 0.8f : 2.5f;
    camera.near = 0.1f;
    camera.far = 1000;
    return camera;
}

/// A plate two units above a floor, which is 15 units from the camera.
inline Scene plateScene() {
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, {0, 1, 0}, 40);
    addSquare(scene, {0.3f, 2, 0.1f}, {0, 1, 0}, 1.1f);
    return scene;
}

inline Camera plateCamera(bool orthographic) {
    Camera camera = Camera::lookAt({0.5f, 15, 3.8f}, {0, 0, 0});
    camera.orthographic = orthographic;
    camera.fovY = 0.2f;
    camera.orthoHeight = 3;
    camera.near = 1;
    camera.far = 100;
    return camera;
}

}  // namespace crevice
