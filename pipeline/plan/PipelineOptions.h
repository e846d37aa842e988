// Options of a pipeline document: their declarations, the caller's choices, and what `$name` stands for.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/Document.h"
#include "plan/PipelineDesc.h"
#include "plan/PipelineEdits.h"

namespace crevice {

/// Reads the "options" of a merged tree and puts the caller's values in force (type, range and choice checked).
std::vector<OptionDesc> readOptions(const Value& document, const std::map<std::string, std::string>& requested,
                                    Problems& problems);

/// Drops choices' sets on stages that edits removed, checks the paths of the others.
void checkChoiceSets(PipelineTree& tree, Problems& problems);

/// Applies the sets that the values in force carry; their paths have been checked. A set of "$NAME" is the value of a
/// number option that was left at `auto`.
void applyChoiceSets(PipelineTree& tree, std::vector<OptionDesc>& options);

/// Replaces "$name" in targets, flows and stages by the option's value at the place of use, and `enabled` by a bool.
void substituteOptions(Value& document, const std::vector<OptionDesc>& options, Problems& problems);

/// For `flatten` with options kept: values in force become defaults, and sets that `--set` overrides are dropped.
/// So is what `auto` stands for where it is not the default, and every `reach` that is stale in some choice.
void keepOptions(PipelineTree& tree, const std::vector<OptionDesc>& options, const std::vector<std::string>& setPaths);

}  // namespace crevice
