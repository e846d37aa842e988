// How much of a guard stages draw: worked out by hand for small chains of stages.
#include <gtest/gtest.h>

#include "PipelineTestTools.h"
#include "plan/GuardReach.h"

namespace crevice {
namespace {

using test::child;
using test::document;
using test::parse;
using test::problemsOf;

TargetDesc target(const std::string& name, float scale = 1) {
    TargetDesc desc;
    desc.name = name;
    desc.scale = scale;
    return desc;
}

/// A pipeline of full-screen stages: each writes one target and reads others.
class Chain {
public:
    explicit Chain(std::vector<TargetDesc> targets, const std::string& output) {
        desc_.targets = std::move(targets);
        desc_.output = output;
    }
    Chain& stage(const std::string& name, const std::string& writes, const std::vector<std::string>& reads,
                 std::optional<std::uint32_t> reach) {
        StageUse use;
        use.stage = use.flow = name;
        use.writes.push_back({writes, WriteKind::Color, false, 0, {}});
        for (const std::string& read : reads) use.reads.push_back({read, false, 0, read, {}});
        use.reach = reach;
        uses_.push_back(std::move(use));
        return *this;
    }
    /// Pixels that each stage draws beyond the frame; -1: the whole guard.
    std::vector<int> beyond() const {
        std::vector<int> pixels;
        for (const PlannedStage& stage : planFrame(desc_, uses_).stages)
            pixels.push_back(stage.beyond == kWholeGuard ? -1 : static_cast<int>(stage.beyond));
        return pixels;
    }

private:
    PipelineDesc desc_;
    std::vector<StageUse> uses_;
};

using Pixels = std::vector<int>;

TEST(GuardReach, AddsUpFromTheOutputBackwards) {
    Chain chain({target("a"), target("b"), target("c"), target("d")}, "d");
    chain.stage("A", "a", {}, {}).stage("B", "b", {"a"}, {}).stage("C", "c", {"b"}, 3).stage("D", "d", {"c"}, 12);
    EXPECT_EQ(chain.beyond(), (Pixels{-1, 15, 12, 0}));
}

TEST(GuardReach, TheFarthestReaderCounts) {
    Chain chain({target("a"), target("b"), target("c")}, "c");
    chain.stage("A", "a", {}, {}).stage("B", "b", {"a"}, 7).stage("C", "c", {"a", "b"}, 2);
    EXPECT_EQ(chain.beyond(), (Pixels{9, 2, 0}));
}

TEST(GuardReach, StepsAreThoseOfWhatIsWritten) {
    // Two texels of a half-size target are four pixels of the frame; of a quarter-size one eight.
    Chain half({target("a"), target("h", 0.5f), target("i", 0.5f), target("o")}, "o");
    half.stage("A", "a", {}, {}).stage("H", "h", {"a"}, 0).stage("I", "i", {"h"}, 2).stage("O", "o", {"i"}, 1);
    EXPECT_EQ(half.beyond(), (Pixels{5, 5, 1, 0}));
    Chain quarter({target("q", 0.25f), target("r", 0.25f), target("o")}, "o");
    quarter.stage("Q", "q", {}, {}).stage("R", "r", {"q"}, 2).stage("O", "o", {"r"}, 0);
    EXPECT_EQ(quarter.beyond(), (Pixels{8, 0, 0}));
}

TEST(GuardReach, WhatIsDrawnOnIsDrawnAsFar) {
    // The second stage blends over the first; the last one reads two pixels away.
    Chain chain({target("a"), target("o")}, "o");
    chain.stage("A", "a", {}, 0).stage("Over", "a", {}, 0).stage("O", "o", {"a"}, 2);
    EXPECT_EQ(chain.beyond(), (Pixels{2, 2, 0}));
}

TEST(GuardReach, FixedSizesAskForNothing) {
    TargetDesc fixed = target("map");
    fixed.size = glm::uvec2(16);
    Chain chain({target("a"), fixed, target("o")}, "o");
    chain.stage("A", "a", {}, {}).stage("Map", "map", {"a"}, 1).stage("O", "o", {"map"}, {});
    EXPECT_EQ(chain.beyond(), (Pixels{-1, -1, 0})) << "its own writer draws all, and may read all";
}

TEST(GuardReach, UnknownReachDrawsAll) {
    Chain chain({target("a"), target("b"), target("o")}, "o");
    chain.stage("A", "a", {}, 0).stage("B", "b", {"a"}, 0).stage("Bloom", "o", {"b"}, {});
    EXPECT_EQ(chain.beyond(), (Pixels{-1, -1, 0}));
}

TEST(GuardReach, PartIsTheFrameAndWhatIsBeyond) {
    const auto part = [](const TargetDesc& desc, std::uint32_t beyond, std::uint32_t mip = 0) {
        const FrameCrop crop = drawnPart(desc, {101, 51}, 20, beyond, mip);
        return std::array<std::uint32_t, 4>{crop.offset.x, crop.offset.y, crop.extent.x, crop.extent.y};
    };
    using Part = std::array<std::uint32_t, 4>;
    EXPECT_EQ(part(target("a"), 0), (Part{20, 20, 101, 51}));
    EXPECT_EQ(part(target("a"), 3), (Part{17, 17, 107, 57}));
    EXPECT_EQ(part(target("a"), 20), (Part{0, 0, 141, 91}));
    EXPECT_EQ(part(target("a"), kWholeGuard), (Part{0, 0, 141, 91}));
    // Half size: 71 x 46 texels; the frame's are 10 … 60 and 10 … 35.
    EXPECT_EQ(part(target("a", 0.5f), 0), (Part{10, 10, 51, 26}));
    EXPECT_EQ(part(target("a", 0.5f), 3), (Part{8, 8, 54, 29}));  // 17 … 124 and 17 … 74 of the frame
    EXPECT_EQ(part(target("a", 0.5f), 19), (Part{0, 0, 70, 45}));
    // Level 1 of a full-size target is a half-size one, rounded down.
    EXPECT_EQ(part(target("a"), 0, 1), (Part{10, 10, 51, 26}));
    EXPECT_EQ(part(target("a"), 100, 1), (Part{0, 0, 70, 45}));
    TargetDesc fixed = target("f");
    fixed.size = glm::uvec2(16, 8);
    EXPECT_EQ(part(fixed, 0), (Part{0, 0, 16, 8}));
    for (int i = 1; i < 400; ++i) {  // Scales at which the border is no whole number of pixels.
        const TargetDesc any = target("a", 0.01f * static_cast<float>(i));
        const FrameCrop frame = frameCrop(any, 101, 51, 20), drawn = drawnPart(any, {101, 51}, 20, 0);
        const glm::uvec2 whole(targetExtent(any, 141, 91));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(drawn.offset, frame.offset))) << i;
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(drawn.offset + drawn.extent, frame.offset + frame.extent))) << i;
        EXPECT_TRUE(glm::all(glm::lessThanEqual(drawn.offset + drawn.extent, whole))) << i;
    }
}

