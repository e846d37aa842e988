// Hands pipeline descriptions to the driver; the cache in Pipeline.h decides when.
#pragma once

#include "gfx/Pipeline.h"

namespace crevice {

/// Throws RenderError with the pipeline's name when the driver refuses.
Unique<VkPipeline> buildGraphicsPipeline(Device& device, const GraphicsPipelineDesc& desc);
Unique<VkPipeline> buildComputePipeline(Device& device, const ComputePipelineDesc& desc);

}  // namespace crevice
