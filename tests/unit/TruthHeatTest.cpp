// Colours of signed errors: what they say, and that they say it evenly.
#include "truth/ErrorHeat.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace crevice {
namespace {

/// CIE lightness L* of sRGB bytes, 0 … 100.
double lightness(const glm::u8vec3& color) {
    const auto linear = [](std::uint8_t byte) {
        const double x = byte / 255.0;
        return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    };
    const double y = 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
    return 116 * std::cbrt(y) - 16;
}

TEST(TruthHeat, RedIsTooBrightBlueTooDarkNoneIsNearWhite) {
    const glm::u8vec3 none = heatColor(0);
    EXPECT_GE(none.r, 240);
    EXPECT_LE(std::abs(none.r - none.g) + std::abs(none.g - none.b), 1);
    const glm::u8vec3 bright = heatColor(0.5f), dark = heatColor(-0.5f);
    EXPECT_GT(bright.r, 2 * bright.b);
    EXPECT_GT(dark.b, 2 * dark.r);
    // Beyond the range nothing changes; another range is another unit.
    EXPECT_EQ(heatColor(3), bright);
    EXPECT_EQ(heatColor(-3), dark);
    EXPECT_EQ(heatColor(0.1f, 0.1f), bright);
    EXPECT_EQ(heatColor(0.05f, 0.1f), heatColor(0.25f));
}

TEST(TruthHeat, LightnessFallsEvenlyAndAlikeOnBothSides) {
    for (int i = 1; i <= 20; ++i) {
        const float error = 0.025f * static_cast<float>(i);
        for (const float sign : {1.0f, -1.0f}) {
            const double step = lightness(heatColor(sign * (error - 0.025f))) - lightness(heatColor(sign * error));
            EXPECT_GT(step, 1) << sign * error;
            EXPECT_LT(step, 5) << sign * error;
        }
        EXPECT_NEAR(lightness(heatColor(error)), lightness(heatColor(-error)), 6) << error;
    }
}

TEST(TruthHeat, PicturesShowEachPixelsErrorAndGreyWhereNothingCounts) {
    const std::vector<float> map = {1, 0.25f, 0.5f, std::numeric_limits<float>::quiet_NaN(), 0.7f, 0.3f};
    const std::vector<float> truth = {1, 0.5f, 0.25f, 0.25f, 0.1f, 0.3f};
    const std::vector<std::uint8_t> counted = {1, 1, 1, 1, 0, 1};
    const Image image = errorHeat({3, 2}, map, truth, counted);
    const float errors[] = {0, -0.25f, 0.25f, -0.25f, 0, 0};
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::byte* p = image.pixel(i % 3, i / 3);
        const glm::u8vec3 found{std::uint8_t(p[0]), std::uint8_t(p[1]), std::uint8_t(p[2])};
        EXPECT_EQ(found, i == 4 ? glm::u8vec3(128) : heatColor(errors[i])) << i;
        EXPECT_EQ(p[3], std::byte{255});
    }
    // Without a mask all pixels count.
    EXPECT_NE(errorHeat({3, 2}, map, truth).pixels, image.pixels);
}

}  // namespace
}  // namespace crevice