TEST(GuardReach, IsAKeyOfStages) {
    EXPECT_EQ(parse(document("", "")).flows[0].stages[0].reach, std::nullopt);
    EXPECT_EQ(parse(document("", R"(, "reach": 3)")).flows[0].stages[0].reach, 3u);
    EXPECT_NE(
        problemsOf(document("", R"(, "reach": -1)")).find("'reach' of stage 'FullscreenStage' is -1, out of range"),
        std::string::npos);
    EXPECT_NE(problemsOf(document("", R"(, "reach": 1.5)")).find("must be an integer, found 1.5"), std::string::npos);
    EXPECT_NE(problemsOf(document("", R"(, "reach": "far")")).find("must be an integer, found a string"),
              std::string::npos);
}

// How far a stage reads is a property of its effect: who replaces the one says the other anew.
TEST(GuardReach, GoesWithTheEffect) {
    const auto reachOf = [](const std::string& keys, const PipelineRequest& request = {}) {
        return parse(document("", R"(, "effect": "copy", "reach": 3)", keys), request).flows[0].stages[0].reach;
    };
    const auto edit = [&](const std::string& values) {
        return reachOf(R"(, "edits": [ { "set": "FullscreenStage", )" + values + " } ]");
    };
    EXPECT_EQ(edit(R"("material": { "a": 1 })"), 3u);
    EXPECT_EQ(edit(R"("effect": "blur")"), std::nullopt);
    EXPECT_EQ(edit(R"("effect": "blur", "reach": 5)"), 5u);
    EXPECT_EQ(edit(R"("reach": 5, "effect": "blur")"), 5u);
    const auto set = [&](std::vector<StageSet> sets) {
        return reachOf("", {.nameOrPath = "", .options = {}, .sets = std::move(sets)});
    };
    EXPECT_EQ(set({{"FullscreenStage.effect", "blur"}}), std::nullopt);
    EXPECT_EQ(set({{"FullscreenStage.effect", "blur"}, {"FullscreenStage.reach", "4"}}), 4u);
    EXPECT_EQ(set({{"FullscreenStage.reach", "null"}}), std::nullopt);
}

std::string withAuto(const std::string& set) {
    return R"("guard": "$wide", "options": {
        "wide": { "type": "number", "default": "auto", "min": 0, "max": 50 },
        "fine": { "type": "bool", "default": true, "choices": { "true": { "set": { )" +
           set + R"( } } } } })";
}
PipelineRequest options(std::map<std::string, std::string> values) {
    return {.nameOrPath = "", .options = std::move(values), .sets = {}};
}

TEST(GuardReach, ChoicesSayWhatAutoStandsFor) {
    const std::string keys = withAuto(R"("$wide": 6)");
    EXPECT_EQ(child(keys).guard, 6);
    EXPECT_EQ(child(keys, options({{"wide", "auto"}})).guard, 6);
    EXPECT_EQ(child(keys, options({{"wide", "0"}})).guard, 0) << "a number wins";
    EXPECT_EQ(child(keys, options({{"wide", "12"}})).guard, 12);
    EXPECT_EQ(child(keys, options({{"fine", "false"}})).guard, 0) << "nobody says more: none";
}

TEST(GuardReach, MistakesInWhatAutoStandsFor) {
    const auto problems = [](const std::string& set) {
        try {
            child(withAuto(set));
        } catch (const Error& error) {
            return error.problems()[0].message;
        }
        return std::string();
    };
    EXPECT_EQ(problems(R"("$wide": 51)"), "option 'wide' is 51, out of range");
    EXPECT_EQ(problems(R"("$wide": true)"), "option 'wide' must be a number, found true");
    EXPECT_EQ(problems(R"("$widht": 5)"), "'$widht' names no option");
    EXPECT_EQ(problems(R"("$fine": 5)"), "option 'fine' is no number: a choice cannot say what auto stands for");
}

}  // namespace
}  // namespace crevice
