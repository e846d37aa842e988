// What texture states and clear values mean to Vulkan: stages, accesses, unions.
#pragma once

#include "gfx/Texture.h"
#include "gfx/Vk.h"

namespace crevice {

struct StateScope {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 reads = 0;
    VkAccessFlags2 writes = 0;
};
StateScope scopeOf(TextureState state);

/// The barrier between two states of some mips of a texture. `mipCount` 0 = all from `firstMip`.
VkImageMemoryBarrier2 makeBarrier(const GpuTexture& texture, TextureState from, TextureState to, std::uint32_t firstMip,
                                  std::uint32_t mipCount);

/// Whole numbers for R32UI, floats for the rest.
VkClearColorValue clearColorValue(Format format, const glm::vec4& value);

}  // namespace crevice
