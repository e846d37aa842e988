// Every frame of two or three stages over one or two targets, judged by rules of its own and by a simulated machine.
#include <array>
#include <optional>

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "plan/FramePlan.h"

namespace crevice {
namespace {

/// What one stage does with one target.
struct Touch {
    bool sampled = false, loaded = false;  ///< Read by a sampler, by imageLoad.
    bool color = false, depthTest = false, depthWrite = false, stored = false;
    bool reads() const { return sampled || loaded; }
    bool writes() const { return color || depthWrite || stored; }
    bool any() const { return reads() || writes() || depthTest; }
};
using StageTouches = std::vector<Touch>;  ///< Per target.
using Frame = std::vector<StageTouches>;  ///< Per stage.

const std::array<const char*, 2> kNames{"a", "b"};

std::string describe(const Frame& frame, const std::vector<bool>& depthFormat) {
    std::string text;
    for (std::size_t t = 0; t < depthFormat.size(); ++t)
        text += fmt::format("{}:{} ", kNames[t], depthFormat[t] ? "depth" : "colour");
    for (const StageTouches& stage : frame) {
        text += "[";
        for (std::size_t t = 0; t < stage.size(); ++t) {
            const Touch& touch = stage[t];
            if (!touch.any()) continue;
            text += fmt::format(" {}:{}{}{}{}{}{}", kNames[t], touch.sampled ? "s" : "", touch.loaded ? "l" : "",
                                touch.color ? "C" : "", touch.depthTest ? "T" : "", touch.depthWrite ? "D" : "",
                                touch.stored ? "S" : "");
        }
        text += " ]";
    }
    return text;
}

/// The rules in the test's own words: true when a frame must be refused. The output is target 0.
bool mustRefuse(const Frame& frame, const std::vector<bool>& depthFormat) {
    bool outputWritten = false;
    for (std::size_t s = 0; s < frame.size(); ++s) {
        bool writesSomething = false;
        int depthAttachments = 0;
        for (std::size_t t = 0; t < frame[s].size(); ++t) {
            const Touch& touch = frame[s][t];
            writesSomething |= touch.writes() || touch.depthTest;
            depthAttachments += touch.depthTest || touch.depthWrite ? 1 : 0;
            if (depthFormat[t] ? touch.color || touch.stored || touch.loaded : touch.depthTest || touch.depthWrite)
                return true;
            if (touch.sampled && touch.loaded) return true;    // two layouts at once
            if (touch.reads() && touch.writes()) return true;  // feedback
            const bool needsContent = touch.reads() || touch.depthTest;
            bool before = false, after = false;
            for (std::size_t other = 0; other < frame.size(); ++other) {
                if (frame[other][t].writes()) (other < s ? before : after) = true;
            }
            if (needsContent && !before && after) return true;
            if (t == 0) outputWritten |= touch.writes();
        }
        if (!writesSomething || depthAttachments > 1) return true;
    }
    return !outputWritten;
}

PipelineDesc describeTargets(const std::vector<bool>& depthFormat) {
    PipelineDesc desc;
    for (std::size_t t = 0; t < depthFormat.size(); ++t) {
        TargetDesc target;
        target.name = kNames[t];
        target.format = depthFormat[t] ? Format::D32F : Format::RGBA8;
        desc.targets.push_back(target);
    }
    desc.output = kNames[0];
    return desc;
}

std::vector<StageUse> usesOf(const Frame& frame) {
    std::vector<StageUse> uses;
    for (std::size_t s = 0; s < frame.size(); ++s) {
        StageUse use;
        use.stage = fmt::format("S{}", s);
        use.flow = "F";
        for (std::size_t t = 0; t < frame[s].size(); ++t) {
            const Touch& touch = frame[s][t];
            if (touch.sampled) use.reads.push_back({kNames[t], false, 0, "", {}});
            if (touch.loaded) use.reads.push_back({kNames[t], true, 0, "", {}});
            if (touch.color) use.writes.push_back({kNames[t], WriteKind::Color, false, 0, {}});
            if (touch.depthTest) use.writes.push_back({kNames[t], WriteKind::DepthTest, false, 0, {}});
            if (touch.depthWrite) use.writes.push_back({kNames[t], WriteKind::DepthWrite, false, 0, {}});
            if (touch.stored) use.writes.push_back({kNames[t], WriteKind::Storage, false, 0, {}});
        }
        uses.push_back(use);
    }
    return uses;
}

/// An image as the device sees it: what a transition makes visible and what an access needs.
struct Image {
    TargetState state = TargetState::Undefined;
    bool writePending = false;  ///< A write no transition has waited for.
    bool readPending = false;   ///< A read no transition has waited for: a write would race with it.
    bool content = false;       ///< Holds this frame's content or its clear value.
};

class Machine {
public:
    Machine(const FramePlan& plan, const Frame& frame) : plan_(plan), frame_(frame), images_(plan.lives.size()) {
        for (std::size_t t = 0; t < images_.size(); ++t) {
            if (plan.lives[t].neverWritten) images_[t] = {TargetState::Sampled, false, false, true};
        }
    }

