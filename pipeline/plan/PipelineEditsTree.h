// The flows and stages of a pipeline tree by name: what merging, edits and sets share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/Document.h"
#include "plan/PipelineEdits.h"

namespace crevice {

/// The array of flows of a merged tree.
std::vector<Value>& treeFlows(Value& document);
std::vector<Value>& flowStages(Value& flow);
const std::vector<Value>& flowStages(const Value& flow);
Value& stageAt(std::vector<Value>& flows, const TreePlace& place);

std::optional<TreePlace> findStage(const std::vector<Value>& flows, const std::string& name);
std::optional<std::size_t> findFlow(const std::vector<Value>& flows, const std::string& name);
std::vector<std::string> stageNames(const std::vector<Value>& flows);
std::vector<std::string> flowNames(const std::vector<Value>& flows);
/// Where a stage gets its name.
const SourceLoc& stageNameWhere(const Value& stage);

/// Adds a flow at the end, or with `byPriority` in front of the first flow of a greater one. A second flow of a name is
/// a problem.
void addFlow(std::vector<Value>& flows, const Value& flow, bool byPriority, Problems& problems);

/// Objects merge key by key, null removes, all else replaces.
void mergeKey(Value& object, const std::string& key, const Value& value, const SourceLoc& where);

}  // namespace crevice
