// One pass over the ordered stages: the state of every target level, what must happen between stages, and what makes no
// sense.
#include "plan/FramePlan.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "core/Text.h"
#include "plan/GuardReach.h"
#include "plan/PlanChecks.h"

namespace crevice {
namespace {

constexpr std::size_t kNobody = ~std::size_t(0);

/// One mip level of a target, as the pass over the stages goes on.
struct LevelState {
    TargetState state = TargetState::Undefined;
    std::size_t firstWriter = kNobody;  ///< Use of the frame's first write, found before the pass.
    std::size_t lastWriter = kNobody;   ///< Use of the latest write so far.
    bool readSince = false;             ///< Somebody saw what lastWriter wrote.
    bool everRead = false;
};

struct TargetTrack {
    const TargetDesc* desc = nullptr;
    std::vector<LevelState> levels;
    bool written = false;
};

bool writesContent(WriteKind kind) { return kind != WriteKind::DepthTest; }
bool isWriteState(TargetState state) {
    return state == TargetState::Color || state == TargetState::Depth || state == TargetState::StorageWrite;
}

TargetState stateFor(WriteKind kind) {
    switch (kind) {
        case WriteKind::Color:
            return TargetState::Color;
        case WriteKind::DepthTest:
            return TargetState::DepthReadOnly;
        case WriteKind::DepthWrite:
            return TargetState::Depth;
        case WriteKind::Storage:
            return TargetState::StorageWrite;
    }
    return TargetState::Undefined;
}

class Planner {
public:
    Planner(const PipelineDesc& desc, std::vector<StageUse> uses) : desc_(desc) { plan_.uses = std::move(uses); }

    FramePlan run() {
        trackTargets();
        findFirstWriters();
        for (std::size_t use = 0; use < plan_.uses.size(); ++use) {
            if (!plan_.uses[use].enabled) continue;
            checkStage(desc_, plan_.uses[use], problems_);
            planStage(use);
        }
        planOutput();
        restoreNeverWritten();
        if (!problems_.hasErrors()) reportUnread();
        problems_.throwIfErrors();
        planGuard(desc_, plan_);
        plan_.notes = std::move(problems_);
        return std::move(plan_);
    }

private:
    void trackTargets() {
        for (const TargetDesc& target : desc_.targets) {
            index_[target.name] = tracks_.size();
            tracks_.push_back({&target, std::vector<LevelState>(target.mips), false});
            TargetLife life;
            life.target = target.name;
            plan_.lives.push_back(std::move(life));
        }
    }

    void findFirstWriters() {
        for (std::size_t use = 0; use < plan_.uses.size(); ++use) {
            if (!plan_.uses[use].enabled) continue;
            for (const TargetWrite& write : plan_.uses[use].writes) {
                TargetTrack* track = find(write.target);
                if (!track || !writesContent(write.kind)) continue;
                const LevelRange range = levelsOf(write, *track->desc);
                for (std::uint32_t level = range.first; level < range.end; ++level) {
                    std::size_t& first = track->levels[level].firstWriter;
                    first = std::min(first, use);
                    track->written = true;
                }
            }
        }
        for (std::size_t i = 0; i < tracks_.size(); ++i) {
            if (tracks_[i].written) continue;
            for (LevelState& level : tracks_[i].levels) level.state = TargetState::Sampled;
            TargetLife& life = plan_.lives[i];
            life.neverWritten = life.sampled = life.transferDest = true;
        }
    }

    /// Reads come first, in the order the stage gives them, then writes: the order of the transitions in the table.
    void planStage(std::size_t use) {
        const StageUse& stage = plan_.uses[use];
        PlannedStage planned;
        planned.use = use;
        planned.reads = stage.reads;
        for (const TargetRead& read : stage.reads) {
            TargetTrack* track = find(read.target);
            if (!track) continue;
            const LevelRange range = levelsOf(read, *track->desc);
            checkReadOrder(*track, range, use, placeOf(read.where, stage), "reads");
            const bool tested = isTested(stage, read.target);
            const TargetState state = tested         ? TargetState::DepthReadOnly
                                      : read.storage ? TargetState::StorageRead
                                                     : TargetState::Sampled;
            moveTo(*track, range, state, planned.before);
            markRead(*track, range);
            noteUsage(*track, state, true);
        }
        for (const TargetWrite& write : stage.writes) planWrite(use, write, planned);
        plan_.stages.push_back(std::move(planned));
    }

