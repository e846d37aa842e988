// Pictures from hostile bytes: sizes are judged by the header, and any truncation or change ends in an Error or a
// picture, never otherwise.
#include "core/Picture.h"

#include <cstring>

#include <gtest/gtest.h>
#include <turbojpeg.h>
#include <webp/encode.h>

#include "core/Error.h"
#include "core/Exr.h"

namespace crevice {
namespace {

/// 4 x 3 pixels of different colours, opaque.
Image sample() {
    Image image(4, 3, Format::RGBA8);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = std::byte(i % 4 == 3 ? 255 : i * 5);
    return image;
}

std::vector<std::byte> takeBytes(const unsigned char* data, std::size_t size) {
    const auto* begin = reinterpret_cast<const std::byte*>(data);
    return {begin, begin + size};
}

std::vector<std::byte> encodeJpeg(const Image& image) {
    const tjhandle jpeg = tjInitCompress();
    unsigned char* data = nullptr;
    unsigned long size = 0;
    tjCompress2(jpeg, reinterpret_cast<const unsigned char*>(image.pixels.data()), int(image.width), 0,
                int(image.height), TJPF_RGBA, &data, &size, TJSAMP_444, 95, 0);
    const std::vector<std::byte> bytes = takeBytes(data, size);
    tjFree(data);
    tjDestroy(jpeg);
    return bytes;
}

std::vector<std::byte> encodeWebP(const Image& image) {
    std::uint8_t* data = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(reinterpret_cast<const std::uint8_t*>(image.pixels.data()),
                                                    int(image.width), int(image.height), int(image.width) * 4, &data);
    const std::vector<std::byte> bytes = takeBytes(data, size);
    WebPFree(data);
    return bytes;
}

std::string errorOf(std::span<const std::byte> bytes, const Limits& limits = {}) {
    try {
        decodePicture(bytes, "p", limits);
    } catch (const Error& error) {
        return formatError(error);
    }
    return "no error";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

void putBigEndian(std::vector<std::byte>& bytes, std::size_t at, std::uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes[at + i] = std::byte(value >> (24 - 8 * i) & 255);
}

TEST(Picture, LosslessKindsKeepTheirPixels) {
    EXPECT_EQ(decodePicture(encodePng(sample()), "p"), sample());
    EXPECT_EQ(decodePicture(encodeWebP(sample()), "p"), sample());
}

TEST(Picture, JpegIsNearlyTheSame) {
    const Image decoded = decodePicture(encodeJpeg(sample()), "p");
    ASSERT_EQ(decoded.pixels.size(), sample().pixels.size());
    for (std::size_t i = 0; i < decoded.pixels.size(); ++i)
        EXPECT_NEAR(std::to_integer<int>(decoded.pixels[i]), std::to_integer<int>(sample().pixels[i]), 24) << i;
}

TEST(Picture, HeadersSayTheSize) {
    for (const auto& bytes : {encodePng(sample()), encodeJpeg(sample()), encodeWebP(sample())}) {
        const auto header = readPictureHeader(bytes);
        ASSERT_TRUE(header);
        EXPECT_EQ(header->width, 4u);
        EXPECT_EQ(header->height, 3u);
    }
}

// ITU-T T.81, B.1.1.2: any number of bytes 0xff may stand before a marker. Comments are segments.
TEST(Picture, JpegsMayHaveAnyNumberOfFillBytesButNotOfSegments) {
    const std::vector<std::byte> plain = encodeJpeg(sample());
    const auto withStart = [&](std::size_t count, std::initializer_list<int> part) {
        std::vector<std::byte> bytes(plain.begin(), plain.begin() + 2);
        for (std::size_t i = 0; i < count; ++i)
            for (const int byte : part) bytes.push_back(std::byte(byte));
        bytes.insert(bytes.end(), plain.begin() + 2, plain.end());
        return bytes;
    };
    ASSERT_EQ(errorOf(withStart(5000, {0xff})), "no error");
    EXPECT_EQ(decodePicture(withStart(5000, {0xff}), "p"), decodePicture(plain, "p"));
    EXPECT_TRUE(readPictureHeader(withStart(1900, {0xff, 0xfe, 0, 2})));
    EXPECT_FALSE(readPictureHeader(withStart(2000, {0xff, 0xfe, 0, 2})));
}

// A few bytes that claim gigabytes are refused before a pixel is stored: by the limits, and where these are raised by
// what the bytes can hold.
TEST(Picture, BombsAreRefusedByTheirHeader) {
    std::vector<std::byte> bomb = encodePng(sample());
    putBigEndian(bomb, 16, 60000);
    putBigEndian(bomb, 20, 60000);
    EXPECT_TRUE(contains(errorOf(bomb), "60000 x 60000 pixels, the limit is 16384 a side")) << errorOf(bomb);
    EXPECT_TRUE(contains(errorOf(bomb), "--limit image-side=N"));
    EXPECT_TRUE(contains(errorOf(bomb, {.maxImageSide = 65536}), "--limit image-pixels=N"));
    const Limits generous{.maxImageSide = 65536, .maxImagePixels = std::size_t(1) << 40};
    EXPECT_TRUE(contains(errorOf(bomb, generous), "bytes cannot hold")) << errorOf(bomb, generous);
    putBigEndian(bomb, 16, 0);
    EXPECT_TRUE(contains(errorOf(bomb), "which is none"));
}

TEST(Picture, TruncationsAreErrors) {
    for (const auto& whole : {encodePng(sample()), encodeJpeg(sample()), encodeWebP(sample())})
        for (std::size_t length = 0; length + 16 < whole.size(); ++length)  // the last bytes may be an end mark
            EXPECT_NE(errorOf(std::span(whole).first(length)), "no error") << length << " of " << whole.size();
}

TEST(Picture, ChangedBytesDecodeOrAreRefused) {
    std::uint32_t state = 1;
    const auto random = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
    int refused = 0;
    for (const auto& whole : {encodePng(sample()), encodeJpeg(sample()), encodeWebP(sample())})
        for (int i = 0; i < 400; ++i) {
            std::vector<std::byte> bytes = whole;
            for (std::uint32_t n = random() % 3; n < 3; ++n) bytes[random() % bytes.size()] = std::byte(random() & 255);
            if (errorOf(bytes, {.maxImageSide = 512}) != "no error") ++refused;
        }
    EXPECT_GT(refused, 100);
}

TEST(Picture, ChangedExrBytesDecodeOrAreRefused) {
    std::uint32_t state = 2;
    const auto random = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
    const std::vector<std::byte> whole = encodeExr(sample());
    for (std::size_t length = 0; length < whole.size(); length += 3)
        EXPECT_THROW(decodeExr(std::span(whole).first(length), "p"), Error) << length;
    int refused = 0;
    for (int i = 0; i < 500; ++i) {
        std::vector<std::byte> bytes = whole;
        bytes[random() % bytes.size()] = std::byte(random() & 255);
        try {
            decodeExr(bytes, "p", {.maxImageSide = 512});
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace crevice
