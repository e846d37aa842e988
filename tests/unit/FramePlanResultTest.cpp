// What an accepted plan says: transitions, clears, usage, warnings and notes, mip levels.
#include "PlanRules.h"

namespace crevice {
namespace {

using State = TargetState;

TEST_F(PlanRules, TestedDepthMayBeSampledByTheSameStage) {
    target("out");
    target("depth", Format::D32F);
    stage("Gbuffer").writes = {write("depth", WriteKind::DepthWrite)};
    StageUse& sky = stage("Sky");
    sky.writes = {write("out"), write("depth", WriteKind::DepthTest)};
    sky.reads = {read("depth")};
    const FramePlan planned = plan();
    EXPECT_EQ(planned.stages[1].before, (std::vector<Transition>{{"depth", State::Depth, State::DepthReadOnly},
                                                                 {"out", State::Undefined, State::Color}}));
    EXPECT_TRUE(planned.lives[1].depth);
    EXPECT_TRUE(planned.lives[1].sampled);
}

TEST_F(PlanRules, APyramidIsBuiltLevelByLevel) {
    target("out");
    target("p", Format::R32F).mips = 3;
    stage("Level0").writes = {write("p")};
    for (std::uint32_t mip = 1; mip < 3; ++mip) {
        StageUse& use = stage(mip == 1 ? "Level1" : "Level2");
        use.writes = {write("p", WriteKind::Color, mip)};
        use.reads = {level("p", mip - 1)};
    }
    StageUse& use = stage("Use");
    use.writes = {write("out")};
    use.reads = {read("p")};
    const FramePlan planned = plan();
    EXPECT_EQ(planned.stages[1].before, (std::vector<Transition>{{"p", State::Color, State::Sampled, 0},
                                                                 {"p", State::Undefined, State::Color, 1}}));
    EXPECT_EQ(planned.stages[2].before, (std::vector<Transition>{{"p", State::Color, State::Sampled, 1},
                                                                 {"p", State::Undefined, State::Color, 2}}));
    EXPECT_EQ(planned.stages[3].before, (std::vector<Transition>{{"p", State::Color, State::Sampled, 2},
                                                                 {"out", State::Undefined, State::Color}}));
    EXPECT_TRUE(planned.stages[2].writes[0].clears);
}

TEST_F(PlanRules, AllLevelsInOneStateMoveAtOnce) {
    target("out");
    target("p").mips = 2;
    StageUse& build = stage("Build");
    build.compute = true;
    build.writes = {write("p", WriteKind::Storage, 0), write("p", WriteKind::Storage, 1)};
    StageUse& use = stage("Use");
    use.writes = {write("out")};
    use.reads = {read("p")};
    EXPECT_EQ(plan().stages[1].before[0], (Transition{"p", State::StorageWrite, State::Sampled, kAllMips}));
}

TEST_F(PlanRules, SuccessiveWritersAreOrderedAndLoad) {
    target("out");
    target("depth", Format::D32F);
    stage("A").writes = {write("out"), write("depth", WriteKind::DepthWrite)};
    stage("B").writes = {write("out"), write("depth", WriteKind::DepthWrite)};
    const FramePlan planned = plan();
    EXPECT_EQ(planned.stages[1].before,
              (std::vector<Transition>{{"out", State::Color, State::Color}, {"depth", State::Depth, State::Depth}}));
    for (const PlannedWrite& first : planned.stages[0].writes) EXPECT_TRUE(first.clears);
    for (const PlannedWrite& later : planned.stages[1].writes) EXPECT_FALSE(later.clears);
    EXPECT_TRUE(planned.notes.all().empty());
}

TEST_F(PlanRules, WritingOverWhatNobodyReadIsWarnedOf) {
    target("out");
    stage("A").writes = {write("out")};
    stage("B").writes = {write("out")};
    EXPECT_EQ(remarks(),
              (std::vector<std::string>{"warning: 'B' writes over 'out', which 'A' wrote and nobody has read"}));
    const FramePlan planned = plan();
    EXPECT_EQ(planned.notes.all()[0].remarks.at(0).where.line, 101);
    uses_[1].writes[0].blends = true;
    EXPECT_TRUE(remarks().empty());
}

TEST_F(PlanRules, PingPongIsNotWarnedOf) {
    target("a");
    target("b");
    stage("Fill").writes = {write("a")};
    StageUse& there = stage("There");
    there.writes = {write("b")};
    there.reads = {read("a")};
    StageUse& back = stage("Back");
    back.writes = {write("a")};
    back.reads = {read("b")};
    EXPECT_TRUE(remarks().empty());
    EXPECT_EQ(plan().stages[2].before,
              (std::vector<Transition>{{"b", State::Color, State::Sampled}, {"a", State::Sampled, State::Color}}));
}

TEST_F(PlanRules, ATargetNobodyReadsIsWarnedOf) {
    target("out");
    target("extra");
    target("unused");
    stage("A").writes = {write("out")};
    stage("B").writes = {write("extra")};
    EXPECT_EQ(remarks(),
              (std::vector<std::string>{"warning: 'B' writes 'extra', which no stage reads and which is not the output",
                                        "warning: no stage reads or writes the target 'unused'"}));
}

TEST_F(PlanRules, ATargetThatTheParentBringsAndNobodyUsesIsNoWarning) {
    target("out");
    target("unused");
    stage("A").writes = {write("out")};
    desc_.path = "d.json";
    EXPECT_EQ(remarks().size(), 1u);
    desc_.path = "child.json";
    EXPECT_TRUE(remarks().empty());
}

TEST_F(PlanRules, WhatIsSwitchedOffIsNoWarning) {
    target("out");
    target("wire");     // between two disabled stages
    target("written");  // by a disabled stage alone
    target("model");    // of another target's size
    target("wire2").like = "model";
    stage("A").writes = {write("out")};
    stage("B").writes = {write("wire"), write("written")};
    uses_.back().enabled = false;
    stage("C").writes = {write("wire2")};
    uses_.back().reads = {read("wire"), read("wire2")};
    uses_.back().enabled = false;
    EXPECT_EQ(remarks(), std::vector<std::string>{});
    desc_.targets.back().like.clear();
    EXPECT_EQ(remarks(), std::vector<std::string>{"warning: no stage reads or writes the target 'model'"});
}

TEST_F(PlanRules, WhatAClassStageOffersIsOnlyNoted) {
    target("out");
    target("extra");
    stage("Gbuffer").writes = {write("out"), write("extra")};
    FlowDesc flow;
    flow.stages.push_back({});
    flow.stages[0].name = "Gbuffer";
    desc_.flows.push_back(flow);
    const std::string text = "'Gbuffer' writes 'extra', which no stage reads and which is not the output";
    EXPECT_EQ(remarks(), std::vector<std::string>{"note: " + text});
    desc_.flows[0].stages[0].writes = {"out", "extra"};
    EXPECT_EQ(remarks(), std::vector<std::string>{"note: " + text}) << "its other output is of use";
}

TEST_F(PlanRules, ATargetNobodyWritesHoldsItsClearValue) {
    target("out");
    target("ao", Format::R8).clear = glm::vec4(1);
    StageUse& ssao = stage("Ssao");
    ssao.writes = {write("ao")};
    ssao.enabled = false;
    for (const char* name : {"First", "Second"}) {
        StageUse& use = stage(name);
        use.writes = {write("out")};
        use.writes[0].blends = true;
        use.reads = {read("ao")};
    }
    const FramePlan planned = plan();
    EXPECT_EQ(planned.stages[0].before, (std::vector<Transition>{{"out", State::Undefined, State::Color}}));
    EXPECT_TRUE(planned.lives[1].neverWritten);
    EXPECT_TRUE(planned.lives[1].transferDest);
    EXPECT_EQ(planned.lives[1].atEnd, State::Sampled);
    ASSERT_EQ(planned.notes.all().size(), 1u);
    const Problem& note = planned.notes.all()[0];
    EXPECT_EQ(note.severity, Severity::Note);
    EXPECT_EQ(note.message, "'First' reads 'ao', which no enabled stage writes: it holds its clear value (1, 1, 1, 1)");
    EXPECT_EQ(note.help, "'Ssao' writes it when it is enabled");
}

TEST_F(PlanRules, ALoadedConstantReturnsToSampled) {
    target("out");
    target("ao", Format::R8);
    StageUse& use = stage("A");
    use.writes = {write("out")};
    use.reads = {load("ao")};
    const FramePlan planned = plan();
    EXPECT_EQ(planned.stages[0].before[0], (Transition{"ao", State::Sampled, State::StorageRead}));
    EXPECT_EQ(planned.atEnd, (std::vector<Transition>{{"out", State::Color, State::TransferSource},
                                                      {"ao", State::StorageRead, State::Sampled}}));
}

TEST_F(PlanRules, UsageAndLifetimesAreCollected) {
    target("out");
    target("z", Format::R32F);
    target("free");
    stage("Z").writes = {write("z", WriteKind::Storage)};
    StageUse& middle = stage("Middle");
    middle.writes = {write("free")};
    middle.reads = {read("z")};
    StageUse& last = stage("Last");
    last.writes = {write("out")};
    last.reads = {load("z")};
    const FramePlan planned = plan();
    const TargetLife& z = planned.lives[1];
    EXPECT_EQ(z.firstUse, 0);
    EXPECT_EQ(z.lastUse, 2);
    EXPECT_TRUE(z.storage && z.sampled);
    EXPECT_FALSE(z.color || z.depth || z.transferSource || z.transferDest || z.neverWritten);
    EXPECT_EQ(z.atEnd, State::StorageRead);
    const TargetLife& out = planned.lives[0];
    EXPECT_TRUE(out.color && out.transferSource);
    EXPECT_FALSE(out.sampled || out.storage);
    EXPECT_EQ(out.atEnd, State::TransferSource);
    EXPECT_EQ(planned.output, "out");
}

TEST(StateName, EveryStateHasItsName) {
    EXPECT_STREQ(stateName(State::Undefined), "undefined");
    EXPECT_STREQ(stateName(State::DepthReadOnly), "depth-read-only");
    EXPECT_STREQ(stateName(State::TransferSource), "transfer-source");
    EXPECT_STREQ(stateName(State::TransferDest), "transfer-dest");
}

}  // namespace
}  // namespace crevice
