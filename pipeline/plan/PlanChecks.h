// What can be wrong with one stage's declarations, whatever the other stages do.
#pragma once

#include "plan/FramePlan.h"

namespace crevice {

/// Mip levels first … end-1 of a target; empty when the level does not exist.
struct LevelRange {
    std::uint32_t first = 0, end = 0;
    bool overlaps(const LevelRange& other) const { return first < other.end && other.first < end; }
};
LevelRange levelsOf(const TargetRead& read, const TargetDesc& target);
LevelRange levelsOf(const TargetWrite& write, const TargetDesc& target);

/// "colour", "depth" … are attachments; a storage image is not.
bool isAttachment(WriteKind kind);

/// The place of a read or write; where that is unknown, the stage's.
const SourceLoc& placeOf(const SourceLoc& own, const StageUse& stage);

/// A stage that chooses its targets in C++, not in the document's "writes": it may well offer more than is used.
bool isClassStage(const PipelineDesc& desc, const std::string& stage);

/// Whether a stage, enabled or not, reads or writes the target, or another target is made like it.
bool isMentioned(const PipelineDesc& desc, const std::vector<StageUse>& uses, const std::string& target);

/// Names, formats, levels, sizes, counts and feedback within one stage.
void checkStage(const PipelineDesc& desc, const StageUse& stage, Problems& problems);

}  // namespace crevice
