// Recording of clears and copies.
#include <cassert>

#include <fmt/format.h>

#include "core/Error.h"
#include "gfx/Barriers.h"
#include "gfx/Commands.h"
#include "gfx/Device.h"
#include "gfx/Format.h"
#include "gfx/StateWords.h"

namespace crevice {

namespace {

VkBufferImageCopy copyRegion(const GpuTexture& texture, std::uint32_t mip, std::uint32_t layer, std::uint64_t offset) {
    assert(mip < texture.desc().mips && layer < texture.desc().layers);
    VkBufferImageCopy region{};
    region.bufferOffset = offset;
    region.imageSubresource = {texture.aspect(), mip, layer, 1};
    region.imageExtent = {texture.width(mip), texture.height(mip), 1};
    return region;
}

VkImageSubresourceRange wholeOf(const GpuTexture& texture) {
    return {texture.aspect(), 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
}

}  // namespace

void Commands::clearColor(const GpuTexture& texture, const glm::vec4& value) {
    const VkClearColorValue clear = clearColorValue(texture.format(), value);
    const VkImageSubresourceRange range = wholeOf(texture);
    vkCmdClearColorImage(commands_, texture.handle(), layoutOf(TextureState::TransferDest), &clear, 1, &range);
}

void Commands::clearDepth(const GpuTexture& texture, float value) {
    const VkClearDepthStencilValue clear{value, 0};
    const VkImageSubresourceRange range = wholeOf(texture);
    vkCmdClearDepthStencilImage(commands_, texture.handle(), layoutOf(TextureState::TransferDest), &clear, 1, &range);
}

void Commands::copyTextureToBuffer(const GpuTexture& texture, const Buffer& buffer, std::uint32_t mip,
                                   std::uint32_t layer, std::uint64_t bufferOffset) {
    const VkBufferImageCopy region = copyRegion(texture, mip, layer, bufferOffset);
    vkCmdCopyImageToBuffer(commands_, texture.handle(), layoutOf(TextureState::TransferSource), buffer.handle(), 1,
                           &region);
}

void Commands::copyBufferToTexture(const Buffer& buffer, const GpuTexture& texture, std::uint32_t mip,
                                   std::uint32_t layer, std::uint64_t bufferOffset) {
    const VkBufferImageCopy region = copyRegion(texture, mip, layer, bufferOffset);
    vkCmdCopyBufferToImage(commands_, buffer.handle(), texture.handle(), layoutOf(TextureState::TransferDest), 1,
                           &region);
}

void Commands::copyBuffer(const Buffer& from, const Buffer& to, std::uint64_t bytes, std::uint64_t fromOffset,
                          std::uint64_t toOffset) {
    assert(fromOffset + bytes <= from.size() && toOffset + bytes <= to.size());
    const VkBufferCopy region{fromOffset, toOffset, bytes};
    vkCmdCopyBuffer(commands_, from.handle(), to.handle(), 1, &region);
}

void Commands::fillBuffer(const Buffer& buffer, std::uint32_t word) {
    vkCmdFillBuffer(commands_, buffer.handle(), 0, VK_WHOLE_SIZE, word);
}

void Commands::blit(const GpuTexture& from, std::uint32_t fromMip, const GpuTexture& to, std::uint32_t toMip,
                    Filter filter) {
    const auto cornerOf = [](const GpuTexture& texture, std::uint32_t mip) {
        return VkOffset3D{static_cast<std::int32_t>(texture.width(mip)), static_cast<std::int32_t>(texture.height(mip)),
                          1};
    };
    VkImageBlit region{};
    region.srcSubresource = {from.aspect(), fromMip, 0, from.desc().layers};
    region.srcOffsets[1] = cornerOf(from, fromMip);
    region.dstSubresource = {to.aspect(), toMip, 0, to.desc().layers};
    region.dstOffsets[1] = cornerOf(to, toMip);
    vkCmdBlitImage(commands_, from.handle(), layoutOf(TextureState::TransferSource), to.handle(),
                   layoutOf(TextureState::TransferDest), 1, &region, crevice::toVk(filter));
}

void Commands::generateMips(const GpuTexture& texture, TextureState from, TextureState to) {
    if (!supportsLinearFilter(device_, texture.format())) {
        throw Error(fmt::format("device '{}' cannot filter format '{}', which the mips of texture '{}' need",
                                device_.deviceName(), formatInfo(texture.format()).name, texture.desc().name));
    }
    const std::uint32_t mips = texture.desc().mips;
    for (std::uint32_t mip = 0; mip < mips; ++mip) {
        const TextureState before = mip == 0 ? from : TextureState::TransferDest;
        std::vector<TextureBarrier> moves{{&texture, before, TextureState::TransferSource, mip, 1}};
        if (mip == 0 && mips > 1) {
            moves.push_back({&texture, TextureState::Undefined, TextureState::TransferDest, 1, mips - 1});
        }
        barriers(moves);
        if (mip + 1 < mips) blit(texture, mip, texture, mip + 1, Filter::Linear);
    }
    barrier(texture, TextureState::TransferSource, to);
}

}  // namespace crevice
