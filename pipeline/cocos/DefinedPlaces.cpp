// A stack of conditions.
#include "cocos/DefinedPlaces.h"

#include <algorithm>

namespace crevice::cocos {
namespace {

constexpr std::size_t kMaxSteps = 32;  ///< Of deeper nesting the outer ones are told apart.

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

void DefinedPlaces::follow(LineKind kind, std::string_view rest) {
    if (kind == LineKind::If || kind == LineKind::Ifdef || kind == LineKind::Ifndef) {
        const char sign = kind == LineKind::If ? ' ' : kind == LineKind::Ifdef ? '+' : '-';
        Frame& frame = frames_.emplace_back();
        frame.step = {++next_, 0, &*conditions_.insert(sign + std::string(trimBlank(rest))).first};
        frame.guarded = guardedName(kind, rest);
        return;
    }
    if (frames_.empty()) return;
    Frame& frame = frames_.back();
    endBranch(frame);
    if (kind != LineKind::Endif) {
        ++frame.step.branch;
        frame.step.condition = nullptr;
        frame.hasElse = frame.hasElse || kind == LineKind::Else;
        frame.isGuard = false;
        return;
    }
    std::unordered_set<std::string> sure;
    if (frame.hasElse || frame.isGuard) sure.swap(frame.common);
    frames_.pop_back();
    auto& outer = frames_.empty() ? top_ : frames_.back().defined;
    if (outer.size() < sure.size()) outer.swap(sure);
    outer.merge(sure);
}

void DefinedPlaces::endBranch(Frame& frame) {
    if (frame.step.branch == 0)
        frame.common.swap(frame.defined);
    else
        std::erase_if(frame.common, [&](const std::string& name) { return !frame.defined.contains(name); });
    frame.defined.clear();
}

void DefinedPlaces::define(std::string_view name) {
    if (!frames_.empty() && frames_.back().step.branch == 0 && frames_.back().guarded == name)
        frames_.back().isGuard = true;
    (frames_.empty() ? top_ : frames_.back().defined).emplace(name);
}

void DefinedPlaces::undefine(std::string_view name) {
    const std::string key(name);
    top_.erase(key);
    for (Frame& frame : frames_) frame.defined.erase(key);
}

DefinedPlaces::Place DefinedPlaces::here() const {
    Place place;
    for (const Frame& frame : frames_) {
        if (place.size() == kMaxSteps) break;
        if (!frame.isGuard) place.push_back(frame.step);
    }
    return place;
}

bool DefinedPlaces::isConditional() const {
    return std::any_of(frames_.begin(), frames_.end(), [](const Frame& frame) { return !frame.isGuard; });
}

bool DefinedPlaces::excludes(const Place& place) const {
    const std::size_t count = std::min(frames_.size(), 2 * kMaxSteps);
    std::size_t at = 0;  // Both are in the order of their numbers.
    for (const Step& step : place) {
        while (at < count && frames_[at].step.id < step.id) ++at;
        if (at == count) return false;
        if (frames_[at].step.id == step.id && frames_[at].step.branch != step.branch) return true;
    }
    return false;
}

bool DefinedPlaces::implies(const Place& place) const {
    const std::size_t count = std::min(frames_.size(), 2 * kMaxSteps);
    return std::all_of(place.begin(), place.end(), [&](const Step& step) {
        return std::any_of(frames_.begin(), frames_.begin() + std::ptrdiff_t(count), [&](const Frame& frame) {
            return (frame.step.id == step.id && frame.step.branch == step.branch) ||
                   (step.condition != nullptr && frame.step.condition == step.condition);
        });
    });
}

bool DefinedPlaces::isSure(std::string_view name) const {
    const std::string key(name);
    return top_.contains(key) ||
           std::any_of(frames_.begin(), frames_.end(), [&](const Frame& frame) { return frame.defined.contains(key); });
}

}  // namespace crevice::cocos
