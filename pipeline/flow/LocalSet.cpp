// A ring of CCLocal slices, and the lights behind it.
#include "flow/LocalSet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <map>

#include "flow/CocosBlocks.h"
#include "gfx/Device.h"
#include "gfx/Readback.h"

namespace crevice {
namespace {

constexpr std::uint32_t kForwardLightBinding = 1;
constexpr std::uint64_t kSlice = 256;  // the largest alignment Vulkan allows for dynamic offsets
constexpr std::uint64_t kSlices = 16384;
constexpr std::uint64_t kRingBytes = kSlices * kSlice;
constexpr std::uint64_t kForwardLightBytes = sizeof(ForwardLightBlock);
constexpr std::uint64_t kZeroBytes = 2048;  // more than any block of the tables

DescriptorType descriptorType(LocalKind kind) {
    switch (kind) {
        case LocalKind::DynamicBlock:
            return DescriptorType::UniformBufferDynamic;
        case LocalKind::Block:
            return DescriptorType::UniformBuffer;
        case LocalKind::Sampler2D:
            return DescriptorType::CombinedImageSampler;
        case LocalKind::StorageImage:
            return DescriptorType::StorageImage;
    }
    return DescriptorType::UniformBuffer;
}

/// Names that share a number are one binding.
std::vector<SetLayoutBinding> layoutBindings(Profile profile) {
    std::vector<SetLayoutBinding> bindings;
    for (const LocalSlot& slot : localSlots(profile)) {
        if (!bindings.empty() && bindings.back().binding == slot.binding) continue;
        bindings.push_back({.binding = slot.binding, .type = descriptorType(slot.kind)});
    }
    return bindings;
}

bool hasStorage(Profile profile) {
    for (const LocalSlot& slot : localSlots(profile))
        if (slot.kind == LocalKind::StorageImage) return true;
    return false;
}

GpuTexture storageTexture(Device& device) {
    GpuTexture texture(device, {.usage = TextureUsage::Storage | TextureUsage::TransferDest, .name = "local storage"});
    Image black(1, 1, Format::RGBA8);
    uploadTexture(device, texture, black, TextureState::Undefined, TextureState::StorageWrite);
    return texture;
}

}  // namespace

LocalSet::LocalSet(Device& device, DescriptorPool& pool, SamplerCache& samplers, const DefaultTextures& defaults,
                   Profile profile)
    : pool_(pool),
      samplers_(samplers),
      defaults_(defaults),
      profile_(profile),
      setLayout_(device, layoutBindings(profile), "set 2"),
      // A slot may be read with a larger block than the slice it holds: the last one needs room behind it.
      ring_(device, {.size = kRingBytes + kZeroBytes + kForwardLightBytes,
                     .usage = BufferUsage::Uniform,
                     .name = "local blocks"}),
      zeroes_(device, {.size = kZeroBytes, .usage = BufferUsage::Uniform, .name = "local zeroes"}),
      set_(pool.allocate(setLayout_, "local set")),
      singles_(device, {.size = kSingleLights * kSlice, .usage = BufferUsage::Uniform, .name = "single lights"}) {
    std::memset(ring_.data().data() + kRingBytes, 0, kZeroBytes + kForwardLightBytes);
    std::memset(zeroes_.data().data(), 0, kZeroBytes);
    if (hasStorage(profile)) storage_ = storageTexture(device);
    writeSlots(set_, ring_, kRingBytes + kZeroBytes, kForwardLightBytes);
}

void LocalSet::writeSlots(DescriptorSet& set, const Buffer& lights, std::uint64_t offset, std::uint64_t bytes) {
    std::map<std::uint32_t, std::uint64_t> largest;  // Binding → bytes of the largest block that shares it.
    for (const LocalSlot& slot : localSlots(profile_))
        largest[slot.binding] = std::max<std::uint64_t>(largest[slot.binding], slot.size);
    for (const LocalSlot& slot : localSlots(profile_)) {
        switch (slot.kind) {
            case LocalKind::DynamicBlock:
                set.writeUniformBuffer(slot.binding, ring_, 0, largest[slot.binding]);
                break;
            case LocalKind::Block:
                if (slot.binding == kForwardLightBinding) {
                    set.writeUniformBuffer(slot.binding, lights, offset, bytes);
                } else {
                    set.writeUniformBuffer(slot.binding, zeroes_, 0, largest[slot.binding]);
                }
                break;
            case LocalKind::Sampler2D:
                set.writeTexture(slot.binding, defaults_.black, samplers_.get(samplerKey(SamplerKind::PointClamp)));
                break;
            case LocalKind::StorageImage:
                set.writeStorageImage(slot.binding, storage_);
                break;
        }
    }
    set.update();
}

void LocalSet::writeLights(const ForwardLightBlock& lights) {
    ring_.write(std::as_bytes(std::span(&lights, 1)), kRingBytes + kZeroBytes);
}

void LocalSet::writeSingleLights(std::span<const SingleLightBlock> lights) {
    assert(lights.size() <= kSingleLights);
    for (std::size_t i = 0; i < lights.size(); ++i) singles_.write(std::as_bytes(lights.subspan(i, 1)), i * kSlice);
}

void LocalSet::useLight(std::optional<std::size_t> light) {
    light_ = light;
    while (light && singleSets_.size() <= *light) {
        const std::uint64_t offset = singleSets_.size() * kSlice;
        singleSets_.push_back(pool_.allocate(setLayout_, "local set of one light"));
        writeSlots(singleSets_.back(), singles_, offset, kSlice);
    }
}

void LocalSet::beginFrame() {
    head_ = 0;
    slices_.clear();
    light_.reset();  // an error may have kept a stage from doing so
}

std::uint32_t LocalSet::write(const glm::mat4& world) {
    if (head_ + kSlice > kRingBytes) {
        throw RenderError(fmt::format("a frame draws more than {} objects whose effect reads 'CCLocal'", kSlices),
                          "take the matrices from a_matWorld0 to a_matWorld2 instead: equal meshes are then one draw");
    }
    LocalBlock36 block;  // begins as that of 3.3 does
    block.world = world;
    block.worldIT = glm::transpose(glm::inverse(world));
    ring_.write(std::as_bytes(std::span(&block, 1)), head_);
    const std::uint32_t offset = static_cast<std::uint32_t>(head_);
    head_ += kSlice;
    return offset;
}

void LocalSet::bindSlice(Commands& commands, std::uint32_t offset) {
    commands.bindSet(2, light_ ? singleSets_[*light_] : set_, std::span(&offset, 1));
}

void LocalSet::bind(Commands& commands, const glm::mat4& world) { bindSlice(commands, write(world)); }

void LocalSet::bind(Commands& commands, std::uint32_t instance, const glm::mat4& world) {
    auto slice = slices_.find(instance);
    if (slice == slices_.end()) slice = slices_.emplace(instance, write(world)).first;
    bindSlice(commands, slice->second);
}

}  // namespace crevice