    /// Empty when the frame is sound, else what is wrong. May be called again: a frame follows a frame.
    std::string runFrame() {
        for (std::size_t t = 0; t < images_.size(); ++t) {
            if (!plan_.lives[t].neverWritten) images_[t].content = false;
            firstTouch_.assign(images_.size(), true);
        }
        if (plan_.stages.size() != frame_.size()) return "stages are missing";
        for (std::size_t s = 0; s < frame_.size(); ++s) {
            if (std::string wrong = runStage(s); !wrong.empty()) return fmt::format("S{}: {}", s, wrong);
        }
        for (const Transition& move : plan_.atEnd) {
            if (std::string wrong = apply(move); !wrong.empty()) return "at end: " + wrong;
        }
        const Image& output = images_[0];
        if (output.state != TargetState::TransferSource || output.writePending || !output.content)
            return "the output is not readable";
        for (std::size_t t = 0; t < images_.size(); ++t) {
            if (plan_.lives[t].neverWritten && images_[t].state != TargetState::Sampled)
                return "a constant target is left elsewhere";
            if (plan_.lives[t].atEnd != images_[t].state) return "atEnd is wrong";
        }
        return {};
    }

private:
    std::string runStage(std::size_t s) {
        const PlannedStage& planned = plan_.stages[s];
        std::vector<int> moved(images_.size(), 0);
        for (const Transition& move : planned.before) {
            const std::size_t t = move.target == kNames[0] ? 0 : 1;
            if (++moved[t] > 1) return "two transitions of one target";
            if (!frame_[s][t].any()) return "a transition of a target that is not touched";
            if (std::string wrong = apply(move); !wrong.empty()) return wrong;
        }
        for (std::size_t t = 0; t < images_.size(); ++t) {
            if (std::string wrong = access(frame_[s][t], images_[t]); !wrong.empty())
                return fmt::format("{}: {}", kNames[t], wrong);
        }
        for (const PlannedWrite& write : planned.writes) {
            Image& image = images_[write.write.target == kNames[0] ? 0 : 1];
            const bool writesContent = write.write.kind != WriteKind::DepthTest;
            if (write.clears != (writesContent && !image.content))
                return "clears a target that has content, or does not clear one";
            if (writesContent) image.content = true;
        }
        return {};
    }

    std::string apply(const Transition& move) {
        const std::size_t t = move.target == kNames[0] ? 0 : 1;
        Image& image = images_[t];
        const bool discards = move.from == TargetState::Undefined;
        if (move.mip != kAllMips) return "a level of a target without levels";
        if (discards != (firstTouch_[t] && !plan_.lives[t].neverWritten))
            return "content is discarded, or garbage is kept";
        if (!discards && move.from != image.state) return "a transition from a state the target is not in";
        if (move.from == move.to && !image.writePending) return "a redundant transition";
        firstTouch_[t] = false;
        image.state = move.to;
        image.writePending = image.readPending = false;
        return {};
    }

    static std::string access(const Touch& touch, Image& image) {
        if (!touch.any()) return {};
        if ((touch.any()) && image.writePending) return "an access races with a write";
        if (touch.writes() && image.readPending) return "a write races with a read";
        if ((touch.reads() || touch.depthTest) && !image.content) return "garbage is read";
        const TargetState state = image.state;
        if (touch.sampled && state != TargetState::Sampled && !(touch.depthTest && state == TargetState::DepthReadOnly))
            return "not sampleable";
        if (touch.loaded && state != TargetState::StorageRead) return "not loadable";
        if (touch.color && state != TargetState::Color) return "not a colour attachment";
        if (touch.depthTest && state != TargetState::DepthReadOnly) return "not a depth attachment to test";
        if (touch.depthWrite && state != TargetState::Depth) return "not a depth attachment";
        if (touch.stored && state != TargetState::StorageWrite) return "not storable";
        if (touch.writes()) image.writePending = true;
        if (touch.reads() || touch.depthTest) image.readPending = true;
        return {};
    }

