// What every frame uploads before its stages run: the blocks of set 0 and the lights of set 2, as the profile has them.
#pragma once

#include <vector>

#include "flow/CocosShadow.h"
#include "flow/FrameContext.h"
#include "flow/GlobalSet.h"
#include "flow/LocalSet.h"
#include "plan/PipelineDesc.h"

namespace crevice {

/// One of the lights that Cocos' forward pipeline draws one at a time, in the order of LocalSet's single lights.
struct LitLight {
    Aabb reach;                     ///< World space.
    std::vector<std::byte> shadow;  ///< Block CCShadow.
};

struct FrameLights {
    int left = 0;                  ///< Lights that the view sees and that found no room.
    std::vector<LitLight> single;  ///< Of a forward pipeline.
};

/// In the layouts and units of the pipeline's profile. `environmentLevels`: mips of cc_environment.
FrameLights uploadFrame(GlobalSet& globals, LocalSet& locals, const PipelineDesc& desc, const FrameView& view,
                        const Scene& scene, const Aabb& bounds, std::uint32_t environmentLevels);

}  // namespace crevice
