// A stack of conditions.
#include "cocos/flatten/DefinedPlaces.h"

#include <algorithm>

namespace crevice::cocos {
namespace {

/// X of `#ifndef X` and `#if !defined(X)`.
std::string guardedName(LineKind kind, std::string_view rest) {
    rest = trimBlank(rest);
    if (kind == LineKind::If) {
        if (!rest.starts_with('!')) return {};
        rest = trimBlank(rest.substr(1));
        if (leadingName(rest) != "defined") return {};
        rest = trimBlank(rest.substr(7));
        if (rest.starts_with('(') && rest.ends_with(')')) rest = trimBlank(rest.substr(1, rest.size() - 2));
    } else if (kind != LineKind::Ifndef) {
        return {};
    }
    const std::string_view name = leadingName(rest);
    return std::string(name.size() == rest.size() ? name : std::string_view());
}

}  // namespace

bool DefinedPlaces::follow(LineKind kind, std::string_view rest) {
    if (kind == LineKind::If || kind == LineKind::Ifdef || kind == LineKind::Ifndef) {
        if (frames_.size() == kMaxDepth) return false;
        Frame& frame = frames_.emplace_back();
        frame.step = {++next_, 0, numberOf(kind, trimBlank(rest))};
        frame.guarded = guardedName(kind, rest);
        return true;
    }
    if (frames_.empty()) return true;
    Frame& frame = frames_.back();
    endBranch(frame);
    if (kind != LineKind::Endif) {
        ++frame.step.branch;
        frame.step.condition = 0;
        frame.hasElse = frame.hasElse || kind == LineKind::Else;
        frame.isGuard = false;
        return true;
    }
    std::unordered_set<std::string> sure;
    if (frame.hasElse || frame.isGuard)
        sure.swap(frame.common);
    else if (frame.step.branch == 0 && frame.common.contains(frame.guarded))
        sure.insert(frame.guarded);  // It was defined before, or is now.
    frames_.pop_back();
    auto& outer = frames_.empty() ? top_ : frames_.back().defined;
    if (outer.size() < sure.size()) outer.swap(sure);
    outer.merge(sure);
    return true;
}

/// Equal conditions are true together as long as nothing in them is defined by the text.
std::uint32_t DefinedPlaces::numberOf(LineKind kind, std::string_view condition) {
    std::vector<std::string> names;
    for (std::size_t at = 0; at < condition.size();) {
        const std::string_view word = leadingName(condition.substr(at));
        at += std::max<std::size_t>(1, word.size());
        if (word.empty() || word == "defined") continue;
        names.emplace_back(word);
        if (seen_.contains(names.back())) return 0;
    }
    const char sign = kind == LineKind::If ? ' ' : kind == LineKind::Ifdef ? '+' : '-';
    const std::string key = sign + std::string(condition);
    const auto [known, isNew] = conditions_.try_emplace(key, next_);
    if (isNew)
        for (const std::string& name : names) conditionsWith_[name].push_back(key);
    return known->second;
}

void DefinedPlaces::forgetConditions(const std::string& name) {
    const auto known = conditionsWith_.find(name);
    if (known == conditionsWith_.end()) return;
    for (const std::string& condition : known->second) conditions_.erase(condition);
    conditionsWith_.erase(known);
}

void DefinedPlaces::endBranch(Frame& frame) {
    if (frame.step.branch == 0)
        frame.common.swap(frame.defined);
    else
        std::erase_if(frame.common, [&](const std::string& name) { return !frame.defined.contains(name); });
    frame.defined.clear();
}

void DefinedPlaces::define(std::string_view name) {
    const std::string key(name);
    const bool isNew = seen_.insert(key).second;
    forgetConditions(key);
    // A name that nothing has defined yet is no macro from outside either: those are not defined by the text.
    if (isNew && !frames_.empty() && frames_.back().step.branch == 0 && frames_.back().guarded == name)
        frames_.back().isGuard = true;
    (frames_.empty() ? top_ : frames_.back().defined).insert(key);
}

void DefinedPlaces::undefine(std::string_view name) {
    const std::string key(name);
    forgetConditions(key);
    top_.erase(key);
    for (Frame& frame : frames_) frame.defined.erase(key);
}

DefinedPlaces::Place DefinedPlaces::here() const {
    Place place;
    for (const Frame& frame : frames_) {
        if (!frame.isGuard) place.push_back(frame.step);
    }
    return place;
}

bool DefinedPlaces::isConditional() const {
    return std::any_of(frames_.begin(), frames_.end(), [](const Frame& frame) { return !frame.isGuard; });
}

bool DefinedPlaces::excludes(const Place& place) const {
    const std::size_t count = frames_.size();
    std::size_t at = 0;  // Both are in the order of their numbers.
    for (const Step& step : place) {
        while (at < count && frames_[at].step.id < step.id) ++at;
        if (at == count) return false;
        if (frames_[at].step.id == step.id && frames_[at].step.branch != step.branch) return true;
    }
    return false;
}

bool DefinedPlaces::implies(const Place& place) const {
    return std::all_of(place.begin(), place.end(), [&](const Step& step) {
        return std::any_of(frames_.begin(), frames_.end(), [&](const Frame& frame) {
            return (frame.step.id == step.id && frame.step.branch == step.branch) ||
                   (step.condition != 0 && frame.step.condition == step.condition);
        });
    });
}

bool DefinedPlaces::isSure(std::string_view name) const {
    const std::string key(name);
    return top_.contains(key) ||
           std::any_of(frames_.begin(), frames_.end(), [&](const Frame& frame) { return frame.defined.contains(key); });
}

}  // namespace crevice::cocos
