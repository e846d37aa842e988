// Metrics of neighbourhoods on pictures that can be followed by hand.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "truth/AmbientReference.h"
#include "truth/PictureMetrics.h"

namespace crevice {
namespace {

Camera camera90() {
    Camera camera;
    camera.fovY = 1.5707963f;  // a picture of height h at depth 1 is 2 high
    return camera;
}

/// A picture by a function of the pixel.
template <class Value>
std::vector<float> picture(const glm::uvec2& size, Value&& value) {
    std::vector<float> values;
    for (std::uint32_t y = 0; y < size.y; ++y)
        for (std::uint32_t x = 0; x < size.x; ++x) values.push_back(static_cast<float>(value(int(x), int(y))));
    return values;
}

TEST(TruthPicture, SsimOfConstants) {
    const glm::uvec2 size(16, 9);
    const auto flat = [&](float v) { return picture(size, [v](int, int) { return v; }); };
    EXPECT_NEAR(structuralSimilarity(size, flat(0.5f), flat(0.5f)), 1, 1e-12);
    // Without variance the second factor is 1: (2ab + C1) / (a² + b² + C1), C1 = 1e-4
    EXPECT_NEAR(structuralSimilarity(size, flat(0.25f), flat(0.75f)), (0.375 + 1e-4) / (0.625 + 1e-4), 1e-6);
    EXPECT_EQ(structuralSimilarity(size, flat(0.2f), flat(0.7f), std::vector<std::uint8_t>(16 * 9, 0)), 1.0);
}

// Two pixels side by side, of which the window is exp(0) and exp(-1 / 4.5): weights p and q, p + q = 1. For maps 0, 1
// and 1, 0 the first window has means q and p, variances and minus the covariance pq; the second mirrors it.
TEST(TruthPicture, SsimOfTwoPixels) {
    const double w = std::exp(-1 / 4.5), p = 1 / (1 + w), q = w / (1 + w);
    const double expected = (2 * p * q + 1e-4) * (-2 * p * q + 9e-4) / ((p * p + q * q + 1e-4) * (2 * p * q + 9e-4));
    const std::vector<float> a = {0, 1}, b = {1, 0};
    EXPECT_NEAR(structuralSimilarity({2, 1}, a, b), expected, 1e-9);
    EXPECT_NEAR(structuralSimilarity({1, 2}, a, b), expected, 1e-9);
    EXPECT_LT(expected, -0.4);
    // What does not count is not seen: the second pixel alone is 0 against 0.
    const std::vector<float> c = {std::numeric_limits<float>::quiet_NaN(), 0};
    EXPECT_NEAR(structuralSimilarity({2, 1}, c, b, std::vector<std::uint8_t>{0, 1}), 1, 1e-12);
}

// 11x11 and no farther: a pixel six away from a lone dot knows nothing of it.
TEST(TruthPicture, SsimWindow) {
    const glm::uvec2 size(23, 1);
    const auto zero = picture(size, [](int, int) { return 0; });
    const auto dot = picture(size, [](int x, int) { return x == 11; });
    std::vector<std::uint8_t> mask(23, 1);
    double touched = 0;
    for (int x = 0; x < 23; ++x) {
        // The mean over one more pixel each time: 1 until the window reaches the dot.
        std::vector<float> part(zero), other(zero);
        part[static_cast<std::size_t>(x)] = 1;
        const double all = structuralSimilarity(size, part, other);
        EXPECT_LT(all, 1);
        touched += all;
    }
    EXPECT_LT(touched, 23);
    const double whole = structuralSimilarity(size, dot, zero);
    double sum = 0;
    for (int offset = -5; offset <= 5; ++offset) {
        double weight = 0;
        for (int i = -5; i <= 5; ++i) weight += std::exp(-0.5 * i * i / 2.25);
        const double mean = std::exp(-0.5 * offset * offset / 2.25) / weight, variance = mean - mean * mean;
        sum += 1e-4 * 9e-4 / ((mean * mean + 1e-4) * (variance + 9e-4));
    }
    EXPECT_NEAR(whole, (sum + 12) / 23, 1e-6);
}

TEST(TruthPicture, FitAndNoiseCorrection) {
    // t = .5 a + .2 exactly; σt √(1 - r²) = 0.
    const std::vector<float> map = {0.0f, 0.4f, 0.8f, 1.0f}, truth = {0.2f, 0.4f, 0.6f, 0.7f};
    const MapMetrics exact = measureMap(map, truth);
    EXPECT_NEAR(exact.slope, 0.5, 1e-6);
    EXPECT_NEAR(exact.offset, 0.2, 1e-6);
    EXPECT_NEAR(exact.fitRmse, 0, 1e-6);
    // Map 0 0 1 1, truth .1 .3 .5 .9: slope (.7 - .2) / 1, offset .2; rests -.1 .1 -.2 .2.
    const MapMetrics m = measureMap(std::vector<float>{0, 0, 1, 1}, std::vector<float>{0.1f, 0.3f, 0.5f, 0.9f});
    EXPECT_NEAR(m.slope, 0.5, 1e-6);
    EXPECT_NEAR(m.offset, 0.2, 1e-6);
    EXPECT_NEAR(m.fitRmse, std::sqrt(0.1 / 4), 1e-6);
    EXPECT_NEAR(m.white, std::sqrt((0.81 + 0.49 + 0.25 + 0.01) / 4), 1e-6);
    const MapMetrics flat = measureMap(std::vector<float>{1, 1}, std::vector<float>{0.2f, 0.6f});
    EXPECT_EQ(flat.slope, 0.0);
    EXPECT_NEAR(flat.offset, 0.4, 1e-6);
    EXPECT_NEAR(flat.fitRmse, 0.2, 1e-6);
    EXPECT_NEAR(noiseCorrected(0.05, 0.03), 0.04, 1e-12);
    EXPECT_EQ(noiseCorrected(0.02, 0.03), 0.0);
}

// The truth varies by 0.2 and is known to 0.12: of its variance of 0.04, 0.0144 is noise, and its reliability is 0.64.
TEST(TruthPicture, NoiseOfTheTruthIsTakenOff) {
    MapMetrics m;
    m.rmse = 0.13;
    m.white = 0.2;
    m.fitRmse = 0.12;
    m.correlation = 0.6;
    m.truthVariance = 0.04;
    m.skill = 1 - 0.13 * 0.13 / 0.04;
    m.bias = 0.01;
    takeNoiseOff(m, 0.12);
    EXPECT_NEAR(m.rmse, 0.05, 1e-12);
    EXPECT_NEAR(m.white, 0.16, 1e-12);
    EXPECT_EQ(m.fitRmse, 0.0);
    EXPECT_NEAR(m.ofWhite, 0.3125, 1e-12);
    EXPECT_NEAR(m.truthVariance, 0.0256, 1e-12);
    EXPECT_NEAR(m.skill, 1 - 0.0025 / 0.0256, 1e-12);
    EXPECT_NEAR(m.correlation, 0.75, 1e-12);  // 0.6 / √0.64
    EXPECT_EQ(m.bias, 0.01);
    m.correlation = -0.9;
    takeNoiseOff(m, 0.13);
    EXPECT_EQ(m.correlation, -1.0) << "a sample may exceed what is possible";
    // Nothing but noise: nothing to divide by.
    m.correlation = 0.3;
    m.skill = -2;
    takeNoiseOff(m, 0.5);
    EXPECT_EQ(m.correlation, 0.3);
    EXPECT_EQ(m.skill, -2);
}

TEST(TruthPicture, CorrelationWithANoisyTruthIsThatWithTheTrueOne) {
    // ±0.1 of noise on every value of the truth, once up and once down: independent of map and truth.
    std::vector<float> map, truth, noisy;
    for (int i = 0; i < 8; ++i) {
        for (const float noise : {-0.1f, 0.1f}) {
            map.push_back(0.1f * static_cast<float>((5 * i) % 8));
            truth.push_back(0.1f * static_cast<float>(i));
            noisy.push_back(truth.back() + noise);
        }
    }
    MapMetrics measured = measureMap(map, noisy);
    const MapMetrics wanted = measureMap(map, truth);
    EXPECT_LT(std::abs(measured.correlation), std::abs(wanted.correlation) - 0.01);
    takeNoiseOff(measured, 0.1);
    EXPECT_NEAR(measured.correlation, wanted.correlation, 1e-6);
    EXPECT_NEAR(measured.skill, wanted.skill, 1e-5);
    EXPECT_NEAR(measured.rmse, wanted.rmse, 1e-6);
    EXPECT_NEAR(measured.truthVariance, wanted.truthVariance, 1e-6);
}

// A wall of depth 2 whose right half stands at 4; then a floor that runs away; then the sky.
TEST(TruthPicture, DepthEdges) {
    const glm::uvec2 size(20, 6);
    const auto edgesOf = [&](const std::vector<float>& depth, const Camera& camera) {
        return findDepthEdges(size, depth, camera);
    };
    const auto step = edgesOf(picture(size, [](int x, int) { return x < 10 ? 2 : 4; }), camera90());
    for (int x = 0; x < 20; ++x) EXPECT_EQ(step[static_cast<std::size_t>(x)], x == 9 || x == 10) << x;
    // A plane: 1/z falls evenly, by more than 2 % of itself from row to row.
    const auto plane = edgesOf(picture(size, [](int, int y) { return 1 / (0.7 - 0.1 * y); }), camera90());
    EXPECT_EQ(std::count(plane.begin(), plane.end(), 1), 0);
    // A crease has none: two planes that meet.
    const auto crease =
        edgesOf(picture(size, [](int x, int) { return 1 / (0.5 - 0.02 * std::abs(x - 10)); }), camera90());
    EXPECT_EQ(std::count(crease.begin(), crease.end(), 1), 0);
    const auto sky = edgesOf(picture(size, [](int x, int) { return x < 5 ? 3.0f : kSkyViewDepth; }), camera90());
    for (int x = 0; x < 20; ++x) EXPECT_EQ(sky[static_cast<std::size_t>(x)], x == 4 || x == 5) << x;
    Camera parallel;
    parallel.orthographic = true;
    parallel.orthoHeight = 10;  // tolerance .2
    const auto small = edgesOf(picture(size, [](int x, int) { return x < 10 ? 100.0 : 100.19; }), parallel);
    EXPECT_EQ(std::count(small.begin(), small.end(), 1), 0);
    const auto large = edgesOf(picture(size, [](int x, int) { return x < 10 ? 100.0 : 100.21; }), parallel);
    EXPECT_EQ(std::count(large.begin(), large.end(), 1), 12);
}

TEST(TruthPicture, ProjectedPixels) {
    EXPECT_NEAR(projectedPixels(camera90(), {200, 100}, 1, 5), 10, 1e-4);
    Camera parallel;
    parallel.orthographic = true;
    parallel.orthoHeight = 4;
    EXPECT_NEAR(projectedPixels(parallel, {200, 100}, 1, 5), 25, 1e-4);
}

// 24x12 pixels, depth 1 but for 2 from column 12 on. Truth .8 but for .3 in columns 0 and 1. The map errs by .1 in
// columns 0 and 1, by .2 in columns 8 to 15, by nothing else.
TEST(TruthPicture, Regions) {
    const glm::uvec2 size(24, 12);
    const auto truth = picture(size, [](int x, int) { return x < 2 ? 0.3 : 0.8; });
    const auto map = picture(size, [](int x, int) { return x < 2 ? 0.4 : x >= 8 && x < 16 ? 1.0 : 0.8; });
    const auto depth = picture(size, [](int x, int) { return x < 12 ? 1 : 2; });
    PictureInput input{.size = size,
                       .map = map,
                       .truth = truth,
                       .isCounted = {},
                       .viewDepth = depth,
                       .camera = camera90(),
                       .radius = 0.2f};
    const PictureMetrics m = measurePicture(input);
    EXPECT_EQ(m.all.count, 288u);
    EXPECT_EQ(m.contact.count, 24u);
    EXPECT_NEAR(m.contact.rmse, 0.1, 1e-6);
    EXPECT_EQ(m.edge.count, 8u * 12);  // columns 8 to 15: four on each side
    EXPECT_NEAR(m.edge.rmse, 0.2, 1e-6);
    // The radius appears as 1.2 pixels at depth 1 and .6 at depth 2: rows 0 and 11, columns 0 and 23, whose centres are
    // .5 pixels from the border.
    EXPECT_EQ(m.border.count, 2u * 24 + 2 * 10);
    EXPECT_NEAR(m.border.rmse, std::sqrt((14 * 0.01 + 2 * 8 * 0.04) / 68), 1e-6);  // 12 + 2 of .1, 16 of .2
    std::vector<std::uint8_t> mask(288, 1);
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = i % 24 != 0;
    input.isCounted = mask;
    EXPECT_EQ(measurePicture(input).contact.count, 12u);
    input.viewDepth = {};
    EXPECT_EQ(measurePicture(input).edge.count, 0u);
    EXPECT_EQ(measurePicture(input).border.count, 0u);
}

// Noise is what single pixels are off their 5x5 median; ramps, edges of the truth and depth edges are none.
TEST(TruthPicture, Noise) {
    const glm::uvec2 size(24, 12);
    const auto truth = picture(size, [](int, int) { return 0.5; });
    const auto noiseOf = [&](const std::vector<float>& map, const std::vector<float>& target) {
        return measurePicture({.size = size,
                               .map = map,
                               .truth = target,
                               .isCounted = {},
                               .viewDepth = {},
                               .camera = camera90(),
                               .radius = 0});
    };
    const PictureMetrics still = noiseOf(truth, truth);
    EXPECT_EQ(still.flatCount, 20u * 8);
    EXPECT_EQ(still.noise, 0.0);
    // Every fourth pixel of every third row is .2 brighter: in 5x5 never more than 4, the median stays. Of the 20x8
    // flat pixels x = 4, 8 … 20 and y = 3, 6, 9 are: 5 · 3 = 15 of 160.
    const auto dots = noiseOf(picture(size, [](int x, int y) { return x % 4 == 0 && y % 3 == 0 ? 0.7 : 0.5; }), truth);
    const double share = 15.0 / 160;
    EXPECT_NEAR(dots.noise, 0.2 * std::sqrt(share - share * share), 1e-6);
    EXPECT_NEAR(noiseOf(picture(size, [](int x, int) { return 0.02 * x; }), truth).noise, 0, 1e-6);
    // A step of the truth by .2 between columns 11 and 12: windows across it are not flat.
    const auto edge = picture(size, [](int x, int) { return x < 12 ? 0.4 : 0.6; });
    EXPECT_EQ(noiseOf(truth, edge).flatCount, 16u * 8);
}

}  // namespace
}  // namespace crevice
