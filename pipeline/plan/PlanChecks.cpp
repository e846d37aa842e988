// What can be wrong with one stage's declarations, whatever the other stages do.
#include "plan/PlanChecks.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/Text.h"
#include "plan/TargetSize.h"

namespace crevice {
namespace {

constexpr std::size_t kMaxColorAttachments = 8;

std::vector<std::string> targetNames(const PipelineDesc& desc) {
    std::vector<std::string> names;
    for (const TargetDesc& target : desc.targets) names.push_back(target.name);
    return names;
}

bool isDepth(const TargetDesc& target) { return formatInfo(target.format).isDepth; }
const char* formatName(const TargetDesc& target) { return formatInfo(target.format).name; }

/// The checks of one stage, each with its own message.
class StageCheck {
public:
    StageCheck(const PipelineDesc& desc, const StageUse& stage, Problems& problems)
        : desc_(desc), stage_(stage), problems_(problems) {}

    void run() {
        if (stage_.writes.empty()) {
            problems_.error(stage_.where, fmt::format("'{}' writes no target", stage_.stage),
                            "name a target in \"writes\", or remove the stage: nothing of it can be seen");
        }
        for (const TargetRead& read : stage_.reads) checkRead(read);
        for (const TargetWrite& write : stage_.writes) checkWrite(write);
        checkSizes();
        checkColorCount();
        checkTwice();
        checkFeedback();
        checkMixedReads();
    }

private:
    const TargetDesc* findTarget(const std::string& name) const {
        for (const TargetDesc& target : desc_.targets) {
            if (target.name == name) return &target;
        }
        return nullptr;
    }

    /// The declared target with that level, or null after an error.
    const TargetDesc* resolve(const std::string& name, std::uint32_t mip, const SourceLoc& where, const char* verb) {
        const TargetDesc* target = findTarget(name);
        if (!target) {
            problems_.error(where, fmt::format("'{}' {} '{}', which is no target", stage_.stage, verb, name),
                            didYouMean(name, targetNames(desc_), "targets"));
        } else if (mip >= target->mips) {
            problems_.error(
                where,
                fmt::format("'{}' {} level {} of '{}', which has {}", stage_.stage, verb, mip, name, target->mips),
                fmt::format("set \"mips\" of '{}' to {} or more, or name a level below {}", name, mip + 1,
                            target->mips),
                {{target->where, fmt::format("'{}' is declared here", name)}});
            return nullptr;
        }
        return target;
    }

    void checkRead(const TargetRead& read) {
        const SourceLoc& where = placeOf(read.where, stage_);
        const TargetDesc* target = resolve(read.target, read.mip, where, "reads");
        if (target && read.storage) checkStorage(*target, where, "reads");
    }

    void checkWrite(const TargetWrite& write) {
        const SourceLoc& where = placeOf(write.where, stage_);
        const bool tests = write.kind == WriteKind::DepthTest;
        const TargetDesc* target = resolve(write.target, write.mip, where, tests ? "tests against" : "writes");
        if (!target) return;
        const Remark declared{target->where, fmt::format("'{}' is declared here", target->name)};
        if (write.kind == WriteKind::Storage) {
            checkStorage(*target, where, "writes");
        } else if (stage_.compute) {
            problems_.error(where,
                            fmt::format("'{}' is a compute stage and cannot have '{}' as an attachment", stage_.stage,
                                        target->name),
                            "write it by imageStore");
        } else if (write.kind == WriteKind::Color && isDepth(*target)) {
            problems_.error(where,
                            fmt::format("'{}' writes colour to '{}', whose format {} is a depth format", stage_.stage,
                                        target->name, formatName(*target)),
                            "write to a colour target, such as R32F for depth as a number", {declared});
        } else if (write.kind != WriteKind::Color && !isDepth(*target)) {
            problems_.error(where,
                            fmt::format("'{}' uses '{}' as depth, but its format {} is a colour format", stage_.stage,
                                        target->name, formatName(*target)),
                            "give the target the format D32F", {declared});
        }
    }

    void checkStorage(const TargetDesc& target, const SourceLoc& where, const char* verb) {
        const bool depth = isDepth(target);
        if (!depth && target.format != Format::RGBA8_SRGB) return;
        problems_.error(
            where,
            fmt::format("'{}' {} '{}' as a storage image, which its format {} does not allow", stage_.stage, verb,
                        target.name, formatName(target)),
            depth ? "sample it by a sampler2D, or copy it to an R32F target" : "give the target the format RGBA8",
            {{target.where, fmt::format("'{}' is declared here", target.name)}});
    }

    /// Fixed sizes compare as pixels, scaled ones by scale and level: equal at one frame size is not equal at all.
    static bool sameSize(const TargetDesc& a, std::uint32_t mipA, const TargetDesc& b, std::uint32_t mipB) {
        if (a.size && b.size) return glm::uvec2(targetExtent(a, 1, 1, mipA)) == glm::uvec2(targetExtent(b, 1, 1, mipB));
        return !a.size && !b.size && a.scale == b.scale && mipA == mipB;
    }

    static std::string sizeText(const TargetDesc& target, std::uint32_t mip) {
        const std::string level = mip > 0 ? fmt::format(", level {}", mip) : "";
        if (target.size) return fmt::format("{}×{}{}", target.size->x, target.size->y, level);
        return fmt::format("scale {}{}", target.scale, level);
    }

