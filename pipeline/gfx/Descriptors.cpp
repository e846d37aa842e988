// Layouts, pools that grow, and sets that remember which slots were written.
#include "gfx/Descriptors.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "gfx/Device.h"
#include "gfx/Owned.h"

namespace crevice {

namespace {

constexpr std::array kTypes = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC,
                               VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                               VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
/// Descriptors of each type that a pool holds per set; a layout that needs more gets a pool made to measure.
constexpr std::array<std::uint32_t, kTypes.size()> kPerSet = {4, 4, 2, 8, 2};

}  // namespace

VkDescriptorType toVk(DescriptorType type) { return kTypes[static_cast<std::size_t>(type)]; }

SetLayout::SetLayout(Device& device, std::vector<SetLayoutBinding> bindings, const std::string& name)
    : bindings_(std::move(bindings)) {
    std::sort(bindings_.begin(), bindings_.end(), [](const auto& a, const auto& b) { return a.binding < b.binding; });
    std::vector<VkDescriptorSetLayoutBinding> vkBindings;
    for (const SetLayoutBinding& binding : bindings_) {
        assert(binding.count > 0 && (vkBindings.empty() || vkBindings.back().binding != binding.binding));
        vkBindings.push_back({binding.binding, toVk(binding.type), binding.count, binding.stages, nullptr});
    }
    auto info = vkStruct<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    info.bindingCount = static_cast<std::uint32_t>(vkBindings.size());
    info.pBindings = vkBindings.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    VK_CALL(vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &layout));
    layout_ = own<vkDestroyDescriptorSetLayout, ObjectKind::SetLayout>(device, layout);
    device.setName(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, layout, name);
}

const SetLayoutBinding* SetLayout::find(std::uint32_t binding) const {
    for (const SetLayoutBinding& candidate : bindings_) {
        if (candidate.binding == binding) return &candidate;
    }
    return nullptr;
}

std::uint32_t SetLayout::dynamicCount() const {
    std::uint32_t count = 0;
    for (const SetLayoutBinding& binding : bindings_) {
        if (binding.type == DescriptorType::UniformBufferDynamic) count += binding.count;
    }
    return count;
}

DescriptorSet::DescriptorSet(DescriptorSet&& other) noexcept { *this = std::move(other); }

DescriptorSet& DescriptorSet::operator=(DescriptorSet&& other) noexcept {
    if (this == &other) return *this;
    release();
    device_ = other.device_;
    block_ = other.block_;
    set_ = std::exchange(other.set_, VK_NULL_HANDLE);
    dynamicCount_ = other.dynamicCount_;
    slots_ = std::move(other.slots_);
    pending_ = std::move(other.pending_);
    return *this;
}

DescriptorSet::~DescriptorSet() { release(); }

void DescriptorSet::release() {
    if (set_ == VK_NULL_HANDLE) return;
    vkFreeDescriptorSets(device_->handle(), block_->pool.get(), 1, &set_);  // never fails
    --block_->live;
    --device_->live()[ObjectKind::DescriptorSet];
    set_ = VK_NULL_HANDLE;
}

DescriptorSet::Slot& DescriptorSet::slot(std::uint32_t binding) {
    const auto found =
        std::find_if(slots_.begin(), slots_.end(), [&](const Slot& slot) { return slot.binding == binding; });
    assert(found != slots_.end() && "the layout has no such binding");
    return *found;
}

void DescriptorSet::writeUniformBuffer(std::uint32_t binding, const Buffer& buffer, std::uint64_t offset,
                                       std::uint64_t range) {
    assert(slot(binding).type == DescriptorType::UniformBuffer ||
           slot(binding).type == DescriptorType::UniformBufferDynamic);
    writeBuffer(binding, buffer, offset, range);
}

void DescriptorSet::writeStorageBuffer(std::uint32_t binding, const Buffer& buffer, std::uint64_t offset,
                                       std::uint64_t range) {
    assert(slot(binding).type == DescriptorType::StorageBuffer);
    writeBuffer(binding, buffer, offset, range);
}

void DescriptorSet::writeBuffer(std::uint32_t binding, const Buffer& buffer, std::uint64_t offset,
                                std::uint64_t range) {
    assert(offset + range <= buffer.size() && offset < buffer.size());
    Slot& target = slot(binding);
    target.written[0] = true;
    const VkDescriptorBufferInfo info{buffer.handle(), offset, range == 0 ? buffer.size() - offset : range};
    pend({binding, 0, target.type, info, {}});
}

void DescriptorSet::writeTexture(std::uint32_t binding, const GpuTexture& texture, VkSampler sampler,
                                 TextureState state, std::uint32_t element) {
    writeTextureView(binding, texture.view(), sampler, state, element);
}