    void planWrite(std::size_t use, const TargetWrite& write, PlannedStage& planned) {
        const StageUse& stage = plan_.uses[use];
        PlannedWrite result{write, false};
        if (TargetTrack* track = find(write.target)) {
            const LevelRange range = levelsOf(write, *track->desc);
            const TargetState state = stateFor(write.kind);
            const SourceLoc& where = placeOf(write.where, stage);
            if (!writesContent(write.kind)) checkReadOrder(*track, range, use, where, "tests against");
            // A tested depth that is sampled too has moved already.
            moveTo(*track, range, state, planned.before);
            for (std::uint32_t i = range.first; i < range.end && !writesContent(write.kind); ++i)
                markTested(track->levels[i]);
            for (std::uint32_t i = range.first; i < range.end && writesContent(write.kind); ++i) {
                LevelState& level = track->levels[i];
                result.clears = level.lastWriter == kNobody;
                warnOverwrite(level, use, write);
                level.lastWriter = use;
                level.readSince = false;
            }
            noteUsage(*track, state, false);
        }
        planned.writes.push_back(std::move(result));
    }

    /// Brings levels into a state. The same transition on all levels is one transition of the target.
    void moveTo(TargetTrack& track, LevelRange range, TargetState to, std::vector<Transition>& out) {
        std::vector<Transition> moves;
        for (std::uint32_t i = range.first; i < range.end; ++i) {
            LevelState& level = track.levels[i];
            if (level.state == to && !isWriteState(to)) continue;
            moves.push_back({track.desc->name, level.state, to, i});
            level.state = to;
        }
        const bool whole =
            moves.size() == track.levels.size() && !moves.empty() &&
            std::all_of(moves.begin(), moves.end(), [&](const Transition& m) { return m.from == moves[0].from; });
        if (whole) {
            moves.resize(1);
            moves[0].mip = kAllMips;
        }
        out.insert(out.end(), moves.begin(), moves.end());
    }

    void checkReadOrder(const TargetTrack& track, LevelRange range, std::size_t use, const SourceLoc& where,
                        const char* verb) {
        const StageUse& stage = plan_.uses[use];
        for (std::uint32_t i = range.first; i < range.end; ++i) {
            const LevelState& level = track.levels[i];
            if (!track.written) {
                noteClearValue(track, use, where, verb);
                return;
            }
            if (level.firstWriter == kNobody) {
                problems_.error(
                    where,
                    fmt::format("'{}' {} level {} of '{}', which no enabled stage writes", stage.stage, verb, i,
                                track.desc->name),
                    fmt::format("write every level that is read, or read one that is written, as in \"{}@0\"",
                                track.desc->name),
                    withStage(use, where, {track.desc->where, fmt::format("'{}' is declared here", track.desc->name)}));
                return;
            }
            if (level.firstWriter <= use)
                continue;  // written before, or by this stage: that is feedback, reported as such
            const StageUse& writer = plan_.uses[level.firstWriter];
            problems_.error(
                where,
                fmt::format("'{}' {} '{}' before '{}' writes it", stage.stage, verb, track.desc->name, writer.stage),
                fmt::format("place '{}' before '{}' in the document (\"before\": \"{}\" in an insert)", writer.stage,
                            stage.stage, stage.stage),
                withStage(use, where, {writer.where, placeInFlow(level.firstWriter)}));
            return;
        }
    }

    /// A remark, and where the stage stands when its shader is the place of the problem.
    std::vector<Remark> withStage(std::size_t use, const SourceLoc& where, Remark remark) const {
        std::vector<Remark> remarks{std::move(remark)};
        const SourceLoc& stage = plan_.uses[use].where;
        if (where.file != stage.file || where.line != stage.line) remarks.push_back({stage, placeInFlow(use)});
        return remarks;
    }