    void checkSizes() {
        const TargetWrite* first = nullptr;
        for (const TargetWrite& write : stage_.writes) {
            const TargetDesc* target = findTarget(write.target);
            if (!target || !isAttachment(write.kind) || write.mip >= target->mips) continue;
            if (!first) {
                first = &write;
                continue;
            }
            const TargetDesc& other = *findTarget(first->target);
            if (sameSize(other, first->mip, *target, write.mip)) continue;
            problems_.error(
                placeOf(write.where, stage_),
                fmt::format("'{}' writes '{}' ({}) and '{}' ({}) together, but their sizes differ", stage_.stage,
                            other.name, sizeText(other, first->mip), target->name, sizeText(*target, write.mip)),
                fmt::format("declare '{}' with \"like\": \"{}\", or write it in a stage of its own", target->name,
                            other.name),
                {{other.where, fmt::format("'{}' is declared here", other.name)},
                 {target->where, fmt::format("'{}' is declared here", target->name)}});
            return;
        }
    }

    void checkColorCount() {
        std::size_t count = 0;
        for (const TargetWrite& write : stage_.writes) count += write.kind == WriteKind::Color ? 1 : 0;
        if (count <= kMaxColorAttachments) return;
        problems_.error(stage_.where,
                        fmt::format("'{}' writes {} colour targets; a stage can have {}", stage_.stage, count,
                                    kMaxColorAttachments),
                        "split it into two stages");
    }

    void checkTwice() {
        std::size_t depthCount = 0;
        for (std::size_t i = 0; i < stage_.writes.size(); ++i) {
            const TargetWrite& write = stage_.writes[i];
            for (std::size_t j = 0; j < i; ++j) {
                const TargetWrite& earlier = stage_.writes[j];
                if (write.target != earlier.target || write.mip != earlier.mip) continue;
                problems_.error(placeOf(write.where, stage_),
                                fmt::format("'{}' names '{}' twice among its outputs", stage_.stage, write.target),
                                "remove one of the two", {{placeOf(earlier.where, stage_), "it is first named here"}});
                return;
            }
            if (!isAttachment(write.kind) || write.kind == WriteKind::Color || ++depthCount < 2) continue;
            problems_.error(
                placeOf(write.where, stage_),
                fmt::format("'{}' has more than one depth target; '{}' is the second", stage_.stage, write.target),
                "a stage has one depth target: remove one");
            return;
        }
    }

    void checkFeedback() {
        for (const TargetRead& read : stage_.reads) {
            const TargetDesc* target = findTarget(read.target);
            if (!target) continue;
            for (const TargetWrite& write : stage_.writes) {
                if (write.target != read.target || !levelsOf(read, *target).overlaps(levelsOf(write, *target)))
                    continue;
                if (write.kind == WriteKind::DepthTest) continue;
                const bool depth = write.kind == WriteKind::DepthWrite;
                problems_.error(
                    placeOf(read.where, stage_), fmt::format("'{}' reads and writes '{}'", stage_.stage, read.target),
                    depth ? "a depth target may be sampled by a stage that tests against it and does not write it"
                          : "write to another target and read that one afterwards",
                    {{placeOf(write.where, stage_), "it is written here"}});
                return;
            }
        }
    }

    void checkMixedReads() {
        for (const TargetRead& read : stage_.reads) {
            const TargetDesc* target = findTarget(read.target);
            if (!target || !read.storage) continue;
            for (const TargetRead& other : stage_.reads) {
                if (other.storage || other.target != read.target ||
                    !levelsOf(read, *target).overlaps(levelsOf(other, *target)))
                    continue;
                problems_.error(
                    placeOf(read.where, stage_),
                    fmt::format("'{}' reads '{}' both by a sampler and by imageLoad", stage_.stage, read.target),
                    "read it one way: texelFetch is imageLoad for a sampler",
                    {{placeOf(other.where, stage_), "it is sampled here"}});
                return;
            }
        }
    }

    const PipelineDesc& desc_;
    const StageUse& stage_;
    Problems& problems_;
};

LevelRange oneLevel(std::uint32_t mip, const TargetDesc& target) {
    return mip < target.mips ? LevelRange{mip, mip + 1} : LevelRange{};
}

}  // namespace

LevelRange levelsOf(const TargetRead& read, const TargetDesc& target) {
    if (read.mip == 0 && !read.oneMip) return {0, target.mips};
    return oneLevel(read.mip, target);
}

LevelRange levelsOf(const TargetWrite& write, const TargetDesc& target) { return oneLevel(write.mip, target); }

bool isAttachment(WriteKind kind) { return kind != WriteKind::Storage; }

const SourceLoc& placeOf(const SourceLoc& own, const StageUse& stage) { return own.file.empty() ? stage.where : own; }

bool isClassStage(const PipelineDesc& desc, const std::string& stage) {
    for (const FlowDesc& flow : desc.flows) {
        for (const StageDesc& candidate : flow.stages) {
            if (candidate.name == stage) return candidate.writes.empty();
        }
    }
    return false;
}

bool isMentioned(const PipelineDesc& desc, const std::vector<StageUse>& uses, const std::string& target) {
    const auto names = [&](const auto& wire) { return wire.target == target; };
    const auto isUsed = [&](const StageUse& use) {
        return std::any_of(use.writes.begin(), use.writes.end(), names) ||
               std::any_of(use.reads.begin(), use.reads.end(), names);
    };
    return std::any_of(uses.begin(), uses.end(), isUsed) ||
           std::any_of(desc.targets.begin(), desc.targets.end(),
                       [&](const TargetDesc& other) { return other.like == target; });
}

void checkStage(const PipelineDesc& desc, const StageUse& stage, Problems& problems) {
    StageCheck(desc, stage, problems).run();
}

}  // namespace crevice
