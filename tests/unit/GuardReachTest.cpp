// How much of a guard stages draw: worked out by hand for small chains of stages.
#include <gtest/gtest.h>

#include "PipelineTestTools.h"
#include "plan/GuardReach.h"

namespace crevice {
namespace {

using test::AssetFolder;
using test::child;
using test::document;
using test::kBase;
using test::load;
using test::parse;
using test::problemsOf;
using test::stageOf;

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
    // Two texels of a half-size target are four pixels of the frame; of a quarter-size one eight. Between sizes, whole
    // texels are drawn and odd frames shift: one or three pixels each. O: 1 + 1 of i; I: 2 + 4 of h; H: 6 + 1 + 1 of a.
    Chain half({target("a"), target("h", 0.5f), target("i", 0.5f), target("o")}, "o");
    half.stage("A", "a", {}, {}).stage("H", "h", {"a"}, 0).stage("I", "i", {"h"}, 2).stage("O", "o", {"i"}, 1);
    EXPECT_EQ(half.beyond(), (Pixels{8, 6, 2, 0}));
    Chain quarter({target("q", 0.25f), target("r", 0.25f), target("o")}, "o");
    quarter.stage("Q", "q", {}, {}).stage("R", "r", {"q"}, 2).stage("O", "o", {"r"}, 0);
    EXPECT_EQ(quarter.beyond(), (Pixels{11, 3, 0})) << "3 of r, 3 + 8 of q";
}

TEST(GuardReach, OtherScalesAreRoundedTwice) {
    // Texels of 2.5 pixels: where the frame begins and where it ends are both rounded. O: 5 of h, H: 5 + 5 + 5 of a.
    Chain chain({target("a"), target("h", 0.4f), target("o")}, "o");
    chain.stage("A", "a", {}, {}).stage("H", "h", {"a"}, 0).stage("O", "o", {"h"}, 0);
    EXPECT_EQ(chain.beyond(), (Pixels{15, 5, 0}));
    // Targets twice as fine as the frame stick out nowhere.
    Chain fine({target("a"), target("f", 2), target("o")}, "o");
    fine.stage("A", "a", {}, {}).stage("F", "f", {"a"}, 2).stage("O", "o", {"f"}, 3);
    EXPECT_EQ(fine.beyond(), (Pixels{4, 3, 0}));
}

// What a stage is drawn on, in pixels, lies within what is asked of the stages before it, at any size of the frame.
TEST(GuardReach, WhatIsAskedForCoversWhatIsDrawn) {
    constexpr std::uint32_t kGuard = 64;
    const TargetDesc full = target("a"), half = target("h", 0.5f), quarter = target("q", 0.25f);
    for (const TargetDesc* small : {&half, &quarter}) {
        Chain chain({full, *small, target("o")}, "o");
        chain.stage("A", "a", {}, {}).stage("S", small->name, {"a"}, 0).stage("O", "o", {small->name}, 1);
        const Pixels beyond = chain.beyond();
        const auto texel = static_cast<std::uint32_t>(1 / small->scale);
        for (std::uint32_t side = 1; side < 40; ++side) {
            const FrameCrop drawn = drawnPart(*small, {side, side}, kGuard, std::uint32_t(beyond[1]));
            const FrameCrop read = drawnPart(full, {side, side}, kGuard, std::uint32_t(beyond[0]));
            EXPECT_LE(read.offset.x, drawn.offset.x * texel) << side;
            EXPECT_GE(read.offset.x + read.extent.x, (drawn.offset.x + drawn.extent.x) * texel) << side;
        }
    }
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

/// A document whose stage B says how far it reads, and children of it.
class StaleReach : public testing::Test {
protected:
    static constexpr const char* kParent = R"({
      "name": "parent", "output": "out",
      "options": { "sharp": { "type": "bool", "default": false, "choices": { "true": { "set": {
        "B.defines.LEVEL": 1, "B.reach": 2 } } } } },
      "targets": { "out": { "format": "RGBA8" }, "aux": { "format": "R8", "scale": 0.5 }, "map": { "format": "R8", "size": [8, 8] } },
      "flows": [ { "flow": "Main", "stages": [
        { "stage": "A", "writes": ["aux"] },
        { "stage": "B", "effect": "b", "defines": { "LEVEL": 0 }, "reach": 1, "reads": { "x": "aux" }, "writes": ["out"] } ] } ]
    })";
    void SetUp() override { folder_.pipeline("parent", kParent); }
    std::optional<std::uint32_t> reachOf(const std::string& keys, PipelineRequest request = {}) {
        folder_.pipeline("child", R"({ "extends": "parent")" + (keys.empty() ? "" : ", " + keys) + " }");
        const auto reach = stageOf(load(folder_, "child", request), "B").reach;
        request.nameOrPath = "child";
        for (const FlattenOptions mode : {FlattenOptions::Keep, FlattenOptions::Resolve}) {
            const std::string flat = flattenText(flattenPipeline(folder_.roots(), request, mode));
            EXPECT_EQ(stageOf(parse(flat), "B").reach, reach) << flat;
        }
        return reach;
    }
    std::optional<std::uint32_t> edited(const std::string& values, const PipelineRequest& request = {}) {
        return reachOf(R"("edits": [ { "set": "B", )" + values + " } ]", request);
    }
    std::optional<std::uint32_t> with(std::vector<StageSet> sets) {
        return reachOf("", {.nameOrPath = "", .options = {}, .sets = std::move(sets)});
    }
    AssetFolder folder_;
};

