// Textures: clears, uploads, mips, layers, exact to the byte, and refusals in words.
#include "gfx/Texture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>

#include "GfxFixture.h"
#include "gfx/Format.h"

namespace crevice {
namespace {

constexpr TextureUsage kCopies = TextureUsage::TransferSource | TextureUsage::TransferDest;

TEST(GfxFormat, TableIsItsOwnInverse) {
    for (const FormatInfo& info : allFormats()) {
        EXPECT_EQ(fromVk(toVk(info.format)), info.format) << info.name;
        EXPECT_EQ(aspectOf(info.format) == VK_IMAGE_ASPECT_DEPTH_BIT, info.isDepth) << info.name;
    }
}

TEST_F(GfxTest, UploadAndReadbackKeepEveryByteOfEveryFormat) {
    for (const FormatInfo& info : allFormats()) {
        if (!supports(*device_, info.format, TextureUsage::Sampled | kCopies)) continue;
        const Image image = pattern(13, 7, info.format);
        const GpuTexture texture = makeTexture(*device_, image, false, info.name);
        EXPECT_EQ(readTexture(*device_, texture, TextureState::Sampled), image) << info.name;
    }
}

TEST_F(GfxTest, ReadbackLeavesTheTextureInItsState) {
    const Image image = pattern(4, 4, Format::RGBA8);
    const GpuTexture texture = makeTexture(*device_, image, false, "t");
    EXPECT_EQ(readTexture(*device_, texture, TextureState::Sampled), image);
    EXPECT_EQ(readTexture(*device_, texture, TextureState::Sampled), image);
}

struct ClearCase {
    Format format;
    glm::vec4 value;
    glm::vec4 expected;  ///< As decodePixel() gives it.
};

TEST_F(GfxTest, AttachmentClearsAreExact) {
    const float srgbHalf = 188.0f / 255.0f;  // IEC 61966-2-1: 0.5 → 0.7354 → 187.5…, rounded
    const ClearCase cases[] = {
        {Format::R8, {0.2f, 9, 9, 9}, {0.2f, 0, 0, 1}},
        {Format::RG8, {1, 0.4f, 9, 9}, {1, 0.4f, 0, 1}},
        {Format::RGBA8, {0, 0.2f, 0.4f, 0.6f}, {0, 0.2f, 0.4f, 0.6f}},
        {Format::RGBA8, {-1, 2, 0, 1}, {0, 1, 0, 1}},
        {Format::RGBA8_SRGB, {0, 0.5f, 1, 0.2f}, {0, srgbHalf, 1, 0.2f}},
        {Format::R16F, {-2.5f, 0, 0, 0}, {-2.5f, 0, 0, 1}},
        {Format::RGBA16F, {1, -0.5f, 1024, 0.25f}, {1, -0.5f, 1024, 0.25f}},
        {Format::R32F, {1e9f, 0, 0, 0}, {1e9f, 0, 0, 1}},
        {Format::RG32F, {0.1f, -0.1f, 0, 0}, {0.1f, -0.1f, 0, 1}},
        {Format::RGBA32F, {0.1f, 0.2f, 0.3f, 0.4f}, {0.1f, 0.2f, 0.3f, 0.4f}},
        {Format::R32UI, {123456, 0, 0, 0}, {123456, 0, 0, 1}},
        {Format::R11G11B10F, {0.5f, 2, 4, 0}, {0.5f, 2, 4, 1}},
    };
    for (const ClearCase& test : cases) {
        const char* name = formatInfo(test.format).name;
        if (!supports(*device_, test.format, TextureUsage::Color)) continue;
        const GpuTexture target(*device_, {.format = test.format,
                                           .width = 5,
                                           .height = 3,
                                           .usage = TextureUsage::Color | TextureUsage::TransferSource,
                                           .name = name});
        Commands commands(*device_);
        commands.begin();
        commands.barrier(target, TextureState::Undefined, TextureState::Color);
        commands.beginRendering({.colors = {{.texture = &target, .load = LoadOp::Clear, .clear = test.value}}});
        commands.endRendering();
        commands.submitAndWait();
        const Image image = readTexture(*device_, target, TextureState::Color);
        for (std::uint32_t y = 0; y < 3; ++y) {
            for (std::uint32_t x = 0; x < 5; ++x) {
                const glm::vec4 pixel = image.at(x, y);
                EXPECT_EQ(pixel, test.expected)
                    << name << " " << pixel.x << " " << pixel.y << " " << pixel.z << " " << pixel.w;
            }
        }
    }
}

TEST_F(GfxTest, DepthClearsAndLoadsAndMayBeReadOnly) {
    const GpuTexture depth(*device_,
                           {.format = Format::D32F,
                            .width = 4,
                            .height = 4,
                            .usage = TextureUsage::Depth | TextureUsage::Sampled | TextureUsage::TransferSource,
                            .name = "depth"});
    Commands commands(*device_);
    commands.begin();
    commands.barrier(depth, TextureState::Undefined, TextureState::Depth);
    commands.beginRendering({.colors = {}, .depth = {.texture = &depth, .load = LoadOp::Clear, .clear = 0.25f}});
    commands.endRendering();
    commands.barrier(depth, TextureState::Depth, TextureState::DepthReadOnly);
    commands.beginRendering({.colors = {}, .depth = {.texture = &depth, .load = LoadOp::Load, .readOnly = true}});
    commands.endRendering();
    commands.submitAndWait();
    EXPECT_EQ(readTexture(*device_, depth, TextureState::DepthReadOnly).at(3, 3).x, 0.25f);
}

TEST_F(GfxTest, ClearsOutsideRenderingFillEveryMipAndLayer) {
    const GpuTexture texture(*device_, {.format = Format::RGBA32F,
                                        .width = 4,
                                        .height = 4,
                                        .mips = 3,
                                        .layers = 2,
                                        .usage = TextureUsage::Sampled | kCopies,
                                        .name = "layers"});
    Commands commands(*device_);
    commands.begin();
    commands.barrier(texture, TextureState::Undefined, TextureState::TransferDest);
    commands.clearColor(texture, {1, 2, 3, 4});
    commands.barrier(texture, TextureState::TransferDest, TextureState::TransferSource);
    commands.submitAndWait();
    for (std::uint32_t mip = 0; mip < 3; ++mip) {
        for (std::uint32_t layer = 0; layer < 2; ++layer) {
            const Image image = readTexture(*device_, texture, TextureState::TransferSource, mip, layer);
            EXPECT_EQ(image.width, 4u >> mip);
            EXPECT_EQ(image.at(0, 0), glm::vec4(1, 2, 3, 4));
        }
    }
}

TEST_F(GfxTest, SixFacesOfACubeStayApart) {
    const GpuTexture cube(*device_, {.format = Format::RGBA8,
                                     .width = 2,
                                     .height = 2,
                                     .cube = true,
                                     .usage = TextureUsage::Sampled | kCopies,
                                     .name = "cube"});
    EXPECT_EQ(cube.desc().layers, 6u);
    TextureState state = TextureState::Undefined;
    for (std::uint32_t face = 0; face < 6; ++face) {
        Image image(2, 2, Format::RGBA8);
        std::fill(image.pixels.begin(), image.pixels.end(), static_cast<std::byte>(face * 40));
        uploadTexture(*device_, cube, image, state, TextureState::Sampled, 0, face);
        state = TextureState::Sampled;
    }
    for (std::uint32_t face = 0; face < 6; ++face) {
        const Image image = readTexture(*device_, cube, TextureState::Sampled, 0, face);
        EXPECT_EQ(image.pixels.front(), static_cast<std::byte>(face * 40));
    }
}

TEST_F(GfxTest, MipOfTwoByTwoIsTheExactMean) {
    Image image(2, 2, Format::RGBA8);
    const int values[] = {10, 20, 40, 90};
    for (std::uint32_t i = 0; i < 4; ++i) std::fill_n(image.pixel(i % 2, i / 2), 4, static_cast<std::byte>(values[i]));
    const GpuTexture texture = makeTexture(*device_, image, true, "mips");
    EXPECT_EQ(texture.desc().mips, 2u);
    EXPECT_EQ(readTexture(*device_, texture, TextureState::Sampled, 0), image);
    EXPECT_EQ(readTexture(*device_, texture, TextureState::Sampled, 1).pixels,
              std::vector<std::byte>(4, std::byte{40}));
}

TEST_F(GfxTest, MipsOfSrgbAreAveragedInLinearLight) {
    Image image(2, 2,
                Format::RGBA8_SRGB);  // half black, half white: linear 0.5, encoded 188 (a plain mean would be 128)
    for (std::uint32_t y = 0; y < 2; ++y) std::fill_n(image.pixel(1, y), 4, std::byte{255});
    const GpuTexture texture = makeTexture(*device_, image, true, "srgb");
    const Image mip = readTexture(*device_, texture, TextureState::Sampled, 1);
    EXPECT_EQ(std::to_integer<int>(mip.pixels[0]), 188);
    EXPECT_EQ(std::to_integer<int>(mip.pixels[3]), 128) << "alpha is linear";
}

TEST_F(GfxTest, MipSizesFollowVulkanForOddSizes) {
    EXPECT_EQ(fullMipCount(1, 1), 1u);
    EXPECT_EQ(fullMipCount(2, 1), 2u);
    EXPECT_EQ(fullMipCount(333, 777), 10u);
    const GpuTexture texture = makeTexture(*device_, pattern(5, 3, Format::RGBA8), true, "odd");
    EXPECT_EQ(texture.desc().mips, 3u);
    const Image last = readTexture(*device_, texture, TextureState::Sampled, 2);
    EXPECT_EQ(last.width, 1u);
    EXPECT_EQ(last.height, 1u);
}

TEST_F(GfxTest, RecordedBarriersAreListedAsGiven) {
    const GpuTexture texture(*device_, {.usage = TextureUsage::Color | TextureUsage::Sampled, .name = "target"});
    std::vector<RecordedBarrier> recorded;
    Commands commands(*device_);
    commands.begin();
    commands.recordBarriersTo(&recorded);
    commands.barrier(texture, TextureState::Undefined, TextureState::Color);
    commands.barrier(texture, TextureState::Color, TextureState::Color);  // a write after a write
    commands.recordBarriersTo(nullptr);
    commands.barrier(texture, TextureState::Color, TextureState::Sampled);
    commands.submitAndWait();
    const std::vector<RecordedBarrier> expected = {{"target", TextureState::Undefined, TextureState::Color},
                                                   {"target", TextureState::Color, TextureState::Color}};
    EXPECT_EQ(recorded, expected);
}

TEST_F(GfxTest, ReadbackBufferIsKeptFromFrameToFrame) {
    const Image image = pattern(8, 8, Format::RGBA16F);
    const GpuTexture texture = makeTexture(*device_, image, false, "t");
    Readback readback(*device_);
    Commands commands(*device_);
    LiveObjects afterFirst;
    for (int frame = 0; frame < 3; ++frame) {
        commands.begin();
        commands.barrier(texture, TextureState::Sampled, TextureState::TransferSource);
        readback.record(commands, texture);
        commands.barrier(texture, TextureState::TransferSource, TextureState::Sampled);
        commands.submitAndWait();
        EXPECT_EQ(readback.image(), image);
        if (frame == 0) afterFirst = device_->liveObjects();
        EXPECT_EQ(device_->liveObjects(), afterFirst);
    }
}

TEST_F(GfxTest, UnsupportedUseIsRefusedInWords) {
    if (supports(*device_, Format::D32F, TextureUsage::Storage)) GTEST_SKIP() << "this device can store to D32F";
    try {
        const GpuTexture texture(*device_, {.format = Format::D32F, .usage = TextureUsage::Storage, .name = "hiZ"});
        FAIL() << "the texture was made";
    } catch (const Error& error) {
        const std::string message = formatError(error);
        EXPECT_THAT(message, testing::HasSubstr("cannot use format 'D32F' as a storage image"));
        EXPECT_THAT(message, testing::HasSubstr("texture 'hiZ'"));
    }
}

TEST_F(GfxTest, SizesBeyondTheLimitAreRefusedInWords) {
    const std::uint32_t tooWide = device_->limits().maxImageDimension2D + 1;
    try {
        const GpuTexture texture(*device_, {.width = tooWide, .height = 1, .name = "wide"});
        FAIL() << "the texture was made";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("texture 'wide' is " + std::to_string(tooWide) + "x1 pixels"));
    }
}

TEST_F(GfxTest, EqualSamplersAreOneObject) {
    SamplerCache samplers(*device_);
    const SamplerKey linear{.minFilter = Filter::Linear, .magFilter = Filter::Linear, .mipFilter = MipFilter::Linear};
    const SamplerKey shadow{.minFilter = Filter::Linear,
                            .magFilter = Filter::Linear,
                            .wrapU = SamplerWrap::Border,
                            .wrapV = SamplerWrap::Border,
                            .border = BorderColor::OpaqueWhite,
                            .compare = CompareOp::LessEqual};
    EXPECT_EQ(samplers.get(linear), samplers.get(linear));
    EXPECT_NE(samplers.get(linear), samplers.get(shadow));
    EXPECT_EQ(device_->liveObjects()[ObjectKind::Sampler], 2);
}

}  // namespace
}  // namespace crevice