    std::string placeInFlow(std::size_t use) const {
        const StageUse& stage = plan_.uses[use];
        const auto position =
            std::count_if(plan_.uses.begin(), plan_.uses.begin() + static_cast<std::ptrdiff_t>(use) + 1,
                          [&](const StageUse& other) { return other.flow == stage.flow; });
        return fmt::format("'{}' is stage {} of '{}'", stage.stage, position, stage.flow);
    }

    /// Once per target: nobody writes it, which is right for an effect that is switched off.
    void noteClearValue(const TargetTrack& track, std::size_t use, const SourceLoc& where, const char* verb) {
        const std::string& name = track.desc->name;
        if (std::find(noted_.begin(), noted_.end(), name) != noted_.end()) return;
        noted_.push_back(name);
        const glm::vec4& clear = track.desc->clear;
        const std::string value = formatInfo(track.desc->format).isDepth
                                      ? fmt::format("{}", clear.x)
                                      : fmt::format("{}, {}, {}, {}", clear.x, clear.y, clear.z, clear.w);
        std::string help;
        for (const StageUse& other : plan_.uses) {
            const auto writes = [&](const TargetWrite& write) {
                return write.target == name && writesContent(write.kind);
            };
            if (!other.enabled && std::any_of(other.writes.begin(), other.writes.end(), writes)) {
                help = fmt::format("'{}' writes it when it is enabled", other.stage);
                break;
            }
        }
        problems_.note(where,
                       fmt::format("'{}' {} '{}', which no enabled stage writes: it holds its clear value ({})",
                                   plan_.uses[use].stage, verb, name, value),
                       help);
    }

    void warnOverwrite(const LevelState& level, std::size_t use, const TargetWrite& write) {
        const StageUse& stage = plan_.uses[use];
        const bool overwrites =
            write.kind == WriteKind::Storage || (write.kind == WriteKind::Color && !write.blends && !testsDepth(stage));
        if (!overwrites || level.lastWriter == kNobody || level.lastWriter == use || level.readSince) return;
        const StageUse& earlier = plan_.uses[level.lastWriter];
        warn(placeOf(write.where, stage),
             fmt::format("'{}' writes over '{}', which '{}' wrote and nobody has read", stage.stage, write.target,
                         earlier.stage),
             "blend, test depth, or write to another target", {{earlier.where, placeInFlow(level.lastWriter)}});
    }

    void warn(const SourceLoc& where, std::string message, std::string help, std::vector<Remark> remarks) {
        problems_.add(
            Error({Problem{Severity::Warning, where, std::move(message), std::move(help), std::move(remarks)}}));
    }

    void planOutput() {
        plan_.output = desc_.output;
        TargetTrack* track = find(desc_.output);
        if (!track) {
            std::vector<std::string> names;
            for (const TargetDesc& target : desc_.targets) names.push_back(target.name);
            problems_.error(desc_.outputWhere, fmt::format("the output '{}' is no target", desc_.output),
                            didYouMean(desc_.output, names, "targets"));
            return;
        }
        if (track->levels.empty() || track->levels[0].lastWriter == kNobody) {
            problems_.error(desc_.outputWhere, fmt::format("no enabled stage writes the output '{}'", desc_.output),
                            "add or enable a stage that writes it, or name another target in \"output\"",
                            {{track->desc->where, fmt::format("'{}' is declared here", desc_.output)}});
            return;
        }
        moveTo(*track, {0, 1}, TargetState::TransferSource, plan_.atEnd);
        markRead(*track, {0, 1});
        lifeOf(*track).transferSource = true;
    }

    void restoreNeverWritten() {
        for (TargetTrack& track : tracks_) {
            const LevelRange all{0, static_cast<std::uint32_t>(track.levels.size())};
            if (!track.written) moveTo(track, all, TargetState::Sampled, plan_.atEnd);
            if (!track.levels.empty()) lifeOf(track).atEnd = track.levels[0].state;
        }
    }

