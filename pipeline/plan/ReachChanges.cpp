// Compares places by the age of their documents.
#include "plan/ReachChanges.h"

#include <algorithm>
#include <limits>

namespace crevice {
namespace {

/// The first root that holds a file; a document outside of all sees them all, as one in the first does.
std::size_t rootOf(const AssetRoots& roots, const std::filesystem::path& file) {
    for (std::size_t i = 0; i < roots.roots().size(); ++i)
        if (AssetRoots({roots.roots()[i]}).contains(file)) return i;
    return 0;
}

}  // namespace

void ReachChanges::addDocument(const std::string& file, bool isFlowFile) {
    ages_.emplace(file, next_);
    if (!isFlowFile) ++next_;
}

std::size_t ReachChanges::ageOf(const SourceLoc& where) const {
    const auto known = ages_.find(where.file);
    return known == ages_.end() ? std::numeric_limits<std::size_t>::max() : known->second;
}

void ReachChanges::noteStageKey(const std::string& stage, const std::string& key, const SourceLoc& where) {
    if (key != "effect" && key != "defines" && key != "reads" && key != "writes") return;
    std::size_t& age = stages_[stage];
    age = std::max(age, ageOf(where));
}

void ReachChanges::noteTargetKey(const Value& target, const std::string& key, const SourceLoc& where) {
    if (key != "scale" && key != "size" && key != "like") return;
    if (key == "size" && target.find("size")) return;  // no guard before, none after
    noteRemovedTarget(target, where);
}

void ReachChanges::noteRemovedTarget(const Value& target, const SourceLoc& where) {
    targets_.emplace_back(ageOf(target.where()), ageOf(where));
}

void ReachChanges::noteAll(const SourceLoc& where) { targets_.emplace_back(0, ageOf(where)); }

bool ReachChanges::isStale(const std::string& stage, const SourceLoc& reach) const {
    const std::size_t age = ageOf(reach);
    const auto changed = stages_.find(stage);
    if (changed != stages_.end() && age < changed->second) return true;
    return std::any_of(targets_.begin(), targets_.end(),
                       [&](const auto& change) { return change.first <= age && age < change.second; });
}

bool ReachChanges::isForAnotherEffect(const AssetRoots& roots, const std::string& effect,
                                      const SourceLoc& reach) const {
    if (!ages_.contains(reach.file)) return false;  // --set
    const auto found = roots.find(AssetKind::Effect, effect);
    return found && rootOf(roots, *found) < rootOf(roots, reach.file);
}

}  // namespace crevice
