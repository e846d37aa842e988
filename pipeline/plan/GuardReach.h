// How much of a guard each stage has to draw: what the stages behind it read, and no more.
#pragma once

#include <cstdint>

#include "plan/FramePlan.h"
#include "plan/TargetSize.h"

namespace crevice {

/// Fills in PlannedStage::beyond, from the last stage to the first: nothing beyond the frame is needed of any target
/// for itself, but a stage that draws n pixels beyond it and reads r pixels away (StageUse::reach) needs n + r of what
/// it reads, and the whole guard where nobody says how far it reads. From one size of targets to
/// another, n is widened to whole pixels of both. A stage draws as much of every
/// target that it writes; what it draws on, or tests against, must reach as far. Targets of a fixed size have no guard:
/// their writers draw all, and reading them asks for nothing.
void planGuard(const PipelineDesc& desc, FramePlan& plan);

/// The part of level `mip` of a target that a stage draws which needs `beyond` pixels around a frame of width x height
/// with `guard` pixels on each side: at least what shows the frame (see frameCrop()), widened to whole pixels.
FrameCrop drawnPart(const TargetDesc& target, glm::uvec2 frame, std::uint32_t guard, std::uint32_t beyond,
                    std::uint32_t mip = 0);

}  // namespace crevice
