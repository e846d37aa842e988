// Crevice's formats in Vulkan's words, and what a device can do with them.
#pragma once

#include "core/Format.h"
#include "gfx/Texture.h"
#include "gfx/Vk.h"

namespace crevice {

class Device;

VkFormat toVk(Format format);
/// Throws nothing: a VkFormat that Crevice has no name for is a bug (asserted).
Format fromVk(VkFormat format);
VkImageAspectFlags aspectOf(Format format);

/// True when optimally tiled images of the format can be used in all the ways of `usage`.
bool supports(const Device& device, Format format, TextureUsage usage);
bool supportsLinearFilter(const Device& device, Format format);
/// Depth targets with a stencil: D32F and eight bits.
bool supportsStencil(const Device& device);
bool supportsBlend(const Device& device, Format format);

}  // namespace crevice
