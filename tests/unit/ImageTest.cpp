// Images: the mapping to 8 bits, and round trips through PNG and EXR files.
#include "core/Image.h"

#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/Error.h"
#include "core/Exr.h"
#include "core/Files.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

class ImageFiles : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        root_ = fs::path(testing::TempDir()) / ("crevice-image-" + std::to_string(::getpid()) + "-" + info->name());
        fs::create_directories(root_);
    }
    void TearDown() override { fs::remove_all(root_); }

    Image throughPng(const Image& image) const {
        const fs::path path = root_ / "image.png";
        writeFileAtomically(path, encodePng(image));
        return readImage(path);
    }

    fs::path root_;
};

/// Bytes that neither repeat nor compress, the same on every machine.
Image makeNoise(std::uint32_t width, std::uint32_t height, Format format) {
    Image image(width, height, format);
    std::uint32_t state = 12345;
    for (std::byte& byte : image.pixels) {
        state = state * 1664525u + 1013904223u;  // Numerical Recipes' constants
        byte = static_cast<std::byte>(state >> 24);
    }
    return image;
}

Image makeFloats(Format format, std::initializer_list<float> values) {
    const auto channels = static_cast<std::size_t>(formatInfo(format).channels);
    Image image(static_cast<std::uint32_t>(values.size() / channels), 1, format);
    std::memcpy(image.pixels.data(), std::data(values), image.pixels.size());
    return image;
}

std::vector<int> bytesOf(const Image& image) {
    std::vector<int> bytes;
    for (const std::byte byte : image.pixels) bytes.push_back(std::to_integer<int>(byte));
    return bytes;
}

TEST(Image, PixelsAreRowsFromTopToBottom) {
    Image image(3, 2, Format::RG8);
    EXPECT_EQ(image.pixels.size(), 12u);
    *image.pixel(1, 1) = std::byte{255};
    EXPECT_EQ(image.pixels[8], std::byte{255});
    EXPECT_EQ(image.at(1, 1), glm::vec4(1, 0, 0, 1));
}

TEST(Image, EightBitsRoundHalfUpAndClamp) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInf = std::numeric_limits<float>::infinity();
    const Image image = makeFloats(Format::R32F, {0, 1, -1, 2, 0.5f, 0.25f, 0.001f, 0.002f, kNan, kInf, -kInf});
    const Image mapped = toEightBit(image, PngMapping::Clamp);
    EXPECT_EQ(mapped.format, Format::R8);
    EXPECT_EQ(bytesOf(mapped), (std::vector<int>{0, 255, 0, 255, 128, 64, 0, 1, 0, 255, 0}));
}

TEST(Image, EightBitsOfEightBitsAreTheSame) {
    const Image image = makeNoise(16, 16, Format::RGBA8_SRGB);
    const Image mapped = toEightBit(image, PngMapping::Clamp);
    EXPECT_EQ(mapped.format, Format::RGBA8);
    EXPECT_EQ(mapped.pixels, image.pixels);
}

TEST(Image, SignedValuesMoveToTheMiddleAndAlphaStays) {
    const Image image = makeFloats(Format::RGBA32F, {-1, 0, 1, 0.25f});
    EXPECT_EQ(bytesOf(toEightBit(image, PngMapping::Signed)), (std::vector<int>{0, 128, 255, 64}));
}

TEST(Image, DepthIsDividedByFar) {
    const Image image = makeFloats(Format::R32F, {0, 5, 10, 1e9f});
    EXPECT_EQ(bytesOf(toEightBit(image, PngMapping::DepthByFar, 10)), (std::vector<int>{0, 128, 255, 255}));
}

TEST(Image, ThreeChannelsBecomeFour) {
    const Image image(2, 1, Format::R11G11B10F);
    const Image mapped = toEightBit(image, PngMapping::Clamp);
    EXPECT_EQ(mapped.format, Format::RGBA8);
    EXPECT_EQ(bytesOf(mapped), (std::vector<int>{0, 0, 0, 255, 0, 0, 0, 255}));
}

TEST_F(ImageFiles, PngKeepsRgbaBytes) {
    const Image image = makeNoise(257, 131, Format::RGBA8);
    EXPECT_EQ(throughPng(image), image);
}

TEST_F(ImageFiles, PngKeepsSinglePixelsAndOpaqueImages) {
    Image image = makeNoise(1, 1, Format::RGBA8);
    EXPECT_EQ(throughPng(image), image);
    image = makeNoise(640, 360, Format::RGBA8);
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = std::byte{255};
    EXPECT_EQ(throughPng(image), image);
}

TEST_F(ImageFiles, PngKeepsLargeFlatImages) {
    Image image(2000, 1500, Format::RGBA8);
    for (std::byte& byte : image.pixels) byte = std::byte{200};
    EXPECT_EQ(throughPng(image), image);
    EXPECT_LT(encodePng(image).size(), image.pixels.size() / 50);
}