    /// Depth that is written is tested by its own stage, so it is never "unread".
    void reportUnread() {
        for (const TargetTrack& track : tracks_) {
            const std::string& name = track.desc->name;
            const auto read = [](const LevelState& level) { return level.everRead; };
            const bool depth = formatInfo(track.desc->format).isDepth;
            if (depth || std::any_of(track.levels.begin(), track.levels.end(), read)) continue;
            const auto written = std::find_if(track.levels.begin(), track.levels.end(),
                                              [](const LevelState& level) { return level.lastWriter != kNobody; });
            if (written == track.levels.end()) continue;
            const StageUse& writer = plan_.uses[written->lastWriter];
            const std::string message =
                fmt::format("'{}' writes '{}', which no stage reads and which is not the output", writer.stage, name);
            const std::vector<Remark> remarks{{track.desc->where, fmt::format("'{}' is declared here", name)}};
            const bool isUseful = std::any_of(writer.writes.begin(), writer.writes.end(), [&](const auto& other) {
                const TargetTrack* output = find(other.target);
                return output && std::any_of(output->levels.begin(), output->levels.end(), read);
            });
            if (isClassStage(desc_, writer.stage) || isUseful) {
                // Inherited, it offers to the child what the parent needed: no fault of the child's.
                if (desc_.path.empty() || writer.where.file == desc_.path) problems_.note(writer.where, message);
            } else {
                warn(writer.where, message, "read it in a later stage, or remove the stage", remarks);
            }
        }
        for (const TargetTrack& track : tracks_) {
            if (isMentioned(desc_, plan_.uses, track.desc->name) || track.desc->name == desc_.output) continue;
            // A child that removes stages of its parent cannot take the parent's targets out: no fault of its own.
            if (!desc_.path.empty() && track.desc->where.file != desc_.path) continue;
            warn(track.desc->where, fmt::format("no stage reads or writes the target '{}'", track.desc->name),
                 "remove it", {});
        }
    }

    static bool isTested(const StageUse& stage, const std::string& target) {
        return std::any_of(stage.writes.begin(), stage.writes.end(), [&](const TargetWrite& write) {
            return write.target == target && write.kind == WriteKind::DepthTest;
        });
    }

    static bool testsDepth(const StageUse& stage) {
        return std::any_of(stage.writes.begin(), stage.writes.end(), [](const TargetWrite& write) {
            return write.kind == WriteKind::DepthTest || write.kind == WriteKind::DepthWrite;
        });
    }

    static void markTested(LevelState& level) { level.readSince = level.everRead = true; }
    static void markRead(TargetTrack& track, LevelRange range) {
        for (std::uint32_t i = range.first; i < range.end; ++i) markTested(track.levels[i]);
    }

    void noteUsage(const TargetTrack& track, TargetState state, bool read) {
        TargetLife& life = lifeOf(track);
        const int stage = static_cast<int>(plan_.stages.size());
        if (life.firstUse < 0) life.firstUse = stage;
        life.lastUse = stage;
        life.color |= state == TargetState::Color;
        life.depth |= state == TargetState::Depth || (state == TargetState::DepthReadOnly && !read);
        life.sampled |= state == TargetState::Sampled || (state == TargetState::DepthReadOnly && read);
        life.storage |= state == TargetState::StorageRead || state == TargetState::StorageWrite;
    }

    TargetTrack* find(const std::string& name) {
        const auto found = index_.find(name);
        return found == index_.end() ? nullptr : &tracks_[found->second];
    }
    TargetLife& lifeOf(const TargetTrack& track) {
        return plan_.lives[static_cast<std::size_t>(&track - tracks_.data())];
    }

    const PipelineDesc& desc_;
    FramePlan plan_;
    Problems problems_;
    std::vector<TargetTrack> tracks_;
    std::map<std::string, std::size_t, std::less<>> index_;
    std::vector<std::string> noted_;
};

}  // namespace

FramePlan planFrame(const PipelineDesc& desc, std::vector<StageUse> uses) {
    return Planner(desc, std::move(uses)).run();
}

const char* stateName(TargetState state) {
    static constexpr std::array<const char*, 9> kNames{"undefined",       "color",           "depth",
                                                       "depth-read-only", "sampled",         "storage-read",
                                                       "storage-write",   "transfer-source", "transfer-dest"};
    return kNames[static_cast<std::size_t>(state)];
}

}  // namespace crevice
