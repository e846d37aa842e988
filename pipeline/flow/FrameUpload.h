// What every frame uploads before its stages run: the blocks of set 0 and the lights of set 2, as the profile has them.
#pragma once

#include "flow/FrameContext.h"
#include "flow/GlobalSet.h"
#include "flow/LocalSet.h"
#include "plan/PipelineDesc.h"

namespace crevice {

/// Returns how many lights found no room in Cocos' block of ten; 0 in Crevice's own profile.
int uploadFrame(GlobalSet& globals, LocalSet& locals, const PipelineDesc& desc, const FrameView& view,
                const Scene& scene);

}  // namespace crevice
