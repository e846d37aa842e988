// One pass over the stages, backwards.
#include "plan/GuardReach.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace crevice {
namespace {

constexpr double kFloatNoisePixels = 0.01;

using Needs = std::map<std::string, std::uint32_t, std::less<>>;  ///< Target → pixels of the frame.

std::uint32_t& growTo(std::uint32_t& pixels, std::uint32_t least) { return pixels = std::max(pixels, least); }

/// Pixels of the frame that so many pixels of a target's level are.
std::uint32_t framePixels(std::uint32_t pixels, const TargetDesc& target, std::uint32_t mip) {
    const double exact = std::ldexp(static_cast<double>(pixels), static_cast<int>(mip)) / target.scale;
    return exact < kWholeGuard ? static_cast<std::uint32_t>(std::ceil(exact - kFloatNoisePixels)) : kWholeGuard;
}

/// What a stage must draw for those behind it; all of it where it writes something without a guard, or nothing.
std::uint32_t beyondOf(const PipelineDesc& desc, const PlannedStage& stage, Needs& needs) {
    if (stage.writes.empty()) return kWholeGuard;
    std::uint32_t beyond = 0;
    for (const PlannedWrite& planned : stage.writes) {
        const TargetDesc* target = desc.findTarget(planned.write.target);
        if (!target || target->size) return kWholeGuard;
        growTo(beyond, needs[planned.write.target]);
    }
    return beyond;
}

/// What it must find around the frame in what it reads.
std::uint32_t neededBy(const PipelineDesc& desc, const PlannedStage& stage, std::optional<std::uint32_t> reach) {
    if (!reach || stage.beyond == kWholeGuard) return kWholeGuard;
    const TargetWrite& write = stage.writes.front().write;
    const std::uint64_t needed =
        std::uint64_t(stage.beyond) + framePixels(*reach, *desc.findTarget(write.target), write.mip);
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(needed, kWholeGuard));
}

}  // namespace

void planGuard(const PipelineDesc& desc, FramePlan& plan) {
    Needs needs;
    for (auto stage = plan.stages.rbegin(); stage != plan.stages.rend(); ++stage) {
        stage->beyond = beyondOf(desc, *stage, needs);
        const std::uint32_t needed = neededBy(desc, *stage, plan.uses[stage->use].reach);
        for (const PlannedWrite& planned : stage->writes) growTo(needs[planned.write.target], stage->beyond);
        for (const TargetRead& read : stage->reads) growTo(needs[read.target], needed);
    }
}

FrameCrop drawnPart(const TargetDesc& target, glm::uvec2 frame, std::uint32_t guard, std::uint32_t beyond,
                    std::uint32_t mip) {
    const glm::uvec2 larger = frame + 2 * guard;
    const glm::uvec2 whole(targetExtent(target, larger.x, larger.y, mip));
    if (target.size || beyond >= guard) return {{0, 0}, whole};
    const FrameCrop crop = frameCrop(target, frame.x, frame.y, guard);
    const double scale = target.scale;
    const auto edge = [&](double framePixels) { return std::round(framePixels * scale * 4096) / 4096; };
    const auto first = static_cast<std::uint32_t>(std::floor(edge(guard - beyond)));
    const auto last = [&](std::uint32_t side) {
        return static_cast<std::uint32_t>(std::ceil(edge(double(guard) + side + beyond)));
    };
    const glm::uvec2 begin = glm::min(crop.offset, glm::uvec2(first));
    const glm::uvec2 end = glm::max(crop.offset + crop.extent, glm::uvec2(last(frame.x), last(frame.y)));
    const std::uint32_t level = 1u << std::min(mip, 31u);
    const glm::uvec2 offset = glm::min(begin / level, whole - 1u);
    return {offset, glm::min((end + level - 1u) / level, whole) - offset};
}

}  // namespace crevice
