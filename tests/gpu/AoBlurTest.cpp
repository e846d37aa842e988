// The edge-aware blur: keeps constants and means, takes noise away, does not cross depth steps.
#include "AoFixture.h"

namespace crevice {
namespace {

/// G-buffer, a map that the effect `test-map` makes, and the blur along one axis.
std::string blurDocument(const std::string& axis, const std::string& radius) {
    return R"({ "extends": "ao-only", "output": "blurred",
      "targets": { "blurred": { "format": "R32F" }, "made": { "format": "R8" } },
      "edits": [ { "remove": "SsaoStage" }, { "remove": "SsaoBlurX" }, { "remove": "SsaoBlurY" }, { "remove": "DebugView" },
        { "insert": { "flow": "TestFlow", "stages": [
          { "stage": "FullscreenStage", "name": "Make", "effect": "test-map", "writes": ["made"] },
          { "stage": "FullscreenStage", "name": "Blur", "effect": "ssao-blur", "defines": { "BLUR_AXIS": )" +
           axis + R"( }, "material": { "radius": )" + radius +
           R"( }, "reads": { "aoMap": "made" }, "writes": ["blurred"] } ] }, "after": "GbufferFlow" } ] })";
}

class AoBlur : public AoTest {};

TEST_F(AoBlur, KeepsEveryConstantExactly) {
    // 256 tiles of 16 x 16 pixels, one for each byte value: whatever lies 8 pixels from a tile's rim sees only its own
    // value.
    writeFragment("test-map", "",
                  "    ivec2 tile = ivec2(gl_FragCoord.xy) / 17;\n    result = float(tile.y * 16 + tile.x) / 255.0;",
                  "float");
    for (const char* axis : {"0", "1"}) {
        loadDocument(blurDocument(axis, "8"));
        renderer_->setScene(busyScene());
        const View view = viewOf(wallCamera(4), 16 * 17, 16 * 17);
        const FloatMap blurred = map(view, "blurred");
        for (std::uint32_t value = 0; value < 256; ++value) {
            const float found = blurred.at(value % 16 * 17 + 8, value / 16 * 17 + 8);
            ASSERT_NEAR(found, static_cast<float>(value) / 255, 1e-7f) << "axis " << axis;
        }
        EXPECT_GT(maxDifference(map(view, "made"), blurred), 0.001f) << "the blur did nothing";
    }
}

TEST_F(AoBlur, KeepsAMapThatNobodyWrote) {
    writeFragment("test-map", "", "    result = 0.0;", "float");
    // `made` is never written (its stage is off): it holds its clear value everywhere, borders of the frame included.
    for (const char* axis : {"0", "1"}) {
        loadDocument(blurDocument(axis, "8"), {{"Make.enabled", "false"}, {"made.clear", "0.6"}});
        renderer_->setScene(busyScene());
        const FloatMap blurred = map(viewOf(wallCamera(4), 64, 64), "blurred");
        EXPECT_NEAR(blurred.min(), 0.6f, 1e-7f);
        EXPECT_NEAR(blurred.max(), 0.6f, 1e-7f);
    }
}

TEST_F(AoBlur, RadiusZeroCopies) {
    writeFragment("test-map", "", "    result = fract(dot(gl_FragCoord.xy, vec2(0.37, 0.73)));", "float");
    loadDocument(blurDocument("0", "0"));
    renderer_->setScene(busyScene());
    const View view = viewOf(wallCamera(4), 64, 64);
    EXPECT_LE(maxDifference(map(view, "made"), map(view, "blurred")), 1e-6f);
}

TEST_F(AoBlur, DoesNotBleedOverADepthStep) {
    // A plate two units above the floor: openness 0 on it, 1 beneath, which no blur may mix.
    writeFragment("test-map", "  uniform sampler2D viewDepth;",
                  "    result = texture(viewDepth, v_uv).r < 14.5 ? 0.0 : 1.0;", "float");
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, {0, 1, 0}, 40);
    addSquare(scene, {0.3f, 2, 0.1f}, {0, 1, 0}, 1.1f);
    for (const char* axis : {"0", "1"}) {
        loadDocument(blurDocument(axis, "4"));
        renderer_->setScene(scene);
        Camera camera = Camera::lookAt({0.5f, 15, 3.8f}, {0, 0, 0});
        camera.fovY = 0.2f;
        camera.near = 1;
        camera.far = 100;
        const View view = viewOf(camera, 80, 80);
        const FloatMap made = map(view, "made");
        const FloatMap blurred = map(view, "blurred");
        EXPECT_EQ(made.min(), 0);
        EXPECT_EQ(made.max(), 1);
        EXPECT_LE(maxDifference(made, blurred), 0.01f) << "axis " << axis;
    }
}

TEST_F(AoBlur, TakesNoiseAndKeepsTheMean) {
    load("ao-only", {},
         {{"SsaoStage.material.radius", "1"},
          {"SsaoStage.params.samples", "16"},
          {"cc_ssaoMap.format", "R32F"},
          {"ssaoBlurX.format", "R32F"},
          {"cc_ssaoBlurMap.format", "R32F"}});
    renderer_->setScene(wallScene());
    View view = viewOf(wallCamera(4), 96, 96);
    view.keep = {"cc_ssaoMap", "cc_ssaoBlurMap"};
    renderer_->render(view);
    const FloatMap raw(renderer_->target("cc_ssaoMap"));
    const FloatMap blurred(renderer_->target("cc_ssaoBlurMap"));
    EXPECT_NEAR(raw.mean(), blurred.mean(), kByteStep);
    double rawVariance = 0, blurredVariance = 0;
    for (std::uint32_t row = 0; row < 96; ++row)
        rawVariance += raw.rowVariance(row), blurredVariance += blurred.rowVariance(row);
    EXPECT_GT(rawVariance, 0.01);
    EXPECT_LT(blurredVariance, rawVariance / 4);
}

}  // namespace
}  // namespace crevice
