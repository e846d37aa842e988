// Metrics on numbers that can be followed by hand.
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "truth/Metrics.h"

namespace crevice {
namespace {

// Errors .1, -.3, 0, .2; both means are .5.
TEST(TruthMetrics, OfFourValues) {
    const std::vector<float> truth = {0.2f, 0.4f, 0.6f, 0.8f};
    const std::vector<float> map = {0.3f, 0.1f, 0.6f, 1.0f};
    const MapMetrics m = measureMap(map, truth);
    EXPECT_EQ(m.count, 4u);
    EXPECT_NEAR(m.rmse, std::sqrt((0.01 + 0.09 + 0 + 0.04) / 4), 1e-7);
    EXPECT_NEAR(m.mae, 0.15, 1e-7);
    EXPECT_NEAR(m.bias, 0.0, 1e-7);
    EXPECT_NEAR(m.p95, 0.3, 1e-7);
    // (-.3)(-.2) + (-.1)(-.4) + (.1)(.1) + (.3)(.5) = .26; squares .2 and .46
    EXPECT_NEAR(m.correlation, 0.26 / std::sqrt(0.2 * 0.46), 1e-6);
    EXPECT_NEAR(m.skill, 1 - 0.035 / 0.05, 1e-6);
    EXPECT_NEAR(m.ofWhite, std::sqrt(0.035 / ((0.64 + 0.36 + 0.16 + 0.04) / 4)), 1e-6);
}

TEST(TruthMetrics, MaskedValuesTakeNoPart) {
    const std::vector<float> truth = {0.5f, 1.0f, 0.25f, 1.0f}, map = {0.5f, 0.0f, 0.5f, 0.3f};
    const MapMetrics m = measureMap(map, truth, std::vector<std::uint8_t>{1, 0, 1, 0});
    EXPECT_EQ(m.count, 2u);
    EXPECT_NEAR(m.rmse, std::sqrt(0.0625 / 2), 1e-7);
    EXPECT_NEAR(m.bias, 0.125, 1e-7);
    const MapMetrics none = measureMap(map, truth, std::vector<std::uint8_t>(4, 0));
    EXPECT_EQ(none.count, 0u);
    EXPECT_EQ(none.rmse, 0.0);
}

TEST(TruthMetrics, OfWhiteAndOfTheTruthItself) {
    const std::vector<float> truth = {0.1f, 0.9f, 0.4f};
    EXPECT_NEAR(measureMap(std::vector<float>(3, 1.0f), truth).ofWhite, 1, 1e-12);
    const MapMetrics same = measureMap(truth, truth);
    EXPECT_EQ(same.rmse, 0.0);
    EXPECT_NEAR(same.correlation, 1, 1e-12);
    EXPECT_EQ(same.skill, 1.0);
    std::vector<float> inverse;
    for (const float t : truth) inverse.push_back(1 - t);
    EXPECT_NEAR(measureMap(inverse, truth).correlation, -1, 1e-6);
}

TEST(TruthMetrics, ConstantsAndBrokenValues) {
    const std::vector<float> white(3, 1.0f), grey(3, 0.5f);
    const MapMetrics m = measureMap(grey, white);
    EXPECT_EQ(m.correlation, 0.0);
    EXPECT_EQ(m.skill, 0.0);
    EXPECT_EQ(m.ofWhite, 0.0);
    EXPECT_NEAR(m.bias, -0.5, 1e-12);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NEAR(measureMap(std::vector<float>{nan}, std::vector<float>{1.0f}).rmse, 1, 1e-12);
}

// Ranks, not interpolation: of 40 errors 1 … 40, 38 do not exceed 38.
TEST(TruthMetrics, PercentileIsAnErrorThatOccurs) {
    std::vector<float> map, truth(40, 0.0f);
    for (int i = 40; i >= 1; --i) map.push_back(static_cast<float>(i));
    EXPECT_EQ(measureMap(map, truth).p95, 38.0);
}

}  // namespace
}  // namespace crevice
