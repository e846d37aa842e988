// The table of states and the barrier made from two of its rows.
#include "gfx/Barriers.h"

#include <cassert>

namespace crevice {

StateScope scopeOf(TextureState state) {
    constexpr VkPipelineStageFlags2 kShaders = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                                               VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
                                               VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    constexpr VkPipelineStageFlags2 kDepthTests =
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    switch (state) {
        // The contents are dropped, but whatever touched them before must be over.
        case TextureState::Undefined:
            return {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0, VK_ACCESS_2_MEMORY_WRITE_BIT};
        case TextureState::Color:
            return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
                    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
        case TextureState::Depth:
            return {kDepthTests, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
        case TextureState::DepthReadOnly:
            return {kDepthTests | kShaders,
                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0};
        case TextureState::Sampled:
            return {kShaders, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0};
        case TextureState::StorageRead:
            return {kShaders, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, 0};
        case TextureState::StorageWrite:
            return {kShaders, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
        case TextureState::TransferSource:
            return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, 0};
        case TextureState::TransferDest:
            return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, 0, VK_ACCESS_2_TRANSFER_WRITE_BIT};
    }
    return {};
}

VkImageMemoryBarrier2 makeBarrier(const GpuTexture& texture, TextureState from, TextureState to, std::uint32_t firstMip,
                                  std::uint32_t mipCount) {
    assert(to != TextureState::Undefined && firstMip < texture.desc().mips);
    const StateScope before = scopeOf(from), after = scopeOf(to);
    auto barrier = vkStruct<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
    barrier.srcStageMask = before.stages;
    barrier.srcAccessMask = before.writes;  // reads need no flush, only the wait
    barrier.dstStageMask = after.stages;
    barrier.dstAccessMask = after.reads | after.writes;
    barrier.oldLayout = layoutOf(from);
    barrier.newLayout = layoutOf(to);
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = texture.handle();
    barrier.subresourceRange = {texture.aspect(), firstMip, mipCount == 0 ? VK_REMAINING_MIP_LEVELS : mipCount, 0,
                                VK_REMAINING_ARRAY_LAYERS};
    return barrier;
}

VkClearColorValue clearColorValue(Format format, const glm::vec4& value) {
    VkClearColorValue clear{};
    for (int i = 0; i < 4; ++i) {
        if (format == Format::R32UI) {
            clear.uint32[i] = static_cast<std::uint32_t>(value[i]);
        } else {
            clear.float32[i] = value[i];
        }
    }
    return clear;
}

}  // namespace crevice