void DescriptorSet::writeTextureView(std::uint32_t binding, VkImageView view, VkSampler sampler, TextureState state,
                                     std::uint32_t element) {
    assert(slot(binding).type == DescriptorType::CombinedImageSampler);
    assert(state == TextureState::Sampled || state == TextureState::DepthReadOnly);
    writeImage(binding, element, {sampler, view, layoutOf(state)});
}

void DescriptorSet::writeStorageImage(std::uint32_t binding, const GpuTexture& texture, std::uint32_t mip,
                                      std::uint32_t element) {
    assert(slot(binding).type == DescriptorType::StorageImage);
    writeImage(binding, element, {VK_NULL_HANDLE, texture.mipView(mip), VK_IMAGE_LAYOUT_GENERAL});
}

void DescriptorSet::writeImage(std::uint32_t binding, std::uint32_t element, VkDescriptorImageInfo info) {
    Slot& target = slot(binding);
    assert(element < target.count);
    target.written[element] = true;
    pend({binding, element, target.type, {}, info});
}

// One write a binding: an earlier one may name what is gone by now, where an error came between it and update().
void DescriptorSet::pend(const Pending& write) {
    std::erase_if(pending_, [&](const Pending& p) { return p.binding == write.binding && p.element == write.element; });
    pending_.push_back(write);
}

void DescriptorSet::update() {
    std::vector<VkWriteDescriptorSet> writes;
    for (const Pending& pending : pending_) {
        auto write = vkStruct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        write.dstSet = set_;
        write.dstBinding = pending.binding;
        write.dstArrayElement = pending.element;
        write.descriptorCount = 1;
        write.descriptorType = toVk(pending.type);
        write.pBufferInfo = &pending.buffer;  // Vulkan reads the one that belongs to the type
        write.pImageInfo = &pending.image;
        writes.push_back(write);
    }
    if (!writes.empty()) {
        vkUpdateDescriptorSets(device_->handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
    }
    pending_.clear();
}

bool DescriptorSet::isComplete() const {
    return std::all_of(slots_.begin(), slots_.end(), [](const Slot& slot) {
        return std::all_of(slot.written.begin(), slot.written.end(), [](bool written) { return written; });
    });
}

DescriptorPool::DescriptorPool(Device& device, std::uint32_t setsPerPool) : device_(device), setsPerPool_(setsPerPool) {
    assert(setsPerPool > 0);
}

DescriptorSet DescriptorPool::allocate(const SetLayout& layout, const std::string& name) {
    DescriptorSet set;
    const auto hasRoom = [&](const auto& block) { return tryAllocate(set, *block, layout); };
    if (std::none_of(blocks_.rbegin(), blocks_.rend(), hasRoom) && !tryAllocate(set, addBlock(layout), layout)) {
        throwVkError(VK_ERROR_OUT_OF_POOL_MEMORY, "vkAllocateDescriptorSets from a new pool");
    }
    device_.setName(VK_OBJECT_TYPE_DESCRIPTOR_SET, set.set_, name);
    set.dynamicCount_ = layout.dynamicCount();
    for (const SetLayoutBinding& binding : layout.bindings()) {
        set.slots_.push_back({binding.binding, binding.count, binding.type, std::vector<bool>(binding.count)});
    }
    return set;
}

bool DescriptorPool::tryAllocate(DescriptorSet& set, DescriptorBlock& block, const SetLayout& layout) {
    if (block.live == setsPerPool_) return false;
    auto info = vkStruct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    const VkDescriptorSetLayout handle = layout.handle();
    info.descriptorPool = block.pool.get();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &handle;
    VkDescriptorSet allocated = VK_NULL_HANDLE;
    const VkResult result = vkAllocateDescriptorSets(device_.handle(), &info, &allocated);
    if (result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL) return false;
    VK_CALL(result);
    set.device_ = &device_;
    set.block_ = &block;
    set.set_ = allocated;
    ++block.live;
    ++device_.live()[ObjectKind::DescriptorSet];
    return true;
}

DescriptorBlock& DescriptorPool::addBlock(const SetLayout& layout) {
    std::array<std::uint32_t, kTypes.size()> needed{};
    for (const SetLayoutBinding& binding : layout.bindings()) {
        needed[static_cast<std::size_t>(binding.type)] += binding.count;
    }
    std::array<VkDescriptorPoolSize, kTypes.size()> sizes{};
    for (std::size_t i = 0; i < kTypes.size(); ++i) {
        sizes[i] = {kTypes[i], std::max(kPerSet[i], needed[i]) * setsPerPool_};
    }
    auto info = vkStruct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    info.maxSets = setsPerPool_;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VK_CALL(vkCreateDescriptorPool(device_.handle(), &info, nullptr, &pool));
    auto block = std::make_unique<DescriptorBlock>();
    block->pool = own<vkDestroyDescriptorPool, ObjectKind::DescriptorPool>(device_, pool);
    return *blocks_.emplace_back(std::move(block));
}

}  // namespace crevice
