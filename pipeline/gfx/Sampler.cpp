// Sampler objects from keys.
#include "gfx/Sampler.h"

#include <array>

#include "gfx/Device.h"
#include "gfx/Owned.h"
#include "gfx/StateWords.h"

namespace crevice {

namespace {

VkSamplerAddressMode toVk(SamplerWrap wrap) {
    static constexpr std::array kModes = {VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                          VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT,
                                          VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER};
    return kModes[static_cast<std::size_t>(wrap)];
}

VkBorderColor toVk(BorderColor color) {
    static constexpr std::array kColors = {VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK, VK_BORDER_COLOR_FLOAT_OPAQUE_BLACK,
                                           VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE};
    return kColors[static_cast<std::size_t>(color)];
}

}  // namespace

VkSampler SamplerCache::get(const SamplerKey& key) {
    const auto found = samplers_.find(key);
    if (found != samplers_.end()) return found->second.get();

    auto info = vkStruct<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.magFilter = crevice::toVk(key.magFilter);
    info.minFilter = crevice::toVk(key.minFilter);
    info.mipmapMode =
        key.mipFilter == MipFilter::Linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = toVk(key.wrapU);
    info.addressModeV = toVk(key.wrapV);
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    // Below 0.25 a nearest mip filter never leaves level 0, and minification still uses minFilter.
    info.maxLod = key.mipFilter == MipFilter::None ? 0.25f : VK_LOD_CLAMP_NONE;
    info.borderColor = toVk(key.border);
    info.compareEnable = key.compare ? VK_TRUE : VK_FALSE;
    info.compareOp = crevice::toVk(key.compare.value_or(CompareOp::Always));
    VkSampler sampler = VK_NULL_HANDLE;
    VK_CALL(vkCreateSampler(device_.handle(), &info, nullptr, &sampler));
    samplers_.emplace(key, own<vkDestroySampler, ObjectKind::Sampler>(device_, sampler));
    return sampler;
}

}  // namespace crevice
