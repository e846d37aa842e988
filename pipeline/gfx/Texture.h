// A 2D, layered or cube image with its memory and views, and the states it moves through.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/Format.h"
#include "gfx/Memory.h"
#include "gfx/Vk.h"

namespace crevice {

class Device;

enum class TextureUsage : std::uint32_t {
    None = 0,
    Color = 1,
    Depth = 2,
    Sampled = 4,
    Storage = 8,
    TransferSource = 16,
    TransferDest = 32
};
constexpr TextureUsage operator|(TextureUsage a, TextureUsage b) {
    return static_cast<TextureUsage>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr TextureUsage& operator|=(TextureUsage& a, TextureUsage b) { return a = a | b; }
constexpr bool hasUsage(TextureUsage set, TextureUsage flag) {
    return (static_cast<std::uint32_t>(set) & static_cast<std::uint32_t>(flag)) != 0;
}

/// What a texture is being used as; the order is that of plan/FramePlan.h's TargetState.
/// Storage states are layout GENERAL; a sampled texture never is, because the validation layer is blind there.
enum class TextureState : std::uint8_t {
    Undefined,
    Color,
    Depth,
    DepthReadOnly,
    Sampled,
    StorageRead,
    StorageWrite,
    TransferSource,
    TransferDest
};
VkImageLayout layoutOf(TextureState state);

struct TextureDesc {
    Format format = Format::RGBA8;
    std::uint32_t width = 1, height = 1;
    std::uint32_t mips = 1;
    std::uint32_t layers = 1;  ///< 6 for a cube.
    bool cube = false;
    bool stencil = false;  ///< D32F: eight bits of stencil beside the depth.
    TextureUsage usage = TextureUsage::Sampled;
    std::string name{};
};

/// Mips down to 1x1.
std::uint32_t fullMipCount(std::uint32_t width, std::uint32_t height);

/// Named so because scene/Scene.h's Texture is the CPU picture that may be uploaded into one.
class GpuTexture {
public:
    GpuTexture() = default;
    /// Throws Error when the device cannot use the format so or the size is beyond its limits. Contents are undefined.
    GpuTexture(Device& device, TextureDesc desc);

    const TextureDesc& desc() const { return desc_; }
    Format format() const { return desc_.format; }
    std::uint32_t width(std::uint32_t mip = 0) const { return desc_.width >> mip ? desc_.width >> mip : 1; }
    std::uint32_t height(std::uint32_t mip = 0) const { return desc_.height >> mip ? desc_.height >> mip : 1; }
    /// Bytes that the driver reserved.
    std::uint64_t memoryBytes() const { return memory_.size(); }

    VkImage handle() const { return image_.get(); }
    /// Everything it holds: for barriers, clears and attachments.
    VkImageAspectFlags aspect() const;
    /// What samplers and copies see: no stencil.
    VkImageAspectFlags readAspect() const;
    explicit operator bool() const { return static_cast<bool>(image_); }
    /// All mips and layers: 2D, 2D array (layers > 1) or cube. For samplers.
    VkImageView view() const;
    /// One mip, all layers (a cube as 2D array). For samplers of a mip and storage images.
    VkImageView mipView(std::uint32_t mip) const;
    /// One mip of one layer, 2D. For attachments.
    VkImageView attachmentView(std::uint32_t mip, std::uint32_t layer) const;

private:
    VkFormat vulkanFormat() const;
    VkImageView addView(Device& device, VkImageViewType type, VkImageSubresourceRange range);
    void createImage(Device& device);
    void createViews(Device& device);

    TextureDesc desc_;
    Allocation memory_;  // before the image: freed after it
    Unique<VkImage> image_;
    std::vector<Unique<VkImageView>> views_;
    VkImageView whole_ = VK_NULL_HANDLE;
    std::vector<VkImageView> mipViews_;         ///< [mip]
    std::vector<VkImageView> attachmentViews_;  ///< [mip * layers + layer]
};

}  // namespace crevice
