// Near names, lists, and the table of pixel formats.
#include "core/Text.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "core/Format.h"

namespace crevice {
namespace {

const std::vector<std::string> kKeys = {"format", "scale", "size", "like", "clear", "sampler"};

TEST(Text, NearestNamesPutsTheNearestFirst) {
    EXPECT_EQ(nearestNames("formt", kKeys), std::vector<std::string>{"format"});
    EXPECT_EQ(nearestNames("sclae", kKeys).front(), "scale");
    EXPECT_EQ(nearestNames("FORMAT", kKeys), std::vector<std::string>{"format"});
    EXPECT_TRUE(nearestNames("persistent", kKeys).empty());
    EXPECT_TRUE(nearestNames("", kKeys).empty());
}

TEST(Text, BeginningsOfNamesAreNearWhereNothingElseIs) {
    const std::vector<std::string> classes = {"ShadowStage", "SsaoStage", "SsaoBlurStage", "SsaoX"};
    EXPECT_EQ(nearestNames("shadow", classes), std::vector<std::string>{"ShadowStage"});
    EXPECT_EQ(nearestNames("Ssao", classes), std::vector<std::string>{"SsaoX"});
    EXPECT_EQ(nearestNames("SsaoB", classes, 1), std::vector<std::string>{"SsaoX"}) << "edits go first";
    EXPECT_TRUE(nearestNames("Sh", classes).empty()) << "too short";
    EXPECT_TRUE(nearestNames("Stage", classes).empty()) << "an end is no beginning";
}

TEST(Text, NearestNamesKeepsTheLimit) {
    EXPECT_EQ(nearestNames("aaaa", {"aaab", "aaac", "aaad", "aaae"}, 2), (std::vector<std::string>{"aaab", "aaac"}));
}

TEST(Text, NamesWithNothingInCommonAreNotNear) { EXPECT_TRUE(nearestNames("ab", {"xy"}).empty()); }

TEST(Text, HugeNamesAreNotCompared) {
    EXPECT_TRUE(nearestNames(std::string(1'000'000, 'a'), {std::string(900'000, 'a')}).empty());
}

TEST(Text, DidYouMean) {
    EXPECT_EQ(didYouMean("formt", {"format", "scale"}, "keys"), "did you mean 'format'? keys: format, scale");
    EXPECT_EQ(didYouMean("zzzzz", {"format", "scale"}, "keys"), "keys: format, scale");
    EXPECT_EQ(didYouMean("x", {}, "keys"), "there are no keys to choose from");
    EXPECT_EQ(didYouMean("siz", {"size", "site"}, "keys"), "did you mean 'size' or 'site'? keys: size, site");
}

TEST(Text, DidYouMeanCutsLongLists) {
    const std::vector<std::string> many(100, "name");
    const std::string text = didYouMean("zzzzzzzz", many, "keys");
    EXPECT_TRUE(text.ends_with(", … (40 more)")) << text;
}

TEST(Text, Join) {
    EXPECT_EQ(join({"a", "b", "c"}), "a, b, c");
    EXPECT_EQ(join({"a", "a"}, " | "), "a | a");
    EXPECT_EQ(join({}), "");
}

template <class T>
glm::vec4 decode(Format format, std::initializer_list<T> raw) {
    std::byte bytes[16] = {};
    std::memcpy(bytes, std::data(raw), raw.size() * sizeof(T));
    return decodePixel(format, bytes);
}

TEST(Format, NamesGoBothWays) {
    EXPECT_EQ(allFormats().size(), 16u);
    for (const FormatInfo& info : allFormats()) {
        EXPECT_EQ(formatFromName(info.name), info.format);
        EXPECT_EQ(&formatInfo(info.format), &info);
        EXPECT_GE(info.bytesPerPixel, info.channels == 3 ? 4 : info.channels);
    }
    EXPECT_FALSE(formatFromName("r8"));
    EXPECT_FALSE(formatFromName(""));
}

TEST(Format, DecodesIntegers) {
    EXPECT_EQ(decode<std::uint8_t>(Format::R8, {51}), glm::vec4(0.2f, 0, 0, 1));
    EXPECT_EQ(decode<std::uint8_t>(Format::RG8, {0, 255}), glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(decode<std::uint8_t>(Format::RGBA8, {255, 0, 51, 0}), glm::vec4(1, 0, 0.2f, 0));
    EXPECT_EQ(decode<std::uint8_t>(Format::RGBA8_SRGB, {51, 51, 51, 255}), glm::vec4(0.2f, 0.2f, 0.2f, 1));
    EXPECT_EQ(decode<std::uint16_t>(Format::RG16, {65535, 13107}), glm::vec4(1, 0.2f, 0, 1));
    EXPECT_EQ(decode<std::uint32_t>(Format::R32UI, {70000}), glm::vec4(70000, 0, 0, 1));
}

TEST(Format, DecodesHalves) {
    EXPECT_EQ(decode<std::uint16_t>(Format::RGBA16F, {0x3c00, 0xc000, 0x3555, 0x7bff}),
              glm::vec4(1, -2, 0.333251953125f, 65504));
    EXPECT_EQ(decode<std::uint16_t>(Format::R16F, {0x0001}).x, std::ldexp(1.0f, -24));
    EXPECT_TRUE(std::isinf(decode<std::uint16_t>(Format::R16F, {0x7c00}).x));
}

TEST(Format, DecodesPackedFloats) {
    // 1.0 has exponent 15 and mantissa 0: 15 << 6 in 11 bits, 15 << 5 in 10 bits; 0.5 has exponent 14.
    const std::uint32_t bits = (15u << 6) | ((14u << 6) << 11) | ((15u << 5) << 22);
    EXPECT_EQ(decode<std::uint32_t>(Format::R11G11B10F, {bits}), glm::vec4(1, 0.5f, 1, 1));
}

TEST(Format, DecodesFloats) {
    EXPECT_EQ(decode<float>(Format::D32F, {0.25f}), glm::vec4(0.25f, 0, 0, 1));
    EXPECT_EQ(decode<float>(Format::RGBA32F, {1e30f, -1, 2, 3}), glm::vec4(1e30f, -1, 2, 3));
}

}  // namespace
}  // namespace crevice
