// The denoisers of ao-deferred, each by itself: constants and means stay, noise goes, nothing crosses depth steps.
#include "AoDenoiseFixture.h"

namespace crevice {
namespace {

constexpr std::uint32_t kTile = 17;  // whatever lies in its middle sees only its own tile in three passes

class AoDenoise : public AoDenoiseTest {
protected:
    double noiseAfter(const std::string& denoiser, const std::string& passes, const View& view,
                      const std::string& resolution = "full") {
        loadValues("    openness = random;", {{"denoiser", denoiser}, {"passes", passes}, {"resolution", resolution}});
        const FloatMap result = denoised(view);
        EXPECT_NEAR(result.mean(), map(view).mean(), 0.005) << denoiser << ", passes " << passes;
        return variance(result, 8);
    }
};

TEST_F(AoDenoise, KeepsEveryConstantExactly) {
    for (const char* denoiser : kDenoisers) {
        loadValues(
            "    ivec2 tile = texel / 17;\n    openness = float(tile.y * 16 + tile.x) / 255.0;\n"
            "    weight = 0.1 + 2.0 * random;",
            {{"denoiser", denoiser}, {"passes", "3"}});
        renderer_->setScene(busyScene());
        const View view = viewOf(wallCamera(4), 16 * kTile, 16 * kTile);
        const FloatMap result = denoised(view);
        for (std::uint32_t value = 0; value < 256; ++value) {
            const float found = result.at(value % 16 * kTile + kTile / 2, value / 16 * kTile + kTile / 2);
            ASSERT_NEAR(found, static_cast<float>(value) / 255, 1e-6f) << denoiser;
        }
        EXPECT_GT(maxDifference(map(view), result), 0.001f) << denoiser << " did nothing";
    }
}

TEST_F(AoDenoise, TakesNoiseFromPlanesAtEveryTilt) {
    for (const bool orthographic : {false, true}) {
        for (const float degrees : {0.0f, 80.0f}) {
            const View view = viewOf(tiltCamera(degrees, orthographic), 96, 72);
            for (const char* denoiser : kDenoisers) {
                renderer_->setScene(tiltScene(degrees));
                const std::string what = std::string(denoiser) + ", degrees " + std::to_string(degrees);
                EXPECT_LT(noiseAfter(denoiser, "1", view), 1.0 / 12 / 4) << what;
                EXPECT_NEAR(variance(map(view), 8), 1.0 / 12, 0.01) << what;
            }
        }
    }
}

TEST_F(AoDenoise, EveryPassOfAtrousTakesThreeQuartersOfTheVariance) {
    // Wider and wider: what one pass leaves is noise to the next. The others repeat one width and take less each time.
    const View view = viewOf(tiltCamera(60, false), 512, 512);
    renderer_->setScene(tiltScene(60));
    double before = 1.0 / 12;
    for (const char* passes : {"1", "2", "3"}) {
        const double after = noiseAfter("atrous", passes, view);
        EXPECT_LT(after, before / 4) << passes;
        before = after;
    }
    const View small = viewOf(tiltCamera(60, false), 128, 96);
    for (const char* denoiser : kDenoisers) {
        EXPECT_LT(noiseAfter(denoiser, "2", small), noiseAfter(denoiser, "1", small) / 1.5) << denoiser;
        EXPECT_LT(noiseAfter(denoiser, "3", small), 1.0 / 12 / 16) << denoiser;
    }
}

TEST_F(AoDenoise, NothingCrossesADepthStep) {
    const std::string onPlate = "    openness = depth < 14.5 ? 0.0 : 1.0;";
    for (const bool orthographic : {false, true}) {
        renderer_->setScene(plateScene());
        const View view = viewOf(plateCamera(orthographic), 81, 79);
        for (const char* denoiser : kEdgeAware) {
            for (const char* passes : {"1", "2", "3"}) {
                loadValues(onPlate, {{"denoiser", denoiser}, {"passes", passes}});
                const FloatMap made = map(view);
                EXPECT_EQ(made.min(), 0);
                EXPECT_EQ(made.max(), 1);
                EXPECT_LE(maxDifference(made, denoised(view)), 0.01f)
                    << denoiser << ", passes " << passes << (orthographic ? ", orthographic" : "");
            }
        }
        for (const char* denoiser : {"box", "gaussian"}) {
            loadValues(onPlate, {{"denoiser", denoiser}, {"passes", "1"}});
            EXPECT_GT(maxDifference(map(view), denoised(view)), 0.2f) << denoiser << " is meant to be blind to edges";
        }
    }
}

TEST_F(AoDenoise, SkyAndSurfacesBeforeItStayApart) {
    Scene scene = emptyScene();
    addBox(scene, {0, 0, -5}, {1, 1, 1});
    for (const char* denoiser : kDenoisers) {
        loadValues("    openness = depth > 1e6 ? 1.0 : 0.25;", {{"denoiser", denoiser}, {"passes", "3"}});
        renderer_->setScene(scene);
        const View view = viewOf(tiltCamera(0, false), 64, 48);
        const FloatMap depth = map(view, "viewDepth");
        const FloatMap result = denoised(view);
        ASSERT_GT(depth.max(), 1e8f);
        const bool edgeAware = std::string_view(denoiser) != "box" && std::string_view(denoiser) != "gaussian";
        for (std::size_t i = 0; i < depth.values.size(); ++i) {
            if (depth.values[i] > 1e6f) {
                ASSERT_EQ(result.values[i], 1) << denoiser;
            } else if (edgeAware) {
                ASSERT_NEAR(result.values[i], 0.25f, 0.01f) << denoiser;
            }
        }
    }
}

TEST_F(AoDenoise, WeightsDecideWhatCounts) {
    // Columns by turns: open and heavy, closed and light.
    const std::string stripes =
        "    bool heavy = (texel.x & 1) == 0;\n    openness = heavy ? 1.0 : 0.0;\n    weight = heavy ? 2.0 : 0.25;";
    for (const char* denoiser : kDenoisers) {
        loadValues(stripes, {{"denoiser", denoiser}, {"passes", "1"}});
        renderer_->setScene(tiltScene(0));
        EXPECT_GT(denoised(viewOf(tiltCamera(0, false), 64, 48)).mean(), 0.8) << denoiser;
    }
}

TEST_F(AoDenoise, MeanOfAWallAndItsFloorStays) {
    // The exact profile of a crease for a radius of 1, with noise; by rows, which are lines parallel to the wall.
    const std::string profile = R"(
    vec3 world = (cc_matViewInv * vec4(positionAt(pixelProjection(vec2(imageSize(viewDepth))), pixel, depth), 1.0)).xyz;
    float k = clamp(max(world.x, world.y), 0.0, 1.0);
    float open = 1.0 - (acos(k) - k * sqrt(1.0 - k * k)) / 3.14159265;
    openness = clamp(open, 0.3, 0.7) + 0.6 * (random - 0.5);)";
    for (const char* resolution : {"full", "half"}) {
        for (const char* denoiser : kDenoisers) {
            loadValues(profile, {{"denoiser", denoiser}, {"resolution", resolution}});
            renderer_->setScene(wallScene());
            const View view = viewOf(wallCamera(4), 128, 96);
            EXPECT_NEAR(map(view).mean(), denoised(view).mean(), 0.004) << denoiser << ", " << resolution;
        }
    }
}

TEST_F(AoDenoise, OptionsSayWhatRuns) {
    const View view = viewOf(wallCamera(4), 64, 64);
    const auto render = [&](const Options& options) {
        loadValues("    openness = random;", options);
        return denoised(view);
    };
    renderer_->setScene(busyScene());
    const FloatMap none = render({{"passes", "0"}});
    EXPECT_EQ(maxDifference(none, render({{"denoiser", "none"}, {"passes", "2"}})), 0);
    EXPECT_EQ(maxDifference(render({}), render({{"denoiser", "atrous"}, {"passes", "2"}})), 0);
    EXPECT_GT(maxDifference(render({}), render({{"passes", "1"}})), 0.01f);
    // Half resolution: upsampling is a pass.
    EXPECT_EQ(maxDifference(render({{"resolution", "half"}}), render({{"resolution", "half"}, {"passes", "1"}})), 0);
}

}  // namespace
}  // namespace crevice