TEST_F(StaleReach, YoungerDocumentsThatChangeTheStageDropIt) {
    EXPECT_EQ(reachOf(""), 1u);
    EXPECT_EQ(edited(R"("material": { "a": 1 })"), 1u);
    EXPECT_EQ(edited(R"("defines": { "LEVEL": 2 })"), std::nullopt);
    EXPECT_EQ(edited(R"("defines": { "LEVEL": null })"), std::nullopt);
    EXPECT_EQ(edited(R"("reads": { "x": "map" })"), std::nullopt);
    EXPECT_EQ(edited(R"("writes": ["aux"])"), std::nullopt);
    EXPECT_EQ(edited(R"("defines": { "LEVEL": 2 }, "reach": 4)"), 4u);
    EXPECT_EQ(edited(R"("reach": 4, "defines": { "LEVEL": 2 })"), 4u);
}

TEST_F(StaleReach, SoDoSizesOfTargets) {
    EXPECT_EQ(reachOf(R"("targets": { "aux": { "override": true, "scale": 0.25 } })"), std::nullopt);
    EXPECT_EQ(reachOf(R"("targets": { "aux": { "override": true, "size": [8, 8] } })"), std::nullopt);
    EXPECT_EQ(reachOf(R"("targets": { "aux": { "override": true, "clear": 1 } })"), 1u);
    EXPECT_EQ(reachOf(R"("targets": { "map": { "override": true, "size": [9, 9] } })"), 1u) << "it has no guard";
    EXPECT_EQ(reachOf(R"("targets": { "more": { "format": "R8", "scale": 0.25 } })"), 1u);
    EXPECT_EQ(
        reachOf(R"("targets": { "more": { "format": "R8" } }, "options": { "small": { "type": "bool", "default": true,
        "choices": { "true": { "set": { "more.scale": 0.5 } } } } })"),
        1u)
        << "it is younger than the reach";
    EXPECT_EQ(with({{"aux.scale", "1"}}), std::nullopt);
    EXPECT_EQ(with({{"map.size", "[9, 9]"}}), 1u);
}

TEST_F(StaleReach, SoDoSets) {
    EXPECT_EQ(with({{"B.defines.LEVEL", "2"}}), std::nullopt);
    EXPECT_EQ(with({{"B.defines.LEVEL", "2"}, {"B.reach", "4"}}), 4u);
    EXPECT_EQ(with({{"B.reach", "4"}, {"B.defines.LEVEL", "2"}}), 4u);
    EXPECT_EQ(with({{"A.defines.LEVEL", "2"}}), 1u);
}

