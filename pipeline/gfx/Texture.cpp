// Images with their views, checked against what the device can do.
#include "gfx/Texture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

#include <fmt/format.h>

#include "core/Error.h"
#include "gfx/Device.h"
#include "gfx/Format.h"
#include "gfx/Owned.h"

namespace crevice {

namespace {

struct UsageRow {
    TextureUsage usage;
    VkImageUsageFlags flag;
    const char* words;
};
constexpr std::array kUsages = {
    UsageRow{TextureUsage::Color, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, "a colour attachment"},
    UsageRow{TextureUsage::Depth, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, "a depth attachment"},
    UsageRow{TextureUsage::Sampled, VK_IMAGE_USAGE_SAMPLED_BIT, "a sampled texture"},
    UsageRow{TextureUsage::Storage, VK_IMAGE_USAGE_STORAGE_BIT, "a storage image"},
    UsageRow{TextureUsage::TransferSource, VK_IMAGE_USAGE_TRANSFER_SRC_BIT, "a source of copies"},
    UsageRow{TextureUsage::TransferDest, VK_IMAGE_USAGE_TRANSFER_DST_BIT, "a destination of copies"}};

VkImageUsageFlags toVk(TextureUsage usage) {
    VkImageUsageFlags flags = 0;
    for (const UsageRow& row : kUsages) {
        if (hasUsage(usage, row.usage)) flags |= row.flag;
    }
    return flags;
}

std::string quoted(const TextureDesc& desc) { return desc.name.empty() ? "a texture" : "texture '" + desc.name + "'"; }

void checkSupport(const Device& device, const TextureDesc& desc) {
    for (const UsageRow& row : kUsages) {
        if (!hasUsage(desc.usage, row.usage) || supports(device, desc.format, row.usage)) continue;
        throw Error(fmt::format("device '{}' cannot use format '{}' as {}, which {} needs", device.deviceName(),
                                formatInfo(desc.format).name, row.words, quoted(desc)),
                    "choose another format; `crevice info` lists what the device can do");
    }
    if (desc.stencil && !supportsStencil(device)) {
        throw Error(fmt::format("device '{}' has no depth format with a stencil, which {} needs", device.deviceName(),
                                quoted(desc)),
                    "draw without stencil tests, or choose another device with --device");
    }
    const std::uint32_t limit = desc.cube ? device.limits().maxImageDimensionCube : device.limits().maxImageDimension2D;
    if (desc.width > limit || desc.height > limit) {
        throw Error(fmt::format("{} is {}x{} pixels; device '{}' allows {}", quoted(desc), desc.width, desc.height,
                                device.deviceName(), limit),
                    "render fewer pixels with --size");
    }
    if (desc.layers > device.limits().maxImageArrayLayers) {
        throw Error(fmt::format("{} has {} layers; device '{}' allows {}", quoted(desc), desc.layers,
                                device.deviceName(), device.limits().maxImageArrayLayers));
    }
}

}  // namespace

VkImageLayout layoutOf(TextureState state) {
    switch (state) {
        case TextureState::Undefined:
            return VK_IMAGE_LAYOUT_UNDEFINED;
        case TextureState::Color:
            return VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        case TextureState::Depth:
            return VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;  // also where there is no stencil
        case TextureState::DepthReadOnly:
            return VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
        case TextureState::Sampled:
            return VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        case TextureState::StorageRead:
        case TextureState::StorageWrite:
            return VK_IMAGE_LAYOUT_GENERAL;
        case TextureState::TransferSource:
            return VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
        case TextureState::TransferDest:
            return VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    }
    return VK_IMAGE_LAYOUT_UNDEFINED;
}

std::uint32_t fullMipCount(std::uint32_t width, std::uint32_t height) {
    return static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
}

GpuTexture::GpuTexture(Device& device, TextureDesc desc) : desc_(std::move(desc)) {
    if (desc_.cube) desc_.layers = 6;
    assert(desc_.width > 0 && desc_.height > 0 && desc_.layers > 0 && desc_.mips > 0);
    assert(!desc_.stencil || desc_.format == Format::D32F);
    assert(desc_.mips <= fullMipCount(desc_.width, desc_.height));
    checkSupport(device, desc_);
    createImage(device);
    createViews(device);
}

void GpuTexture::createImage(Device& device) {
    auto info = vkStruct<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.flags = desc_.cube ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = vulkanFormat();
    info.extent = {desc_.width, desc_.height, 1};
    info.mipLevels = desc_.mips;
    info.arrayLayers = desc_.layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = toVk(desc_.usage);
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkImage image = VK_NULL_HANDLE;
    VK_CALL(vkCreateImage(device.handle(), &info, nullptr, &image));
    image_ = own<vkDestroyImage, ObjectKind::Image>(device, image);
    device.setName(VK_OBJECT_TYPE_IMAGE, image, desc_.name);

    MemoryRequest request;
    request.preferred = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    request.linear = false;
    request.name = desc_.name.empty() ? "a texture" : desc_.name;
    vkGetImageMemoryRequirements(device.handle(), image, &request.requirements);
    memory_ = device.memory().allocate(request);
    VK_CALL(vkBindImageMemory(device.handle(), image, memory_.memory(), memory_.offset()));
}

void GpuTexture::createViews(Device& device) {
    const TextureUsage viewable =
        TextureUsage::Color | TextureUsage::Depth | TextureUsage::Sampled | TextureUsage::Storage;
    if (!hasUsage(desc_.usage, viewable)) return;
    const VkImageViewType perMip = desc_.layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    const VkImageViewType whole = desc_.cube ? VK_IMAGE_VIEW_TYPE_CUBE : perMip;
    whole_ = addView(device, whole, {readAspect(), 0, desc_.mips, 0, desc_.layers});
    for (std::uint32_t mip = 0; mip < desc_.mips; ++mip) {
        const bool same = desc_.mips == 1 && whole == perMip;
        mipViews_.push_back(same ? whole_ : addView(device, perMip, {readAspect(), mip, 1, 0, desc_.layers}));
        for (std::uint32_t layer = 0; layer < desc_.layers; ++layer) {
            attachmentViews_.push_back(desc_.layers == 1 && !desc_.stencil
                                           ? mipViews_.back()
                                           : addView(device, VK_IMAGE_VIEW_TYPE_2D, {aspect(), mip, 1, layer, 1}));
        }
    }
}

VkImageView GpuTexture::addView(Device& device, VkImageViewType type, VkImageSubresourceRange range) {
    auto info = vkStruct<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    info.image = image_.get();
    info.viewType = type;
    info.format = vulkanFormat();
    info.subresourceRange = range;
    VkImageView view = VK_NULL_HANDLE;
    VK_CALL(vkCreateImageView(device.handle(), &info, nullptr, &view));
    views_.push_back(own<vkDestroyImageView, ObjectKind::ImageView>(device, view));
    device.setName(VK_OBJECT_TYPE_IMAGE_VIEW, view, desc_.name);
    return view;
}

VkFormat GpuTexture::vulkanFormat() const {
    return desc_.stencil ? VK_FORMAT_D32_SFLOAT_S8_UINT : crevice::toVk(desc_.format);
}

VkImageAspectFlags GpuTexture::readAspect() const { return aspectOf(desc_.format); }

VkImageAspectFlags GpuTexture::aspect() const {
    return desc_.stencil ? readAspect() | VK_IMAGE_ASPECT_STENCIL_BIT : readAspect();
}

VkImageView GpuTexture::view() const {
    assert(whole_ != VK_NULL_HANDLE);
    return whole_;
}

VkImageView GpuTexture::mipView(std::uint32_t mip) const {
    assert(mip < mipViews_.size());
    return mipViews_[mip];
}

VkImageView GpuTexture::attachmentView(std::uint32_t mip, std::uint32_t layer) const {
    assert(mip < desc_.mips && layer < desc_.layers);
    return attachmentViews_[mip * desc_.layers + layer];
}

}  // namespace crevice
