// Descriptor set 2 for effects that take the object's matrices from `CCLocal` instead of instance attributes.
#pragma once

#include <cstdint>

#include "flow/FrameBlocks.h"
#include "gfx/Commands.h"

namespace crevice {

class LocalSet {
public:
    LocalSet(Device& device, DescriptorPool& pool);

    const SetLayout& setLayout() const { return setLayout_; }
    void beginFrame() { head_ = 0; }
    /// The scene's lights; the GPU must be idle.
    void writeLights(const ForwardLightBlock& lights);
    /// Binds a new slice with the object's matrices. Throws RenderError when a frame draws too many such objects.
    void bind(Commands& commands, const glm::mat4& world);

private:
    SetLayout setLayout_;
    Buffer ring_;
    DescriptorSet set_;
    std::uint64_t head_ = 0;
};

}  // namespace crevice
