// Descriptor set 0 itself: images and buffers by name, and a per-frame ring that blocks are uploaded into.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gfx/Commands.h"
#include "plan/GlobalNames.h"
#include "plan/PipelineDesc.h"

namespace crevice {

SamplerKey samplerKey(SamplerKind kind);

/// Textures that stand in where nothing is bound: some drivers crash on unwritten slots even when no shader uses them.
struct DefaultTextures {
    explicit DefaultTextures(Device& device);
    GpuTexture white, black, grey, normal, blackCube;
    // Cocos' further ones.
    GpuTexture empty;                 ///< Nothing at all: 0, 0, 0, 0.
    GpuTexture checker, checkerCube;  ///< 16x16 of two greys, 221 and 85: what a sampler shows that nothing feeds.
    /// By the keyword of an effect's property: white, black, grey, normal, and Cocos' empty and default; null for
    /// another word.
    const GpuTexture* find(std::string_view keyword, bool cube = false) const;
};

class GlobalSet {
public:
    GlobalSet(Device& device, DescriptorPool& pool, SamplerCache& samplers, const GlobalLayout& layout,
              const DefaultTextures& defaults);

    const SetLayout& setLayout() const { return setLayout_; }

    /// Before update(): what a slot holds from now on. The GPU must not be using the set.
    void writeImage(std::string_view name, const GpuTexture& texture, const SamplerKey& sampler);
    void writeImage(std::string_view name, const GpuTexture& texture, SamplerKind sampler) {
        writeImage(name, texture, samplerKey(sampler));
    }
    void writeBuffer(std::string_view name, const Buffer& buffer);
    /// Back to what the slot held at first: white, a black cube, zeroes.
    void writeDefault(std::string_view name);
    void update() { set_.update(); }

    /// The ring starts over; all blocks are zero until they are uploaded. The last frame must have finished.
    void beginFrame();
    /// A new slice of the block, valid for draws recorded after it. Throws RenderError when a frame uploads too much.
    void upload(std::string_view block, std::span<const std::byte> bytes);
    /// Blocks uploaded so far are the frame's own: restore() brings these back at the start of each stage, whatever a
    /// stage put in their place. Blocks uploaded later stay until they are uploaded again.
    void save() { saved_ = offsets_; }
    void restore();

    void bind(Commands& commands) const;

private:
    void writeDefault(const GlobalSlot& slot);

    Device& device_;
    SamplerCache& samplers_;
    const GlobalLayout& layout_;
    const DefaultTextures& defaults_;
    SetLayout setLayout_;
    Buffer ring_;
    Buffer emptyStorage_;
    DescriptorSet set_;
    std::map<std::string, std::size_t, std::less<>> blockIndex_;  ///< Block → its place among the dynamic offsets.
    std::vector<std::uint32_t> offsets_, saved_;
    std::uint64_t alignment_ = 256;
    std::uint64_t zeroBytes_ = 0;  ///< Start of the ring that stays zero.
    std::uint64_t head_ = 0;
};

}  // namespace crevice
