// core/RenderState.h and the sampler words in Vulkan's spelling.
#pragma once

#include "core/RenderState.h"
#include "gfx/Sampler.h"
#include "gfx/Vk.h"

namespace crevice {

VkCompareOp toVk(CompareOp op);
VkStencilOp toVk(StencilOp op);
VkCullModeFlags toVk(CullMode mode);
VkPolygonMode toVk(PolygonMode mode);
VkBlendFactor toVk(BlendFactor factor);
VkBlendOp toVk(BlendOp op);
VkPrimitiveTopology toVk(Topology topology);
VkFilter toVk(Filter filter);

}  // namespace crevice
