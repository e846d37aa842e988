// Recording of clears and copies.
#include <cassert>

#include "gfx/Barriers.h"
#include "gfx/Commands.h"
#include "gfx/Device.h"

namespace crevice {

namespace {

VkBufferImageCopy copyRegion(const GpuTexture& texture, std::uint32_t mip, std::uint32_t layer, std::uint64_t offset) {
    assert(mip < texture.desc().mips && layer < texture.desc().layers);
    VkBufferImageCopy region{};
    region.bufferOffset = offset;
    region.imageSubresource = {texture.readAspect(), mip, layer, 1};
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

}  // namespace crevice
