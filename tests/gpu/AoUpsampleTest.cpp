// Half resolution: constants, borders and odd sizes, no shift, depth edges of the frame's own resolution; and the last
// step's intensity, exponents and fade.
#include "AoDenoiseFixture.h"

namespace crevice {
namespace {

class AoUpsample : public AoDenoiseTest {};

/// A square in front of the camera, `distance` away along z; the camera sees `size` pixels a side, one world unit each.
void addPixels(Scene& scene, float firstX, float endX, float distance, float size) {
    const glm::vec3 centre((firstX + endX) * 0.5f - size * 0.5f, 0, -distance);
    addBox(scene, centre - glm::vec3(0, 0, 0.05f), {endX - firstX, 3 * size, 0.1f});
}

Camera pixelCamera(float size) {
    Camera camera;
    camera.orthographic = true;
    camera.orthoHeight = size;
    camera.near = 0.5f;
    camera.far = 100;
    return camera;
}

TEST_F(AoUpsample, KeepsConstantsAtEverySize) {
    loadValues("    openness = 0.6;\n    weight = 0.1 + 2.0 * random;", {{"resolution", "half"}});
    Scene scene = wallScene();
    addBox(scene, {1.2f, 0.6f, 0.3f}, {0.8f, 1.2f, 0.7f});
    renderer_->setScene(std::move(scene));
    for (const glm::uvec2 size : {glm::uvec2(161, 91), {160, 90}, {33, 64}, {7, 5}, {3, 3}, {2, 2}, {1, 1}}) {
        const FloatMap result = denoised(viewOf(wallCamera(4), size.x, size.y));
        EXPECT_NEAR(result.min(), 0.6f, 1e-6f) << size.x << " x " << size.y;
        EXPECT_NEAR(result.max(), 0.6f, 1e-6f) << size.x << " x " << size.y;
    }
}

TEST_F(AoUpsample, TexelsStandForTheSecondOfTwoPixels) {
    for (const std::uint32_t width : {160u, 161u}) {
        loadValues("    openness = pixel.x;\n", {{"resolution", "half"}});
        renderer_->setScene(tiltScene(0));
        const FloatMap raw = map(viewOf(tiltCamera(0, false), width, 91));
        ASSERT_EQ(raw.width, (width + 1) / 2);
        for (std::uint32_t x = 0; x < raw.width; ++x)
            ASSERT_EQ(raw.at(x, 40), static_cast<float>(std::min(2 * x + 1, width - 1)) + 0.5f) << x;
    }
}

TEST_F(AoUpsample, RampsDoNotShift) {
    for (const bool orthographic : {false, true}) {
        for (const float degrees : {0.0f, 60.0f, 80.0f}) {
            for (const char* axis : {"x", "y"}) {
                loadValues("    openness = pixel." + std::string(axis) + " / 64.0;",
                           {{"resolution", "half"}, {"denoiser", "none"}});
                renderer_->setScene(tiltScene(degrees));
                const FloatMap result = denoised(viewOf(tiltCamera(degrees, orthographic), 64, 64));
                double shift = 0;
                for (std::uint32_t y = 4; y < 60; ++y) {
                    for (std::uint32_t x = 4; x < 60; ++x) {
                        const double expected = ((*axis == 'x' ? x : y) + 0.5) / 64;
                        EXPECT_NEAR(result.at(x, y), expected, 0.6 * kByteStep + 0.001) << x << ' ' << y;
                        shift += (result.at(x, y) - expected) * 64;
                    }
                }
                EXPECT_NEAR(shift / (56 * 56), 0, 0.05) << "pixels along " << axis << ", degrees " << degrees;
            }
        }
    }
}

TEST_F(AoUpsample, EdgesAreThoseOfTheFrame) {
    for (const bool orthographic : {false, true}) {
        for (const glm::uvec2 size : {glm::uvec2(80, 80), {81, 79}}) {
            loadValues("    openness = depth < 14.5 ? 0.0 : 1.0;", {{"resolution", "half"}});
            renderer_->setScene(plateScene());
            const View view = viewOf(plateCamera(orthographic), size.x, size.y);
            const FloatMap depth = map(view, "viewDepth");
            const FloatMap result = denoised(view);
            for (std::size_t i = 0; i < depth.values.size(); ++i)
                ASSERT_NEAR(result.values[i], depth.values[i] < 14.5f ? 0 : 1, 0.01f) << i;
        }
    }
}

TEST_F(AoUpsample, TakesTheNearestDepthWhereItsOwnIsMissing) {
    // A post over one even column, which no texel stands for; on its right a plate that is nearly as near.
    constexpr float kSize = 64;
    Scene scene = emptyScene();
    addPixels(scene, -40, 140, 20, kSize);
    addPixels(scene, 30, 31, 6, kSize);
    addPixels(scene, 31, 50, 7, kSize);
    renderer_->setScene(std::move(scene));
    loadValues("    openness = depth > 10.0 ? 1.0 : (depth > 6.5 ? 0.2 : 0.6);",
               {{"resolution", "half"}, {"denoiser", "none"}});
    const View view = viewOf(pixelCamera(kSize), 64, 64);
    const FloatMap depth = map(view, "viewDepth");
    const FloatMap result = denoised(view);
    ASSERT_NEAR(depth.at(29, 30), 20, 0.01f);
    ASSERT_NEAR(depth.at(30, 30), 6, 0.01f);
    ASSERT_NEAR(depth.at(31, 30), 7, 0.01f);
    EXPECT_NEAR(result.at(29, 30), 1, 1e-6f);
    EXPECT_NEAR(result.at(30, 30), 0.2f, 1e-6f);
    EXPECT_NEAR(result.at(31, 30), 0.2f, 1e-6f);
}

TEST_F(AoUpsample, TakesNoise) {
    loadValues("    openness = random;", {{"resolution", "half"}, {"denoiser", "none"}});
    renderer_->setScene(tiltScene(60));
    const View view = viewOf(tiltCamera(60, false), 192, 144);
    const FloatMap result = denoised(view);
    EXPECT_LT(variance(result, 4), variance(map(view)) / 4);
    EXPECT_NEAR(result.mean(), map(view).mean(), 0.005);
}

TEST_F(AoUpsample, SkyStaysOpen) {
    Scene scene = emptyScene();
    addBox(scene, {0, 0, -5}, {1, 1, 1});
    loadValues("    openness = depth > 1e6 ? 1.0 : 0.25;", {{"resolution", "half"}});
    renderer_->setScene(std::move(scene));
    const View view = viewOf(tiltCamera(0, false), 65, 47);
    const FloatMap depth = map(view, "viewDepth");
    const FloatMap result = denoised(view);
    ASSERT_GT(depth.max(), 1e8f);
    for (std::size_t i = 0; i < depth.values.size(); ++i)
        ASSERT_NEAR(result.values[i], depth.values[i] > 1e6f ? 1 : 0.25f, 0.002f) << i;
}

TEST_F(AoUpsample, IntensityPowerAndCurveAreAppliedOnce) {
    renderer_->setScene(tiltScene(0));
    const View view = viewOf(tiltCamera(0, false), 16, 16);
    struct Case {
        const char *intensity, *power, *curve;
    };
    for (const char* resolution : {"full", "half"}) {
        for (const Case& c : {Case{"1", "1", "1"},
                              {"0", "1", "1"},
                              {"0.5", "1", "1"},
                              {"2", "1", "1"},
                              {"4", "1", "1"},
                              {"1", "2", "1"},
                              {"1", "1", "1.5"},
                              {"0.5", "2", "1.5"}}) {
            loadValues("    openness = 0.6;",
                       {{"intensity", c.intensity}, {"power", c.power}, {"resolution", resolution}},
                       {{.path = "AoResolve.material.curve", .value = c.curve}});
            const double open = std::max(0.0, 1 - std::stod(c.intensity) * 0.4);
            const double expected = std::pow(open, std::stod(c.power) * std::stod(c.curve));
            const FloatMap result = denoised(view);
            EXPECT_NEAR(result.at(8, 8), expected, 2e-5) << c.intensity << ' ' << c.power << ' ' << c.curve;
            EXPECT_NEAR(result.min(), result.max(), 1e-6f);
        }
    }
}

TEST_F(AoUpsample, FadesFromStartToEnd) {
    for (const bool orthographic : {false, true}) {
        for (const char* resolution : {"full", "half"}) {
            renderer_->setScene(tiltScene(0));  // 5 units away
            struct Case {
                const char *start, *end;
                double left;
            };
            for (const Case& c :
                 {Case{"0", "0", 1}, {"0", "10", 0.5}, {"4", "8", 0.75}, {"1", "4.5", 0}, {"6", "9", 1}}) {
                loadValues("    openness = 0.6;",
                           {{"fadeStart", c.start}, {"fadeEnd", c.end}, {"resolution", resolution}});
                EXPECT_NEAR(denoised(viewOf(tiltCamera(0, orthographic), 16, 16)).at(8, 8), 1 - 0.4 * c.left, 5e-4)
                    << c.start << " … " << c.end;
            }
        }
    }
}

}  // namespace
}  // namespace crevice
