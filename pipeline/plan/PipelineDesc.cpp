// Look-ups in a pipeline description.
#include "plan/PipelineDesc.h"

namespace crevice {

const TargetDesc* PipelineDesc::findTarget(std::string_view target) const {
    for (const TargetDesc& candidate : targets)
        if (candidate.name == target) return &candidate;
    return nullptr;
}

}  // namespace crevice
