// What can be wrong with the stages of a document, without a device and before any effect is compiled.
#pragma once

#include "flow/StageIo.h"

namespace crevice {

class StageRegistry;

/// Throws Error with every unknown class, wrong param and misplaced list.
void checkStages(const PipelineDesc& desc, const StageRegistry& registry, RunInfo run);

}  // namespace crevice
