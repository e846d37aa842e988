// Reads the "targets" and "blocks" of a merged pipeline document, `like` resolved.
#pragma once

#include <vector>

#include "core/Document.h"
#include "plan/PipelineDesc.h"

namespace crevice {

std::vector<TargetDesc> readTargets(const Value& targets, Problems& problems);
std::vector<BlockPin> readBlocks(const Value& blocks, Problems& problems);

}  // namespace crevice
