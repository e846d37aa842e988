// The last step of loading: a merged tree with options resolved → PipelineDesc, every name in it checked.
#pragma once

#include <string>
#include <vector>

#include "core/Document.h"
#include "plan/PipelineDesc.h"

namespace crevice {

PipelineDesc readPipelineTree(const Value& document, std::vector<OptionDesc> options, const std::string& file,
                              Problems& problems);

}  // namespace crevice
