// Makes set 1 from what the shader declares, so that no slot is left unwritten.
#include "flow/ShaderBinding.h"

#include <algorithm>

#include "gfx/Device.h"

namespace crevice {
namespace {

constexpr std::uint32_t kMaterialSet = 1;

DescriptorType typeOf(ResourceKind kind) {
    switch (kind) {
        case ResourceKind::UniformBlock:
            return DescriptorType::UniformBuffer;
        case ResourceKind::CombinedSampler:
            return DescriptorType::CombinedImageSampler;
        case ResourceKind::StorageBuffer:
            return DescriptorType::StorageBuffer;
        case ResourceKind::StorageImage:
            return DescriptorType::StorageImage;
    }
    return DescriptorType::UniformBuffer;
}

std::vector<SetLayoutBinding> materialBindings(const ShaderInfo& info) {
    std::vector<SetLayoutBinding> bindings;
    for (const ShaderResource& resource : info.resources) {
        if (resource.slot.set != kMaterialSet) continue;
        bindings.push_back({.binding = resource.slot.binding, .type = typeOf(resource.kind), .count = resource.count});
    }
    return bindings;
}

}  // namespace

ShaderBinding::ShaderBinding(const BindingContext& context, const EffectVariant& variant, const Material& material)
    : setLayout_(context.device, materialBindings(variant.info), variant.name),
      set_(context.pool.allocate(setLayout_, variant.name)) {
    const std::uint64_t alignment =
        std::max<std::uint64_t>(context.device.limits().minUniformBufferOffsetAlignment, 16);
    std::uint64_t size = 0;
    for (const MaterialBlock& block : material.blocks()) {
        blockOffsets_.emplace_back(block.slot.binding, size);
        size += (block.bytes.size() + alignment - 1) / alignment * alignment;
    }
    if (size > 0) {
        blocks_ =
            Buffer(context.device, {.size = size, .usage = BufferUsage::Uniform, .name = variant.name + " material"});
        for (std::size_t i = 0; i < blockOffsets_.size(); ++i) {
            set_.writeUniformBuffer(blockOffsets_[i].first, blocks_, blockOffsets_[i].second,
                                    material.blocks()[i].bytes.size());
        }
        writeBlocks(material);
    }
    // Everything starts as white: a slot that is wired later overwrites it, and none stays empty.
    for (const ShaderResource& resource : variant.info.resources) {
        if (resource.slot.set != kMaterialSet || resource.kind != ResourceKind::CombinedSampler) continue;
        const GpuTexture& texture = resource.cube ? context.defaults.blackCube : context.defaults.white;
        for (std::uint32_t element = 0; element < resource.count; ++element) {
            set_.writeTexture(resource.slot.binding, texture, context.samplers.get(samplerKey(SamplerKind::PointClamp)),
                              TextureState::Sampled, element);
        }
    }
}

void ShaderBinding::writeBlocks(const Material& material) {
    for (std::size_t i = 0; i < blockOffsets_.size(); ++i)
        blocks_.write(material.blocks()[i].bytes, blockOffsets_[i].second);
}

void ShaderBinding::writeTextures(const BindingContext& context, const std::vector<Wire>& wires,
                                  const TargetPool& targets, const std::vector<std::string>& depthReadOnly) {
    for (const Wire& wire : wires) {
        if (wire.target.empty()) {
            const bool file = !wire.cube && isPictureFile(wire.texture);
            const GpuTexture* texture =
                file ? &context.files.get(wire.texture) : context.defaults.find(wire.texture, wire.cube);
            const SamplerKey key = file ? readPictureName(wire.texture).sampler : samplerKey(SamplerKind::LinearRepeat);
            if (texture && !(wire.cube && wire.texture == "white"))  // Own effects: cubes stay black.
                set_.writeTexture(wire.slot.binding, *texture, context.samplers.get(key));
            continue;
        }
        const GpuTexture& texture = targets.texture(wire.target);
        if (wire.storage) {
            set_.writeStorageImage(wire.slot.binding, texture, wire.mip);
            continue;
        }
        const bool tested = std::find(depthReadOnly.begin(), depthReadOnly.end(), wire.target) != depthReadOnly.end();
        const TextureState state = tested ? TextureState::DepthReadOnly : TextureState::Sampled;
        const VkSampler sampler = context.samplers.get(samplerKey(targets.desc(wire.target).sampler));
        set_.writeTextureView(wire.slot.binding, wire.oneMip ? texture.mipView(wire.mip) : texture.view(), sampler,
                              state);
    }
}

void ShaderBinding::writeSceneTextures(const std::vector<std::pair<BindingSlot, TextureRef>>& textures,
                                       const SceneGpu& scene) {
    for (const auto& [slot, ref] : textures)
        set_.writeTexture(slot.binding, scene.texture(ref.texture), scene.sampler(ref.texture));
}

}  // namespace crevice
