// What a Cocos pipeline would leave out of the picture without a word.
#pragma once

#include "flow/FrameProgram.h"

namespace crevice {

/// Warns of queues whose phases no pass of the scene's materials has, and of materials that no queue of an enabled
/// stage draws (as Cocos' deferred pipeline leaves out opaque unlit ones).
void reportUndrawn(const PipelineDesc& desc, const std::vector<StageProgram>& stages, const Scene& scene,
                   EffectLibrary& library, Problems& problems);

}  // namespace crevice