TEST(Png, OpaqueImagesAreStoredWithoutAlpha) {
    constexpr std::size_t kColorTypeAt = 25;  // after the signature, IHDR's head, width, height and bit depth
    Image image(4, 4, Format::RGBA8);
    EXPECT_EQ(encodePng(image).at(kColorTypeAt), std::byte{6});
    for (std::byte& byte : image.pixels) byte = std::byte{255};
    EXPECT_EQ(encodePng(image).at(kColorTypeAt), std::byte{2});
    EXPECT_EQ(encodePng(Image(4, 4, Format::R8)).at(kColorTypeAt), std::byte{0});
}

TEST_F(ImageFiles, PngOfOneAndTwoChannels) {
    const Image grey = makeNoise(33, 17, Format::R8);
    const Image readGrey = throughPng(grey);
    const Image pair = makeNoise(33, 17, Format::RG8);
    const Image readPair = throughPng(pair);
    for (std::uint32_t y = 0; y < 17; ++y) {
        for (std::uint32_t x = 0; x < 33; ++x) {
            const float v = grey.at(x, y).x;
            ASSERT_EQ(readGrey.at(x, y), glm::vec4(v, v, v, 1));
            ASSERT_EQ(readPair.at(x, y), pair.at(x, y));
        }
    }
}

TEST(Png, SamePixelsGiveSameBytes) {
    const Image image = makeNoise(100, 50, Format::RGBA8);
    EXPECT_EQ(encodePng(image), encodePng(image));
}

TEST_F(ImageFiles, ExrKeepsFloats) {
    const Image image = makeFloats(Format::RGBA32F, {1e30f, -2.5f, 0.1f, 1, 0, 65504, -0.0f, 0.5f});
    writeImage(root_ / "image.exr", image);
    EXPECT_EQ(readImage(root_ / "image.exr"), image);
}

TEST_F(ImageFiles, ExrKeepsOneTwoAndThreeChannels) {
    for (const Format format :
         {Format::R32F, Format::RG32F, Format::D32F, Format::R16F, Format::R8, Format::R11G11B10F}) {
        Image image(37, 19, format);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::byte>(i % 60);
        writeImage(root_ / "image.exr", image);
        const Image read = readImage(root_ / "image.exr");
        ASSERT_EQ(read.format, Format::RGBA32F);
        for (std::uint32_t y = 0; y < 19; ++y) {
            for (std::uint32_t x = 0; x < 37; ++x) ASSERT_EQ(read.at(x, y), image.at(x, y)) << formatInfo(format).name;
        }
    }
}

TEST_F(ImageFiles, TheEndingChoosesTheFormat) {
    const Image image = makeFloats(Format::R32F, {0.5f, 0.25f});
    writeImage(root_ / "a.PNG", image);
    EXPECT_EQ(readImage(root_ / "a.PNG").format, Format::RGBA8);
    EXPECT_THROW(writeImage(root_ / "a.jpg", image), Error);
    EXPECT_THROW(writeImage(root_ / "png", image), Error);
    EXPECT_FALSE(fs::exists(root_ / "a.jpg"));
}

TEST_F(ImageFiles, TheContentChoosesTheReader) {
    const Image image = makeNoise(5, 5, Format::RGBA8);
    writeFileAtomically(root_ / "wrong-ending.exr", encodePng(image));
    EXPECT_EQ(readImage(root_ / "wrong-ending.exr"), image);
    writeFileAtomically(root_ / "text.png", std::string_view("no image"));
    EXPECT_THROW(readImage(root_ / "text.png"), Error);
    EXPECT_THROW(readImage(root_ / "none.png"), Error);
}

TEST_F(ImageFiles, EveryCutPngIsRefused) {
    const std::vector<std::byte> whole = encodePng(makeNoise(9, 9, Format::RGBA8));
    // Without the last chunk (12 bytes) and the check sum before it (4) the picture is whole, and libspng reads it.
    for (std::size_t length = 0; length + 16 < whole.size(); ++length) {
        writeFileAtomically(root_ / "cut.png", std::span(whole).first(length));
        EXPECT_THROW(readImage(root_ / "cut.png"), Error) << length;
    }
}

TEST_F(ImageFiles, DamagedPngIsRefused) {
    std::vector<std::byte> bytes = encodePng(makeNoise(9, 9, Format::RGBA8));
    bytes[60] ^= std::byte{1};
    writeFileAtomically(root_ / "damaged.png", bytes);
    EXPECT_THROW(readImage(root_ / "damaged.png"), Error);
}

TEST_F(ImageFiles, CutExrIsRefused) {
    const std::vector<std::byte> whole = encodeExr(makeNoise(9, 9, Format::RGBA8));
    for (const std::size_t length : {std::size_t(4), std::size_t(8), std::size_t(40), whole.size() / 2}) {
        EXPECT_THROW(decodeExr(std::span(whole).first(length), "cut.exr"), Error) << length;
    }
}

}  // namespace
}  // namespace crevice
