// The document's targets as textures at one frame size. Stages never see it: they speak names.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "gfx/Commands.h"
#include "plan/FramePlan.h"

namespace crevice {

class TargetPool {
public:
    /// Makes nothing yet: resize() does.
    /// `stencils`: depth targets that passes with a stencil test draw into.
    TargetPool(Device& device, const PipelineDesc& desc, const FramePlan& plan, std::set<std::string> stencils = {});

    /// Throws Error with the sum when the targets do not fit the device's heap or limits at this size.
    void checkFits(glm::uvec2 extent) const;
    /// Makes the targets anew. The GPU must be idle.
    void resize(glm::uvec2 extent);
    glm::uvec2 extent() const { return extent_; }

    const GpuTexture& texture(std::string_view target) const;
    const TargetDesc& desc(std::string_view target) const;
    Format format(std::string_view target) const { return desc(target).format; }
    bool hasStencil(std::string_view target) const { return stencils_.contains(std::string(target)); }
    /// Bytes that the targets hold.
    std::uint64_t bytes() const;

private:
    GpuTexture makeTexture(const TargetDesc& target, const TargetLife& life, glm::uvec2 extent) const;
    void clearUnwritten();
    std::string guardRemark() const;

    Device& device_;
    const PipelineDesc& desc_;
    const FramePlan& plan_;
    std::set<std::string> stencils_;
    glm::uvec2 extent_{0};
    std::map<std::string, GpuTexture, std::less<>> textures_;
};

/// The plan's states in the words of gfx: the two enums have one order.
inline TextureState textureState(TargetState state) { return static_cast<TextureState>(state); }
static_assert(static_cast<int>(TargetState::TransferDest) == static_cast<int>(TextureState::TransferDest));

}  // namespace crevice