    const FramePlan& plan_;
    const Frame& frame_;
    std::vector<Image> images_;
    std::vector<bool> firstTouch_;
};

struct Tally {
    int planned = 0, refused = 0;
};

void judge(const Frame& frame, const std::vector<bool>& depthFormat, const PipelineDesc& desc, Tally& tally) {
    bool refused = false;
    FramePlan plan;
    try {
        plan = planFrame(desc, usesOf(frame));
    } catch (const Error&) {
        refused = true;
    }
    (refused ? tally.refused : tally.planned) += 1;
    if (refused != mustRefuse(frame, depthFormat)) {
        FAIL() << (refused ? "refused: " : "planned: ") << describe(frame, depthFormat);
    }
    if (refused) return;
    Machine machine(plan, frame);
    for (int run = 0; run < 2; ++run) {
        const std::string wrong = machine.runFrame();
        if (!wrong.empty()) FAIL() << "frame " << run << ", " << wrong << ": " << describe(frame, depthFormat);
    }
}

/// Calls `visit` with every frame of `stages` stages in which each stage does one of `choices` with each target.
template <class Visit>
void forEachFrame(std::size_t stages, std::size_t targets, const std::vector<std::vector<Touch>>& choices,
                  Visit visit) {
    std::vector<std::size_t> digits(stages * targets, 0);
    Frame frame(stages, StageTouches(targets));
    while (!::testing::Test::HasFatalFailure()) {
        for (std::size_t i = 0; i < digits.size(); ++i)
            frame[i / targets][i % targets] = choices[i % targets][digits[i]];
        visit(frame);
        std::size_t i = 0;
        while (i < digits.size() && ++digits[i] == choices[i % targets].size()) digits[i++] = 0;
        if (i == digits.size()) return;
    }
}

const Touch kNone{}, kSample{.sampled = true}, kLoad{.loaded = true}, kColor{.color = true}, kTest{.depthTest = true},
    kDepth{.depthWrite = true}, kStore{.stored = true}, kSampleAndTest{.sampled = true, .depthTest = true};
const std::vector<Touch> kSimple{kNone, kSample, kLoad, kColor, kTest, kDepth, kStore, kSampleAndTest};

/// Every set of reads with every write, sense or nonsense.
std::vector<Touch> everyTouch() {
    std::vector<Touch> touches;
    for (int read = 0; read < 4; ++read) {
        for (int write = 0; write < 5; ++write) {
            touches.push_back({(read & 1) != 0, (read & 2) != 0, write == 1, write == 2, write == 3, write == 4});
        }
    }
    return touches;
}

TEST(FramePlanExhaustive, ThreeStagesOneTargetEveryCombination) {
    for (const bool depth : {false, true}) {
        const std::vector<bool> formats{depth};
        const PipelineDesc desc = describeTargets(formats);
        Tally tally;
        forEachFrame(3, 1, {everyTouch()}, [&](const Frame& frame) { judge(frame, formats, desc, tally); });
        EXPECT_EQ(tally.planned + tally.refused, 8000);
        EXPECT_GT(tally.planned, depth ? 5 : 7);
    }
}

TEST(FramePlanExhaustive, TwoStagesTwoTargets) {
    for (const std::vector<bool>& formats :
         {std::vector<bool>{false, false}, {false, true}, {true, false}, {true, true}}) {
        const PipelineDesc desc = describeTargets(formats);
        Tally tally;
        forEachFrame(2, 2, {kSimple, kSimple}, [&](const Frame& frame) { judge(frame, formats, desc, tally); });
        EXPECT_EQ(tally.planned + tally.refused, 4096);
        EXPECT_GT(tally.planned, 3);
    }
}

TEST(FramePlanExhaustive, ThreeStagesTwoTargetsOfFittingFormats) {
    const std::vector<Touch> onColor{kNone, kSample, kLoad, kColor, kStore};
    const std::vector<Touch> onDepth{kNone, kSample, kTest, kDepth, kSampleAndTest};
    for (const std::vector<bool>& formats : {std::vector<bool>{false, false}, {false, true}, {true, false}}) {
        const PipelineDesc desc = describeTargets(formats);
        Tally tally;
        forEachFrame(3, 2, {formats[0] ? onDepth : onColor, formats[1] ? onDepth : onColor},
                     [&](const Frame& frame) { judge(frame, formats, desc, tally); });
        EXPECT_EQ(tally.planned + tally.refused, 15625);
        EXPECT_GT(tally.planned, 300);
    }
}

TEST(FramePlanExhaustive, ADisabledStageIsAsIfItWereNotThere) {
    const std::vector<bool> formats{false, true};
    const PipelineDesc desc = describeTargets(formats);
    const auto plan = [&](std::vector<StageUse> uses) -> std::optional<FramePlan> {
        try {
            return planFrame(desc, std::move(uses));
        } catch (const Error&) {
            return std::nullopt;
        }
    };
    forEachFrame(2, 2, {kSimple, kSimple}, [&](const Frame& frame) {
        for (std::size_t off = 0; off < 2; ++off) {
            std::vector<StageUse> disabled = usesOf(frame), removed = usesOf(frame);
            disabled[off].enabled = false;
            removed.erase(removed.begin() + static_cast<std::ptrdiff_t>(off));
            const auto a = plan(disabled), b = plan(removed);
            ASSERT_EQ(a.has_value(), b.has_value()) << describe(frame, formats);
            if (!a) continue;
            ASSERT_EQ(a->uses.size(), 2u);
            ASSERT_EQ(a->stages.size(), 1u);
            ASSERT_EQ(a->stages[0].use, 1 - off);
            ASSERT_EQ(a->stages[0].before, b->stages[0].before) << describe(frame, formats);
            ASSERT_EQ(a->atEnd, b->atEnd) << describe(frame, formats);
        }
    });
}

}  // namespace
}  // namespace crevice
