// Every declared slot always holds something: white, a black cube, zeroes, until the frame's own is written.
#include "flow/GlobalSet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>

#include "gfx/Device.h"
#include "gfx/Readback.h"

namespace crevice {
namespace {

constexpr std::uint64_t kRingBytes = 8u << 20;
constexpr std::uint64_t kEmptyStorageBytes = 256;

GpuTexture makeDefault(Device& device, const std::string& name, const Image& image, std::uint32_t layers) {
    GpuTexture texture(device, {.format = Format::RGBA8,
                                .width = image.width,
                                .height = image.height,
                                .layers = layers,
                                .cube = layers == 6,
                                .usage = TextureUsage::Sampled | TextureUsage::TransferDest,
                                .name = name});
    // All layers go from Undefined to Sampled together, so each later layer starts from Sampled.
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        uploadTexture(device, texture, image, layer == 0 ? TextureState::Undefined : TextureState::Sampled,
                      TextureState::Sampled, 0, layer);
    }
    return texture;
}

GpuTexture onePixel(Device& device, const std::string& name, std::uint8_t r, std::uint8_t g, std::uint8_t b,
                    std::uint32_t layers = 1, std::uint8_t alpha = 255) {
    Image image(1, 1, Format::RGBA8);
    const std::uint8_t rgba[4] = {r, g, b, alpha};
    std::memcpy(image.pixels.data(), rgba, sizeof rgba);
    return makeDefault(device, name, image, layers);
}

/// Four squares of 8x8.
GpuTexture checkered(Device& device, const std::string& name, std::uint32_t layers) {
    constexpr std::uint32_t kSize = 16, kHalf = kSize / 2;
    Image image(kSize, kSize, Format::RGBA8);
    for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
        const bool light = (i % kSize < kHalf) == (i / kSize < kHalf);
        const std::uint8_t grey = light ? 221 : 85;
        const std::uint8_t rgba[4] = {grey, grey, grey, 255};
        std::memcpy(image.pixels.data() + std::size_t(i) * 4, rgba, sizeof rgba);
    }
    return makeDefault(device, name, image, layers);
}

DescriptorType descriptorType(GlobalKind kind) {
    switch (kind) {
        case GlobalKind::UniformBlock:
            return DescriptorType::UniformBufferDynamic;
        case GlobalKind::StorageBuffer:
            return DescriptorType::StorageBuffer;
        case GlobalKind::Sampler2D:
        case GlobalKind::SamplerCube:
            return DescriptorType::CombinedImageSampler;
    }
    return DescriptorType::CombinedImageSampler;
}

std::vector<SetLayoutBinding> layoutBindings(const GlobalLayout& layout) {
    std::vector<SetLayoutBinding> bindings;
    for (const GlobalSlot& slot : layout.slots())
        bindings.push_back({.binding = slot.binding, .type = descriptorType(slot.kind)});
    return bindings;
}

}  // namespace

SamplerKey samplerKey(SamplerKind kind) {
    SamplerKey key;
    switch (kind) {
        case SamplerKind::PointClamp:
            break;
        case SamplerKind::LinearClamp:
            key.minFilter = key.magFilter = Filter::Linear;
            break;
        case SamplerKind::LinearRepeat:
            key.minFilter = key.magFilter = Filter::Linear;
            key.wrapU = key.wrapV = SamplerWrap::Repeat;
            break;
        case SamplerKind::ShadowCompare:
            key.compare = CompareOp::LessEqual;
            break;
    }
    return key;
}

DefaultTextures::DefaultTextures(Device& device)
    : white(onePixel(device, "default white", 255, 255, 255)),
      black(onePixel(device, "default black", 0, 0, 0)),
      grey(onePixel(device, "default grey", 119, 119, 119)),
      normal(onePixel(device, "default normal", 127, 127, 255)),
      blackCube(onePixel(device, "default cube", 0, 0, 0, 6)),
      empty(onePixel(device, "default empty", 0, 0, 0, 1, 0)),
      checker(checkered(device, "default checker", 1)),
      checkerCube(checkered(device, "default checker cube", 6)) {}

const GpuTexture* DefaultTextures::find(std::string_view keyword, bool cube) const {
    if (cube) return keyword == "black" ? &blackCube : &checkerCube;
    if (keyword == "white") return &white;
    if (keyword == "black") return &black;
    if (keyword == "grey") return &grey;
    if (keyword == "normal") return &normal;
    if (keyword == "empty") return &empty;
    if (keyword == "default") return &checker;
    return nullptr;
}

