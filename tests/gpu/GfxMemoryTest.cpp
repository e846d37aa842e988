// Memory on a real device: few blocks, returned when empty, and failures that leave nothing behind.
#include <gmock/gmock.h>

#include "GfxFixture.h"

namespace crevice {
namespace {

std::vector<std::byte> bytesOf(std::size_t count) {
    std::vector<std::byte> bytes(count);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(i * 7 + 3);
    return bytes;
}

TEST_F(GfxTest, ManyBuffersShareOneBlockAndKeepTheirBytes) {
    std::vector<Buffer> buffers;
    for (std::size_t i = 0; i < 100; ++i) {
        buffers.emplace_back(*device_, BufferDesc{.size = 1000 + i, .usage = BufferUsage::Uniform}, bytesOf(1000 + i));
    }
    EXPECT_EQ(device_->liveObjects()[ObjectKind::MemoryBlock], 1);
    EXPECT_EQ(device_->liveObjects()[ObjectKind::Allocation], 100);
    EXPECT_GE(device_->allocatedBytes(), 100u * 1000u);
    for (const Buffer& buffer : buffers) {
        const auto expected = bytesOf(buffer.size());
        EXPECT_TRUE(std::equal(expected.begin(), expected.end(), buffer.data().begin()));
    }
    buffers.clear();
    EXPECT_EQ(device_->liveObjects().memoryBytes, 0u);
    EXPECT_EQ(device_->allocatedBytes(), 0u);
}

TEST_F(GfxTest, LargeResourcesHaveTheirOwnBlock) {
    const Buffer small(*device_, {.size = 64, .usage = BufferUsage::Storage});
    const std::uint64_t before = device_->liveObjects().memoryBytes;
    const Buffer large(*device_, {.size = MemoryAllocator::kDedicatedBytes, .usage = BufferUsage::Storage});
    EXPECT_EQ(device_->liveObjects()[ObjectKind::MemoryBlock], 2);
    EXPECT_LT(device_->liveObjects().memoryBytes - before, MemoryAllocator::kBlockBytes);
}

TEST_F(GfxTest, ImagesAndBuffersNeverShareABlock) {
    const Buffer buffer(*device_, {.size = 64, .usage = BufferUsage::Storage});
    const GpuTexture texture(*device_, {.width = 4, .height = 4, .name = "t"});
    EXPECT_EQ(device_->liveObjects()[ObjectKind::MemoryBlock], 2);
}

TEST_F(GfxTest, DeviceOnlyBufferIsFilledAndCopiedBack) {
    const auto bytes = bytesOf(5000);
    const Buffer source(
        *device_, {.size = bytes.size(), .usage = BufferUsage::TransferSource, .access = BufferAccess::DeviceOnly},
        bytes);
    EXPECT_TRUE(source.data().empty());
    const Buffer result(*device_,
                        {.size = bytes.size(), .usage = BufferUsage::TransferDest, .access = BufferAccess::HostRead});
    Commands commands(*device_);
    commands.begin();
    commands.copyBuffer(source, result, 4000, 1000, 500);
    commands.memoryBarrier();
    commands.submitAndWait();
    EXPECT_TRUE(std::equal(bytes.begin() + 1000, bytes.end(), result.data().begin() + 500));
}

TEST_F(GfxTest, FillBufferWritesTheWordEverywhere) {
    const Buffer buffer(*device_, {.size = 64, .usage = BufferUsage::TransferDest, .access = BufferAccess::HostRead});
    Commands commands(*device_);
    commands.begin();
    commands.fillBuffer(buffer, 0x01020304);
    commands.memoryBarrier();
    commands.submitAndWait();
    for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(buffer.data()[i], static_cast<std::byte>(4 - i % 4));
}

TEST_F(GfxTest, CommandsCanBeUsedAgainAndAfterAnAbandonedRecording) {
    const Buffer buffer(*device_, {.size = 4, .usage = BufferUsage::TransferDest, .access = BufferAccess::HostRead});
    Commands commands(*device_);
    commands.begin();
    commands.fillBuffer(buffer, 7);  // an exception would leave it so
    for (std::uint32_t round = 1; round <= 3; ++round) {
        commands.begin();
        commands.fillBuffer(buffer, round * 0x01010101);
        commands.memoryBarrier();
        commands.submitAndWait();
        EXPECT_EQ(buffer.data()[0], static_cast<std::byte>(round));
    }
}

/// Everything a frame allocates, in one function: images, buffers, staging.
void makeThings(Device& device) {
    const Buffer buffer(device, {.size = 1 << 20, .usage = BufferUsage::Vertex, .name = "vertices"});
    Image image(16, 16, Format::RGBA8);
    const GpuTexture texture = makeTexture(device, image, true, "picture");
    readTexture(device, texture, TextureState::Sampled);
}

TEST(GfxMemory, EveryFailedAllocationIsAnErrorAndLeavesNothing) {
    const Log quiet(LogLevel::Error, [](LogLevel, std::string_view) {});
    int failures = 0;
    for (int at = 0;; ++at) {
        Device device({.log = quiet, .validate = true, .faults = {.failAllocation = at}});
        bool failed = false;
        try {
            makeThings(device);
        } catch (const RenderError& error) {
            failed = true;
            EXPECT_THAT(error.what(), testing::HasSubstr("out of GPU memory"));
        }
        EXPECT_EQ(device.liveObjects(), LiveObjects{}) << device.liveObjects().text();
        EXPECT_EQ(device.validationMessageCount(), 0u);
        if (!failed) break;
        ++failures;
    }
    EXPECT_EQ(failures, 4);  // vertices, picture, its staging, the readback
}

}  // namespace
}  // namespace crevice
