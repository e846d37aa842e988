// The table Format ↔ VkFormat, and format support of a device.
#include "gfx/Format.h"

#include <array>
#include <cassert>

#include "gfx/Device.h"

namespace crevice {

namespace {

// In the order of enum Format.
constexpr std::array kFormats = {VK_FORMAT_R8_UNORM,
                                 VK_FORMAT_R8G8_UNORM,
                                 VK_FORMAT_R8G8B8A8_UNORM,
                                 VK_FORMAT_R8G8B8A8_SRGB,
                                 VK_FORMAT_R16_UNORM,
                                 VK_FORMAT_R16G16_UNORM,
                                 VK_FORMAT_R16G16B16A16_UNORM,
                                 VK_FORMAT_R16_SFLOAT,
                                 VK_FORMAT_R16G16_SFLOAT,
                                 VK_FORMAT_R16G16B16A16_SFLOAT,
                                 VK_FORMAT_R32_SFLOAT,
                                 VK_FORMAT_R32G32_SFLOAT,
                                 VK_FORMAT_R32G32B32A32_SFLOAT,
                                 VK_FORMAT_R32_UINT,
                                 VK_FORMAT_B10G11R11_UFLOAT_PACK32,
                                 VK_FORMAT_D32_SFLOAT};
static_assert(kFormats.size() == static_cast<std::size_t>(Format::D32F) + 1);

VkFormatFeatureFlags featuresOf(const Device& device, Format format) {
    if (device.lacksFormat(format)) return 0;
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(device.physical(), toVk(format), &properties);
    return properties.optimalTilingFeatures;
}

}  // namespace

VkFormat toVk(Format format) { return kFormats[static_cast<std::size_t>(format)]; }

Format fromVk(VkFormat format) {
    for (std::size_t i = 0; i < kFormats.size(); ++i) {
        if (kFormats[i] == format) return static_cast<Format>(i);
    }
    assert(false && "a VkFormat without a name");
    return Format::RGBA8;
}

VkImageAspectFlags aspectOf(Format format) {
    return format == Format::D32F ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

bool supports(const Device& device, Format format, TextureUsage usage) {
    VkFormatFeatureFlags needed = 0;
    if (hasUsage(usage, TextureUsage::Color)) needed |= VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
    if (hasUsage(usage, TextureUsage::Depth)) needed |= VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if (hasUsage(usage, TextureUsage::Sampled)) needed |= VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    if (hasUsage(usage, TextureUsage::Storage)) needed |= VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT;
    if (hasUsage(usage, TextureUsage::TransferSource)) needed |= VK_FORMAT_FEATURE_TRANSFER_SRC_BIT;
    if (hasUsage(usage, TextureUsage::TransferDest)) needed |= VK_FORMAT_FEATURE_TRANSFER_DST_BIT;
    return (featuresOf(device, format) & needed) == needed;
}

bool supportsLinearFilter(const Device& device, Format format) {
    return (featuresOf(device, format) & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) != 0;
}

bool supportsStencil(const Device& device) {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(device.physical(), VK_FORMAT_D32_SFLOAT_S8_UINT, &properties);
    constexpr VkFormatFeatureFlags kNeeded = VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                             VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_TRANSFER_SRC_BIT;
    return (properties.optimalTilingFeatures & kNeeded) == kNeeded;
}

bool supportsBlend(const Device& device, Format format) {
    return (featuresOf(device, format) & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) != 0;
}

}  // namespace crevice
