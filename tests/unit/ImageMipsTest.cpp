// Mip levels made on the processor: exact means, linear light, sizes.
#include "core/ImageMips.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace crevice {
namespace {

Image filled(std::uint32_t width, std::uint32_t height, Format format, int value) {
    Image image(width, height, format);
    std::fill(image.pixels.begin(), image.pixels.end(), static_cast<std::byte>(value));
    return image;
}

TEST(ImageMips, EveryConstantStaysExactly) {
    for (const Format format : {Format::RGBA8, Format::RGBA8_SRGB}) {
        for (int value = 0; value < 256; ++value) {
            const std::vector<Image> levels = makeMips(filled(4, 2, format, value));
            ASSERT_EQ(levels.size(), 2u);
            EXPECT_EQ(levels[0], filled(2, 1, format, value)) << value;
            EXPECT_EQ(levels[1], filled(1, 1, format, value)) << value;
        }
    }
}

TEST(ImageMips, ColumnsAndRowsAreAveraged) {
    Image image(4, 4, Format::RGBA8);
    for (std::uint32_t y = 0; y < 4; ++y) {
        for (std::uint32_t x = 0; x < 4; ++x) std::fill_n(image.pixel(x, y), 4, static_cast<std::byte>(16 * y + 4 * x));
    }
    const Image half = makeMips(image).front();
    EXPECT_EQ(std::to_integer<int>(*half.pixel(0, 0)), 10);
    EXPECT_EQ(std::to_integer<int>(*half.pixel(1, 0)), 18);
    EXPECT_EQ(std::to_integer<int>(*half.pixel(0, 1)), 42);
}

TEST(ImageMips, SizesAreHalvedDownToOneTexel) {
    const std::vector<Image> levels = makeMips(filled(5, 3, Format::RGBA8, 9));
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_EQ(levels[0].width, 2u);
    EXPECT_EQ(levels[0].height, 1u);
    EXPECT_EQ(levels[1].width, 1u);
    EXPECT_TRUE(makeMips(filled(1, 1, Format::RGBA8, 9)).empty());
    EXPECT_EQ(makeMips(filled(1, 8, Format::RGBA8_SRGB, 9)).size(), 3u);
}

}  // namespace
}  // namespace crevice
