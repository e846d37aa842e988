// cocos in ao-deferred: its article form is that of ssao-deferred with the blur written out, and tends to what its
// kernel must tend to; the default form has the options of all kernel techniques. Faults C1 to C15: AoFaultTest.
#include "AoKernelFixture.h"

namespace crevice {
namespace {

using AoCocos = AoKernelTest;

Scene boxOnFloor() {
    Scene scene = wallScene();
    addBox(scene, {0.9f, 0.4f, 0.2f}, {0.7f, 0.8f, 0.6f});
    return scene;
}

View boxView() { return viewOf(wallCamera(3), 72, 54); }

TEST_F(AoCocos, ArticleIsThatOfSsaoDeferred) {
    const FloatMap here = rawMap("cocos", "article", boxOnFloor(), boxView());
    load("ssao-deferred", {{"form", "article"}}, {{"cc_ssaoMap.format", "R32F"}, {"SsaoStage.material.radius", "1"}});
    renderer_->setScene(boxOnFloor());
    const FloatMap there = map(boxView());
    EXPECT_EQ(here.values, there.values);
    EXPECT_LT(here.mean(), 0.95);
}

TEST_F(AoCocos, ArticleBlurIsAFiveByFiveGaussianThreePixelsApart) {
    constexpr int kKernel[25] = {1, 4, 7, 4, 1, 4, 16, 26, 16, 4, 7, 26, 41, 26, 7, 4, 16, 26, 16, 4, 1, 4, 7, 4, 1};
    loadTechnique("cocos", "article", {{"cc_ssaoBlurMap.format", "R32F"}});
    renderer_->setScene(boxOnFloor());
    const FloatMap raw = map(boxView());
    const FloatMap blurred = map(boxView(), "cc_ssaoBlurMap");
    for (int y = 0; y < 54; ++y) {
        for (int x = 0; x < 72; ++x) {
            double sum = 0;
            for (int i = 0; i < 25; ++i) {
                const int tapX = std::clamp(x + 3 * (i % 5 - 2), 0, 71);
                const int tapY = std::clamp(y + 3 * (i / 5 - 2), 0, 53);
                sum += kKernel[i] * double(raw.at(tapX, tapY)) / 273.0;
            }
            ASSERT_NEAR(blurred.at(x, y), sum, 1e-4) << x << ' ' << y;
        }
    }
    EXPECT_TRUE(reads("LightingStage", "cc_ssaoBlurMap"));
}

TEST_F(AoCocos, ArticleTendsToTheLimitOfItsKernel) {
    // ambient-occlusion by points with the article's lengths, beside a wall: computed once by integration. The bias of
    // a pixel's own texel is the article's, too (C3): it takes a little off.
    const std::vector<float> distances = {0.1f, 0.2f, 0.3f, 0.5f};
    const std::vector<double> limits = {0.696, 0.810, 0.875, 0.953};
    const std::vector<double> article = besideWall("cocos", "article", distances, {}, 10);
    const std::vector<double> remedied = besideWall("cocos", "ultra", distances, {}, 3);
    for (std::size_t i = 0; i < distances.size(); ++i) {
        EXPECT_NEAR(article[i], limits[i], 0.02) << distances[i];
        // Too bright by construction; the default form is not.
        EXPECT_GT(article[i], exactWall(distances[i]) + 0.1) << distances[i];
        EXPECT_NEAR(remedied[i], exactWall(distances[i]), 0.06) << distances[i];
    }
}

TEST_F(AoCocos, KernelArticleTakesTheTechniquesOwnDirections) {
    const FloatMap cosine = rawMap("cocos", "high", boxOnFloor(), boxView());
    const FloatMap own = rawMap("cocos", "high", boxOnFloor(), boxView(), {}, {{"kernel", "article"}});
    EXPECT_EQ(stage("AoMain").desc->params.find("rayPoints")->number(), 0);
    // Points see less of what a ray meets.
    EXPECT_GT(own.mean(), cosine.mean() + 0.01);
    EXPECT_LT(own.min(), 0.9f);
}

TEST_F(AoCocos, RangeCheckDecidesWhatIsFarInFront) {
    // A plate half a radius and eight radii in front of a wall, beside its silhouette.
    const View view = viewOf(parallelAlongZ(4), 64, 48);
    const auto darkest = [&](const std::string& check, float gap) {
        const FloatMap ao = rawMap("cocos", "high", halfPlate(gap), view, {}, {{"rangeCheck", check}});
        double sum = 0;
        for (std::uint32_t y = 0; y < 48; ++y) sum += (1 - ao.at(32, y)) / 48;
        return sum;
    };
    EXPECT_GT(darkest("off", 8), 0.3);
    EXPECT_EQ(darkest("hard", 8), 0);
    EXPECT_EQ(darkest("compact", 8), 0);
    // smoothstep(0.4 / 7 to 8): never quite nothing.
    EXPECT_GT(darkest("smooth", 8), 0.002);
    EXPECT_LT(darkest("smooth", 8), 0.02);
    // What touches occludes with each of them.
    for (const char* check : {"off", "hard", "compact", "smooth"}) EXPECT_GT(darkest(check, 0.5f), 0.1) << check;
}

TEST_F(AoCocos, BackFacesSayHowDeepThingsAre) {
    // A bar of 1/16 before a wall hides next to nothing behind itself; one of 1/2 that stands on the wall hides as
    // before.
    const View view = viewOf(parallelAlongZ(4), 64, 48);
    const auto darkness = [&](float depth, float centre, const Options& options) {
        Scene scene = emptyScene();
        scene.materials[0].doubleSided = false;
        addSquare(scene, {0, 0, 0}, {0, 0, 1}, 40);
        addBox(scene, {0, 0, centre}, {0.3f, 20, depth});
        const FloatMap ao = rawMap("cocos", "ultra", scene, view, {}, options);
        double sum = 0;
        for (std::uint32_t y = 0; y < 48; ++y)
            for (std::uint32_t x = 36; x < 46; ++x) sum += (1 - ao.at(x, y)) / 480;
        return sum;
    };
    const double endless = darkness(0.0625f, 0.5f, {{"rangeCheck", "off"}});
    const double guessed = darkness(0.0625f, 0.5f, {});
    const double known = darkness(0.0625f, 0.5f, {{"backFaces", "true"}});
    EXPECT_GT(endless, 0.08);
    EXPECT_LT(guessed, endless - 0.02);
    EXPECT_LT(known, guessed - 0.02);
    EXPECT_GT(known, 0);
    EXPECT_NEAR(darkness(0.5f, 0.25f, {{"backFaces", "true"}}), darkness(0.5f, 0.25f, {{"rangeCheck", "off"}}), 0.02);
    EXPECT_GT(darkness(0.5f, 0.25f, {{"backFaces", "true"}}), 0.1);
}

/// Variance of a row where the frame's sides are more than a radius away.
double innerVariance(const FloatMap& ao, std::uint32_t row) {
    double sum = 0, squares = 0;
    for (std::uint32_t x = 32; x < 96; ++x)
        sum += ao.at(x, row) / 64.0, squares += ao.at(x, row) * ao.at(x, row) / 64.0;
    return squares - sum * sum;
}

TEST_F(AoCocos, TileOfOnePixelBandsAndOthersRepeat) {
    const View view = viewOf(wallCamera(kWallHeight), 128, 96);
    for (std::uint32_t tile : {1u, 2u, 4u, 8u}) {
        const FloatMap ao =
            rawMap("cocos", "high", wallScene(), view, {}, {{"pattern", "tile" + std::to_string(tile)}});
        // Along a line parallel to the wall nothing but the noise differs.
        for (std::uint32_t x = 40; x < 90; ++x) ASSERT_NEAR(ao.at(x, 54), ao.at(x - tile, 54), 1e-4f) << tile;
        if (tile == 1) {
            EXPECT_LT(innerVariance(ao, 54), 1e-8);
        } else if (tile > 2) {  // two turns of half a circle may see the same
            EXPECT_GT(innerVariance(ao, 54), 1e-5) << tile;
        }
    }
}

TEST_F(AoCocos, SeedTurnsTheNoiseAndTurnsConverge) {
    const View view = viewOf(wallCamera(kWallHeight), 128, 96);
    const FloatMap zero = rawMap("cocos", "high", wallScene(), view);
    const FloatMap one = rawMap("cocos", "high", wallScene(), view, {}, {{"seed", "1"}});
    EXPECT_NE(zero.values, one.values);
    EXPECT_NEAR(zero.mean(), one.mean(), 0.005);
    // Sixteen turns of the kernel leave a small part of the noise.
    const FloatMap reference = rawMap("cocos", "reference", wallScene(), view);
    EXPECT_LT(innerVariance(reference, 54), 0.02 * innerVariance(zero, 54));
    EXPECT_NEAR(reference.mean(), zero.mean(), 0.02);
}

}  // namespace
}  // namespace crevice