// A choice counts as its document does: its sets come later, but were not written for what the child made of it.
TEST_F(StaleReach, OrderDoesNotSaveIt) {
    const PipelineRequest sharp{.nameOrPath = "", .options = {{"sharp", "true"}}, .sets = {}};
    EXPECT_EQ(reachOf("", sharp), 2u);
    EXPECT_EQ(edited(R"("defines": { "LEVEL": 2 })", sharp), std::nullopt);
    const std::string ofChild =
        R"("options": { "wide": { "type": "bool", "default": true, "choices": { "true": { "set": {
        "B.defines.LEVEL": 3 } } } } })";
    EXPECT_EQ(reachOf(ofChild), std::nullopt);
}

std::optional<std::uint32_t> reachIn(const AssetRoots& roots, const std::string& nameOrPath,
                                     std::vector<StageSet> sets = {}) {
    return stageOf(loadPipeline(roots, {.nameOrPath = nameOrPath, .options = {}, .sets = std::move(sets)}), "B").reach;
}

TEST_F(StaleReach, HoldsForTheEffectOfItsOwnRoot) {
    folder_.write("effects/b.effect", "");
    folder_.write("own/assets/pipelines/child.pipeline.json", R"({ "extends": "parent" })");
    folder_.write("beside/child.pipeline.json", R"({ "extends": "parent" })");
    folder_.write("beside/says.pipeline.json", R"({ "extends": "parent", "edits": [ { "set": "B", "reach": 7 } ] })");
    const std::string beside = folder_.path() / "beside/child.pipeline.json";
    const AssetRoots roots({folder_.path() / "own", folder_.path()});
    EXPECT_EQ(reachIn(roots, "child"), 1u);
    EXPECT_EQ(reachIn(folder_.roots(), beside), 1u);
    folder_.write("own/effects/b.effect", "");
    folder_.write("beside/b.effect", "");
    EXPECT_EQ(reachIn(roots, "child"), std::nullopt);
    EXPECT_EQ(reachIn(roots, "child", {{"B.reach", "5"}}), 5u);
    EXPECT_EQ(reachIn(folder_.roots(), beside), std::nullopt);
    EXPECT_EQ(reachIn(folder_.roots(), folder_.path() / "beside/says.pipeline.json"), 7u);
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

// A child puts a number in place of auto: it wins, and the parent's choice is no mistake.
TEST(GuardReach, YoungerNumbersWinOverWhatAutoStandsFor) {
    AssetFolder folder;
    folder.pipeline("base", kBase);
    folder.pipeline("auto", R"({ "extends": "base", )" + withAuto(R"("$wide": 6)") + " }");
    folder.pipeline("number", R"({ "extends": "auto", "options": { "wide": { "override": true, "default": 9 } } })");
    EXPECT_EQ(load(folder, "auto").guard, 6);
    EXPECT_EQ(load(folder, "number").guard, 9);
    const PipelineRequest number{.nameOrPath = "number", .options = {}, .sets = {}};
    EXPECT_EQ(parse(flattenText(flattenPipeline(folder.roots(), number))).guard, 9);
    const PipelineRequest asked{.nameOrPath = "auto", .options = {{"wide", "3"}}, .sets = {}};
    EXPECT_EQ(parse(flattenText(flattenPipeline(folder.roots(), asked))).guard, 3);
}

// An option that a parent took out and a child declares again is the one that choices speak of.
TEST(GuardReach, OptionsThatComeBackHaveTheirAutoAgain) {
    AssetFolder folder;
    folder.pipeline("d", R"({ "extends": "ao-deferred", "options": { "guard": null }, "guard": 5 })");
    folder.pipeline("e", R"({ "extends": "d", "guard": "$guard", "options": {
        "guard": { "type": "number", "default": "auto", "min": 0, "max": 100 } } })");
    AssetRoots roots = AssetRoots::standard();
    roots.prepend(folder.path());
    const auto guardOf = [&](const std::string& name) {
        return loadPipeline(roots, {name, {{"ao", "gtao"}, {"quality", "high"}}, {}}).guard;
    };
    EXPECT_EQ(guardOf("d"), 5);
    EXPECT_EQ(guardOf("ao-deferred"), 6);
    EXPECT_EQ(guardOf("e"), 6);
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
