// Which document last changed what a stage's `reach` was measured on: an older `reach` does not hold any more.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/Document.h"
#include "core/Files.h"

namespace crevice {

/// Documents count from the oldest one on, a flow file as the document that names it; `--set` is younger than all. A
/// `reach` is stale when something younger than the place where it is written changed its stage's effect, macros or
/// wires, or the size of a target relative to the frame; so is one that was written for an effect which another root
/// replaces by one of the same name.
class ReachChanges {
public:
    /// In the order of the chain, before the document is merged.
    void addDocument(const std::string& file, bool isFlowFile);

    /// A key of a stage was changed at this place; only those that `reach` depends on count.
    void noteStageKey(const std::string& stage, const std::string& key, const SourceLoc& where);
    /// A key of a target, which is still as it was, is about to be changed. A `reach` that is older than the target
    /// itself was not measured on it.
    void noteTargetKey(const Value& target, const std::string& key, const SourceLoc& where);
    /// A target is taken out; another one may come in its place.
    void noteRemovedTarget(const Value& target, const SourceLoc& where);
    /// Something that every stage depends on.
    void noteAll(const SourceLoc& where);

    /// Whether something younger than the `reach` written at this place changed the stage.
    bool isStale(const std::string& stage, const SourceLoc& reach) const;
    /// Whether `effect` is found in a root that is searched before the one of the document which wrote the `reach`.
    bool isForAnotherEffect(const AssetRoots& roots, const std::string& effect, const SourceLoc& reach) const;

    /// Whether the place at `a` is in a younger document than `b`.
    bool isYounger(const SourceLoc& a, const SourceLoc& b) const { return ageOf(a) > ageOf(b); }

private:
    std::size_t ageOf(const SourceLoc& where) const;

    std::map<std::string, std::size_t> ages_;  ///< By file; greater is younger.
    std::size_t next_ = 1;
    std::map<std::string, std::size_t> stages_;                 ///< The youngest change of each stage.
    std::vector<std::pair<std::size_t, std::size_t>> targets_;  ///< Of each change: the target's age, and its own.
};

}  // namespace crevice
