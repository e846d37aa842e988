// A scene's environment on the GPU: the blurred cube, the reflectance table, the block of diffuse light.
#pragma once

#include <memory>

#include "flow/FrameBlocks.h"
#include "flow/GlobalSet.h"
#include "scene/Environment.h"

namespace crevice {

/// What the shaders read. `levels`: of the cube.
EnvironmentBlock environmentBlock(const Environment& environment, std::uint32_t levels);

class EnvironmentGpu {
public:
    /// Uploads and waits. Blurs the environment when it brings no cube along.
    EnvironmentGpu(Device& device, const Environment& environment);
    /// For Cocos' effects: see CocosCube.h.
    EnvironmentGpu(Device& device, const Environment& environment, float scale);

    std::uint32_t levels() const { return cube_.desc().mips; }

    /// Puts everything into the slots of set 0 that exist there; GlobalSet::update() follows.
    void write(GlobalSet& globals, const GlobalLayout& layout) const;
    /// Lets go of what write() put there.
    static void writeNone(GlobalSet& globals, const GlobalLayout& layout);

private:
    GpuTexture cube_, table_, diffuse_;
    Buffer block_;
};

}  // namespace crevice
