// Descriptor set layouts, sets, and batched writes into them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gfx/Buffer.h"
#include "gfx/Texture.h"
#include "gfx/Vk.h"

namespace crevice {

class Device;

enum class DescriptorType : std::uint8_t {
    UniformBuffer,
    UniformBufferDynamic,
    StorageBuffer,
    CombinedImageSampler,
    StorageImage
};
VkDescriptorType toVk(DescriptorType type);

struct SetLayoutBinding {
    std::uint32_t binding = 0;
    DescriptorType type = DescriptorType::UniformBuffer;
    std::uint32_t count = 1;
    std::uint32_t stages =
        1 | 16 | 32;  ///< Vulkan's bits, which are effect/ShaderInfo.h's: vertex 1, fragment 16, compute 32.
    bool operator==(const SetLayoutBinding&) const = default;
};

class SetLayout {
public:
    SetLayout() = default;
    /// Bindings in any order; numbers may have gaps, not doubles (asserted).
    SetLayout(Device& device, std::vector<SetLayoutBinding> bindings, const std::string& name = {});

    VkDescriptorSetLayout handle() const { return layout_.get(); }
    /// Sorted by number: the order of dynamic offsets.
    const std::vector<SetLayoutBinding>& bindings() const { return bindings_; }
    const SetLayoutBinding* find(std::uint32_t binding) const;
    std::uint32_t dynamicCount() const;

private:
    std::vector<SetLayoutBinding> bindings_;
    Unique<VkDescriptorSetLayout> layout_;
};

/// One Vulkan pool and how many sets are taken from it; some drivers would give more than was asked for.
struct DescriptorBlock {
    Unique<VkDescriptorPool> pool;
    std::uint32_t live = 0;
};

/// One set. Collect writes, then update() once; a set must not be updated while the GPU uses it.
class DescriptorSet {
public:
    DescriptorSet() = default;
    DescriptorSet(DescriptorSet&& other) noexcept;
    DescriptorSet& operator=(DescriptorSet&& other) noexcept;
    ~DescriptorSet();

    VkDescriptorSet handle() const { return set_; }
    explicit operator bool() const { return set_ != VK_NULL_HANDLE; }

    /// `range` bytes from `offset`; 0 = the rest. For a dynamic block `range` is one slice and `offset` usually 0.
    void writeUniformBuffer(std::uint32_t binding, const Buffer& buffer, std::uint64_t offset = 0,
                            std::uint64_t range = 0);
    void writeStorageBuffer(std::uint32_t binding, const Buffer& buffer, std::uint64_t offset = 0,
                            std::uint64_t range = 0);
    /// `state` is what the texture will be in when it is sampled: Sampled or DepthReadOnly.
    void writeTexture(std::uint32_t binding, const GpuTexture& texture, VkSampler sampler,
                      TextureState state = TextureState::Sampled, std::uint32_t element = 0);
    void writeTextureView(std::uint32_t binding, VkImageView view, VkSampler sampler,
                          TextureState state = TextureState::Sampled, std::uint32_t element = 0);
    /// Layout GENERAL.
    void writeStorageImage(std::uint32_t binding, const GpuTexture& texture, std::uint32_t mip = 0,
                           std::uint32_t element = 0);
    /// Sends the collected writes to the driver.
    void update();

    bool hasPendingWrites() const { return !pending_.empty(); }
    /// Every slot was written: some drivers crash on unwritten samplers even when no shader uses them.
    bool isComplete() const;
    std::uint32_t dynamicCount() const { return dynamicCount_; }

private:
    friend class DescriptorPool;
    struct Slot {
        std::uint32_t binding, count;
        DescriptorType type;
        std::vector<bool> written;
    };
    struct Pending {
        std::uint32_t binding, element;
        DescriptorType type;
        VkDescriptorBufferInfo buffer;
        VkDescriptorImageInfo image;
    };
    void writeBuffer(std::uint32_t binding, const Buffer& buffer, std::uint64_t offset, std::uint64_t range);
    void writeImage(std::uint32_t binding, std::uint32_t element, VkDescriptorImageInfo info);
    Slot& slot(std::uint32_t binding);
    void release();

    Device* device_ = nullptr;
    DescriptorBlock* block_ = nullptr;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    std::uint32_t dynamicCount_ = 0;
    std::vector<Slot> slots_;
    void pend(const Pending& write);
    std::vector<Pending> pending_;
};

/// Grows by whole Vulkan pools. Sets give themselves back and must not outlive it.
class DescriptorPool {
public:
    explicit DescriptorPool(Device& device, std::uint32_t setsPerPool = 64);
    DescriptorSet allocate(const SetLayout& layout, const std::string& name = {});

private:
    bool tryAllocate(DescriptorSet& set, DescriptorBlock& block, const SetLayout& layout);
    DescriptorBlock& addBlock(const SetLayout& layout);

    Device& device_;
    std::uint32_t setsPerPool_;
    std::vector<std::unique_ptr<DescriptorBlock>> blocks_;  ///< Sets point at them.
};

}  // namespace crevice