GlobalSet::GlobalSet(Device& device, DescriptorPool& pool, SamplerCache& samplers, const GlobalLayout& layout,
                     const DefaultTextures& defaults)
    : device_(device),
      samplers_(samplers),
      layout_(layout),
      defaults_(defaults),
      setLayout_(device, layoutBindings(layout), "set 0"),
      ring_(device, {.size = kRingBytes, .usage = BufferUsage::Uniform, .name = "frame blocks"}),
      emptyStorage_(device, {.size = kEmptyStorageBytes, .usage = BufferUsage::Storage, .name = "empty storage"}),
      set_(pool.allocate(setLayout_, "global set")) {
    alignment_ = std::max<std::uint64_t>(device.limits().minUniformBufferOffsetAlignment, 256);
    std::memset(emptyStorage_.data().data(), 0, kEmptyStorageBytes);
    for (const GlobalSlot& slot : layout.slots()) {
        if (slot.kind == GlobalKind::UniformBlock) {
            blockIndex_.emplace(slot.name, offsets_.size());
            offsets_.push_back(0);
            zeroBytes_ = std::max<std::uint64_t>(zeroBytes_, slot.size);
        }
        writeDefault(slot);
    }
    set_.update();
    assert(set_.isComplete());
    zeroBytes_ = (zeroBytes_ + alignment_ - 1) / alignment_ * alignment_;
    std::memset(ring_.data().data(), 0, zeroBytes_);
    beginFrame();
}

void GlobalSet::writeDefault(const GlobalSlot& slot) {
    const VkSampler point = samplers_.get(samplerKey(SamplerKind::PointClamp));
    switch (slot.kind) {
        case GlobalKind::UniformBlock:
            set_.writeUniformBuffer(slot.binding, ring_, 0, slot.size);
            break;
        case GlobalKind::StorageBuffer:
            set_.writeStorageBuffer(slot.binding, emptyStorage_);
            break;
        case GlobalKind::Sampler2D:
            set_.writeTexture(slot.binding, defaults_.white, point);
            break;
        case GlobalKind::SamplerCube:
            set_.writeTexture(slot.binding, defaults_.blackCube, point);
            break;
    }
}

void GlobalSet::writeDefault(std::string_view name) {
    const GlobalSlot* slot = layout_.find(name);
    assert(slot);
    writeDefault(*slot);
}

void GlobalSet::writeImage(std::string_view name, const GpuTexture& texture, const SamplerKey& sampler) {
    const GlobalSlot* slot = layout_.find(name);
    assert(slot);
    set_.writeTexture(slot->binding, texture, samplers_.get(sampler));
}

void GlobalSet::writeBuffer(std::string_view name, const Buffer& buffer) {
    const GlobalSlot* slot = layout_.find(name);
    assert(slot && slot->kind == GlobalKind::StorageBuffer);
    set_.writeStorageBuffer(slot->binding, buffer);
}

void GlobalSet::beginFrame() {
    head_ = zeroBytes_;
    std::fill(offsets_.begin(), offsets_.end(), 0u);
    save();
}

void GlobalSet::upload(std::string_view block, std::span<const std::byte> bytes) {
    const auto found = blockIndex_.find(block);
    assert(found != blockIndex_.end());
    // The last slice must leave room for the whole range that its descriptor covers.
    if (head_ + std::max<std::uint64_t>(bytes.size(), zeroBytes_) > ring_.size()) {
        throw RenderError(
            fmt::format("a frame uploads more than {} MiB of block '{}' and others", kRingBytes >> 20, block),
            "upload per-object data through a storage buffer instead of a block");
    }
    ring_.write(bytes, head_);
    offsets_[found->second] = static_cast<std::uint32_t>(head_);
    head_ = (head_ + bytes.size() + alignment_ - 1) / alignment_ * alignment_;
}

void GlobalSet::restore() {
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
        if (saved_[i] != 0) offsets_[i] = saved_[i];  // slice 0 is the zeroes of a block that nobody uploaded
    }
}

void GlobalSet::bind(Commands& commands) const { commands.bindSet(0, set_, offsets_); }

}  // namespace crevice
