// Changes to a pipeline document as a tree: merging a child into its parent, `edits`, and `NAME.key = value`.
#pragma once

#include <string>
#include <vector>

#include "core/Document.h"
#include "plan/PipelineAsset.h"
#include "plan/ReachChanges.h"

namespace crevice {

/// A document while it is put together.
struct PipelineTree {
    Value document;                    ///< Top-level object; flows and stages are well formed.
    std::vector<std::string> removed;  ///< Stages and flows that edits took out: sets of options on them are dropped.
    ReachChanges reach{};              ///< What a stage's `reach` has to be younger than.
};

/// Name of a stage object: "name", or else its class.
const std::string& stageName(const Value& stage);

/// A stage or flow in a tree.
struct TreePlace {
    std::size_t flow = 0;
    std::size_t stage = 0;
};

/// Merges a document (without its edits) into the tree: maps by key, flows by priority or at the end.
void mergeDocument(PipelineTree& tree, const Value& document, Problems& problems);

/// Applies a document's "edits" in order.
void applyEdits(PipelineTree& tree, const Value& document, const PriorityLookup& defaultPriority, Problems& problems);

/// Sets one value by path ("SsaoStage.params.seed", "aoRaw.scale", "LightingFlow.enabled"). `where` is the place of the
/// path. With `dryRun` only the path is checked.
void applySet(PipelineTree& tree, const std::string& path, const Value& value, const SourceLoc& where,
              Problems& problems, bool dryRun = false);

/// Applies the caller's `--set` list.
void applySets(PipelineTree& tree, const std::vector<StageSet>& sets, Problems& problems);

/// Text of an argument as a value: JSON, or a string when it is a bare word. `where` becomes the place of every value
/// in it.
Value parseArgument(const std::string& text, const SourceLoc& where);

}  // namespace crevice
