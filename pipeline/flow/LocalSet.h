// Descriptor set 2 for effects that take the object's matrices from `CCLocal` instead of instance attributes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "flow/CocosBlocks.h"
#include "flow/FrameBlocks.h"
#include "flow/GlobalSet.h"
#include "gfx/Commands.h"
#include "plan/ProfileSlots.h"

namespace crevice {

/// Lights that can be drawn one at a time.
inline constexpr std::size_t kSingleLights = 128;

class LocalSet {
public:
    /// Every slot of the profile's set 2 holds something: zeroes or black where Crevice has nothing for it.
    LocalSet(Device& device, DescriptorPool& pool, SamplerCache& samplers, const DefaultTextures& defaults,
             Profile profile = Profile::Crevice);

    const SetLayout& setLayout() const { return setLayout_; }
    /// Forgets the slices and the light of the frame before.
    void beginFrame();
    /// The lights that effects see; the GPU must be idle.
    void writeLights(const ForwardLightBlock& lights);
    /// At most kSingleLights; the GPU must be idle.
    void writeSingleLights(std::span<const SingleLightBlock> lights);
    /// From now on bind() offers this one of the single lights as CCForwardLight; nothing: all lights again.
    void useLight(std::optional<std::size_t> light);
    /// Binds a new slice with the object's matrices. Throws RenderError when a frame draws too many such objects.
    void bind(Commands& commands, const glm::mat4& world);
    /// The same for an instance of the scene, by its number: however often it is drawn, it takes one slice a frame.
    void bind(Commands& commands, std::uint32_t instance, const glm::mat4& world);

private:
    /// Where the slice with these matrices begins.
    std::uint32_t write(const glm::mat4& world);
    void bindSlice(Commands& commands, std::uint32_t offset);
    /// `lights` and its offset: what CCForwardLight shows.
    void writeSlots(DescriptorSet& set, const Buffer& lights, std::uint64_t offset, std::uint64_t bytes);

    DescriptorPool& pool_;
    SamplerCache& samplers_;
    const DefaultTextures& defaults_;
    Profile profile_;
    SetLayout setLayout_;
    Buffer ring_;
    Buffer zeroes_;
    GpuTexture storage_;  ///< For storage images; none in Crevice's own profile.
    DescriptorSet set_;
    Buffer singles_;
    std::vector<DescriptorSet> singleSets_;  ///< Made when they are first used.
    std::optional<std::size_t> light_;
    std::uint64_t head_ = 0;
    std::unordered_map<std::uint32_t, std::uint32_t> slices_;  ///< Of this frame: instance → offset.
};

}  // namespace crevice
