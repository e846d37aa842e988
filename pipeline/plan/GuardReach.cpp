// One pass over the stages, backwards.
#include "plan/GuardReach.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace crevice {
namespace {

constexpr double kFloatNoisePixels = 0.01;
constexpr double kMostTexelsAcross = 4;  ///< The guard is a multiple of so many pixels: see guardPixels().

using Needs = std::map<std::string, std::uint32_t, std::less<>>;  ///< Target → pixels of the frame.

std::uint32_t& growTo(std::uint32_t& pixels, std::uint32_t least) { return pixels = std::max(pixels, least); }

std::uint32_t roundedUp(double pixels) {
    return pixels < kWholeGuard ? static_cast<std::uint32_t>(std::ceil(pixels - kFloatNoisePixels)) : kWholeGuard;
}

/// Pixels of the frame that so many pixels of a target's level are.
double framePixels(double pixels, const TargetDesc& target, std::uint32_t mip) {
    return std::ldexp(pixels, static_cast<int>(mip)) / target.scale;
}

/// Whether the frame begins at a texel, and pixels are a whole number of texels, or texels of pixels.
bool isAligned(const TargetDesc& target) {
    const double scale = target.scale;
    return (scale >= 1 && scale == std::floor(scale)) || scale == 1.0 / 2 || scale == 1 / kMostTexelsAcross;
}

/// By how many pixels of the frame the texels of a level stick out of a part of it that they cover: all of a texel but
/// the first bit of it; where texels are not aligned, the frame itself is rounded, too (see frameCrop()).
double overhang(const TargetDesc& target, std::uint32_t mip) {
    if (target.size) return 0;
    const double across = 1.0 / target.scale;
    return isAligned(target) ? framePixels(1, target, mip) - std::min(1.0, across)
                             : framePixels(1, target, mip) + across;
}

/// What whole texels add to what a stage reads. In a grid of the same texels nothing: both are rounded alike. In
/// another one, each texel that is drawn reads from all of the frame that it covers, and the same place by coordinates
/// from 0 to 1 is shifted by up to the overhang of the coarser one: sizes of one frame are rounded differently.
double rounding(const PipelineDesc& desc, const TargetWrite& write, const TargetRead& read) {
    const TargetDesc &to = *desc.findTarget(write.target), *from = desc.findTarget(read.target);
    if (!from || from->size) return 0;
    if (from->scale == to.scale && read.mip == write.mip && isAligned(to)) return 0;
    return overhang(to, write.mip) + std::max(overhang(to, write.mip), overhang(*from, read.mip));
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

/// What it must find around the frame in one target that it reads.
std::uint32_t neededBy(const PipelineDesc& desc, const PlannedStage& stage, std::optional<std::uint32_t> reach,
                       const TargetRead& read) {
    if (!reach || stage.beyond == kWholeGuard) return kWholeGuard;
    const TargetWrite& write = stage.writes.front().write;
    const TargetDesc& target = *desc.findTarget(write.target);
    return roundedUp(stage.beyond + framePixels(*reach, target, write.mip) + rounding(desc, write, read));
}

}  // namespace

void planGuard(const PipelineDesc& desc, FramePlan& plan) {
    Needs needs;
    for (auto stage = plan.stages.rbegin(); stage != plan.stages.rend(); ++stage) {
        stage->beyond = beyondOf(desc, *stage, needs);
        for (const PlannedWrite& planned : stage->writes) growTo(needs[planned.write.target], stage->beyond);
        for (const TargetRead& read : stage->reads)
            growTo(needs[read.target], neededBy(desc, *stage, plan.uses[stage->use].reach, read));
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
