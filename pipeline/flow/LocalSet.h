// Descriptor set 2 for effects that take the object's matrices from `CCLocal` instead of instance attributes.
#pragma once

#include <cstdint>

#include "flow/FrameBlocks.h"
#include "flow/GlobalSet.h"
#include "gfx/Commands.h"
#include "plan/ProfileSlots.h"

namespace crevice {

class LocalSet {
public:
    /// Every slot of the profile's set 2 holds something: zeroes or black where Crevice has nothing for it.
    LocalSet(Device& device, DescriptorPool& pool, SamplerCache& samplers, const DefaultTextures& defaults,
             Profile profile = Profile::Crevice);

    const SetLayout& setLayout() const { return setLayout_; }
    void beginFrame() { head_ = 0; }
    /// The lights that effects see; the GPU must be idle.
    void writeLights(const ForwardLightBlock& lights);
    /// Binds a new slice with the object's matrices. Throws RenderError when a frame draws too many such objects.
    void bind(Commands& commands, const glm::mat4& world);

private:
    void writeSlots(SamplerCache& samplers, const DefaultTextures& defaults, Profile profile);

    SetLayout setLayout_;
    Buffer ring_;
    Buffer zeroes_;
    GpuTexture storage_;  ///< For storage images; none in Crevice's own profile.
    DescriptorSet set_;
    std::uint64_t head_ = 0;
};

}  // namespace crevice
