// What planFrame refuses, rule by rule, and in which words.
#include <fmt/format.h>

#include "PlanRules.h"

namespace crevice {
namespace {

TEST_F(PlanRules, UndeclaredTargetNamesTheNearest) {
    target("finalColor");
    stage("A").writes = {write("finalColor"), write("finalColour")};
    const Problem problem = refusal();
    EXPECT_EQ(problem.message, "'A' writes 'finalColour', which is no target");
    EXPECT_EQ(problem.where.line, 101);
    EXPECT_NE(problem.help.find("did you mean 'finalColor'"), std::string::npos) << problem.help;
}

TEST_F(PlanRules, UndeclaredReadStandsAtTheEffect) {
    target("out");
    StageUse& use = stage("A");
    use.writes = {write("out")};
    use.reads = {read("in")};
    const Problem problem = refusal();
    EXPECT_EQ(problem.message, "'A' reads 'in', which is no target");
    EXPECT_EQ(problem.where.file, "e.effect");
    EXPECT_EQ(problem.where.line, 34);
}

TEST_F(PlanRules, ReadBeforeTheFirstWriteNamesBothStages) {
    target("out");
    target("ao");
    StageUse& lighting = stage("Lighting");
    lighting.writes = {write("out")};
    lighting.reads = {read("ao")};
    stage("Ssao").writes = {write("ao")};
    const Problem problem = refusal();
    EXPECT_EQ(problem.message, "'Lighting' reads 'ao' before 'Ssao' writes it");
    EXPECT_EQ(problem.where.line, 34);
    ASSERT_EQ(problem.remarks.size(), 2u);
    EXPECT_EQ(problem.remarks[0].where.line, 102);
    EXPECT_EQ(problem.remarks[0].message, "'Ssao' is stage 2 of 'F'");
    EXPECT_EQ(problem.remarks[1].message, "'Lighting' is stage 1 of 'F'");
    EXPECT_EQ(problem.help, "place 'Ssao' before 'Lighting' in the document (\"before\": \"Lighting\" in an insert)");
}

TEST_F(PlanRules, DepthTestedBeforeItIsWrittenIsRefused) {
    target("out");
    target("depth", Format::D32F);
    stage("Sky").writes = {write("out"), write("depth", WriteKind::DepthTest)};
    stage("Gbuffer").writes = {write("depth", WriteKind::DepthWrite)};
    EXPECT_EQ(refusal().message, "'Sky' tests against 'depth' before 'Gbuffer' writes it");
}

TEST_F(PlanRules, FeedbackNamesBothPlaces) {
    target("out");
    StageUse& use = stage("A");
    use.writes = {write("out")};
    use.reads = {read("out")};
    const Problem problem = refusal();
    EXPECT_EQ(problem.message, "'A' reads and writes 'out'");
    EXPECT_EQ(problem.where.line, 34);
    ASSERT_EQ(problem.remarks.size(), 1u);
    EXPECT_EQ(problem.remarks[0].where.line, 101);
}

TEST_F(PlanRules, WrittenDepthMayNotBeSampledByTheSameStage) {
    target("out");
    target("depth", Format::D32F);
    StageUse& use = stage("A");
    use.writes = {write("out"), write("depth", WriteKind::DepthWrite)};
    use.reads = {read("depth")};
    EXPECT_EQ(refusal().message, "'A' reads and writes 'depth'");
}

TEST_F(PlanRules, SampledAndLoadedByOneStageIsRefused) {
    target("out");
    target("z", Format::R32F);
    stage("Z").writes = {write("z")};
    StageUse& use = stage("A");
    use.writes = {write("out")};
    use.reads = {read("z"), load("z")};
    EXPECT_EQ(refusal().message, "'A' reads 'z' both by a sampler and by imageLoad");
}

TEST_F(PlanRules, AttachmentsOfTwoSizesAreRefused) {
    target("out");
    target("half").scale = 0.5f;
    stage("A").writes = {write("out"), write("half")};
    const Problem problem = refusal();
    EXPECT_EQ(problem.message, "'A' writes 'out' (scale 1) and 'half' (scale 0.5) together, but their sizes differ");
    ASSERT_EQ(problem.remarks.size(), 2u);
    EXPECT_EQ(problem.remarks[0].where.line, 1);
    EXPECT_EQ(problem.remarks[1].where.line, 2);
}

TEST_F(PlanRules, AFixedSizeIsNotAScaledOne) {
    target("out");
    target("fixed").size = glm::uvec2(1280, 720);
    stage("A").writes = {write("out"), write("fixed")};
    EXPECT_EQ(refusal().message, "'A' writes 'out' (scale 1) and 'fixed' (1280×720) together, but their sizes differ");
}

TEST_F(PlanRules, LevelsCountForSizes) {
    TargetDesc& big = target("big");
    big.size = glm::uvec2(64, 32);
    big.mips = 2;
    target("small").size = glm::uvec2(32, 16);
    desc_.output = "small";
    stage("A").writes = {write("big", WriteKind::Color, 1), write("small")};
    EXPECT_NO_THROW(plan());
    uses_[0].writes[0].mip = 0;
    EXPECT_EQ(refusal().message, "'A' writes 'big' (64×32) and 'small' (32×16) together, but their sizes differ");
}

TEST_F(PlanRules, StorageImagesMayHaveAnySize) {
    target("out");
    target("half").scale = 0.5f;
    StageUse& use = stage("A");
    use.compute = true;
    use.writes = {write("out", WriteKind::Storage), write("half", WriteKind::Storage)};
    EXPECT_NO_THROW(plan());
}

TEST_F(PlanRules, FormatsMustFitTheUse) {
    struct Case {
        Format format;
        WriteKind kind;
        const char* message;
    };
    for (const Case& bad :
         {Case{Format::D32F, WriteKind::Color, "'A' writes colour to 'x', whose format D32F is a depth format"},
          Case{Format::R32F, WriteKind::DepthWrite, "'A' uses 'x' as depth, but its format R32F is a colour format"},
          Case{Format::RGBA8, WriteKind::DepthTest, "'A' uses 'x' as depth, but its format RGBA8 is a colour format"},
          Case{Format::D32F, WriteKind::Storage,
               "'A' writes 'x' as a storage image, which its format D32F does not allow"},
          Case{Format::RGBA8_SRGB, WriteKind::Storage,
               "'A' writes 'x' as a storage image, which its format RGBA8_SRGB does not allow"}}) {
        desc_.targets.clear();
        uses_.clear();
        target("out");
        target("x", bad.format);
        stage("A").writes = {write("out"), write("x", bad.kind)};
        const Problem problem = refusal();
        EXPECT_EQ(problem.message, bad.message);
        ASSERT_EQ(problem.remarks.size(), 1u);
        EXPECT_EQ(problem.remarks[0].where.line, 2);
    }
}

TEST_F(PlanRules, DepthIsNotLoadedByStorage) {
    target("out");
    target("depth", Format::D32F);
    stage("Z").writes = {write("depth", WriteKind::DepthWrite)};
    StageUse& use = stage("A");
    use.writes = {write("out")};
    use.reads = {load("depth")};
    EXPECT_EQ(refusal().message, "'A' reads 'depth' as a storage image, which its format D32F does not allow");
}

TEST_F(PlanRules, ComputeStagesHaveNoAttachments) {
    target("out");
    StageUse& use = stage("A");
    use.compute = true;
    use.writes = {write("out")};
    EXPECT_EQ(refusal().message, "'A' is a compute stage and cannot have 'out' as an attachment");
}

TEST_F(PlanRules, OutputsAreNamedOnce) {
    target("out");
    stage("A").writes = {write("out"), write("out")};
    EXPECT_EQ(refusal().message, "'A' names 'out' twice among its outputs");
    target("d", Format::D32F);
    target("e", Format::D32F);
    uses_[0].writes = {write("out"), write("d", WriteKind::DepthWrite), write("e", WriteKind::DepthWrite)};
    EXPECT_EQ(refusal().message, "'A' has more than one depth target; 'e' is the second");
}

TEST_F(PlanRules, NineColourTargetsAreTooMany) {
    StageUse& use = stage("A");
    for (int i = 0; i < 8; ++i) {
        target(fmt::format("t{}", i).c_str());
        use.writes.push_back(write(fmt::format("t{}", i).c_str()));
    }
    EXPECT_NO_THROW(plan());
    target("t8");
    use.writes.push_back(write("t8"));
    EXPECT_EQ(refusal().message, "'A' writes 9 colour targets; a stage can have 8");
}

TEST_F(PlanRules, AStageMustWrite) {
    target("out");
    stage("A").writes = {write("out")};
    stage("B").reads = {read("out")};
    EXPECT_EQ(refusal().message, "'B' writes no target");
}

TEST_F(PlanRules, TheOutputMustBeDeclaredAndWritten) {
    target("finalColor");
    desc_.outputWhere = {"d.json", 4, 13, 1};
    stage("A").writes = {write("finalColor")};
    desc_.output = "finalColr";
    const Problem undeclared = refusal();
    EXPECT_EQ(undeclared.message, "the output 'finalColr' is no target");
    EXPECT_EQ(undeclared.where.line, 4);
    EXPECT_NE(undeclared.help.find("'finalColor'"), std::string::npos);
    target("other");
    desc_.output = "other";
    EXPECT_EQ(refusal().message, "no enabled stage writes the output 'other'");
}

TEST_F(PlanRules, LevelsMustExist) {
    target("out");
    target("p").mips = 3;
    StageUse& use = stage("A");
    use.writes = {write("p", WriteKind::Color, 3)};
    stage("B").writes = {write("out")};
    const Problem problem = refusal();
    EXPECT_EQ(problem.message, "'A' writes level 3 of 'p', which has 3");
    EXPECT_EQ(problem.help, "set \"mips\" of 'p' to 4 or more, or name a level below 3");
}

TEST_F(PlanRules, ALevelNobodyWritesIsRefused) {
    target("out");
    target("p").mips = 2;
    stage("A").writes = {write("p")};
    StageUse& use = stage("B");
    use.writes = {write("out")};
    use.reads = {read("p")};
    EXPECT_EQ(refusal().message, "'B' reads level 1 of 'p', which no enabled stage writes");
    uses_[1].reads = {level("p", 0)};
    EXPECT_NO_THROW(plan());
}

TEST_F(PlanRules, SeveralMistakesAreReportedInOneRun) {
    target("out");
    stage("A").writes = {write("nope")};
    stage("B");
    try {
        plan();
        FAIL() << "accepted";
    } catch (const Error& error) {
        ASSERT_EQ(error.problems().size(), 3u);
        EXPECT_EQ(error.problems()[0].message, "'A' writes 'nope', which is no target");
        EXPECT_EQ(error.problems()[1].message, "'B' writes no target");
        EXPECT_EQ(error.problems()[2].message, "no enabled stage writes the output 'out'");
    }
}

}  // namespace
}  // namespace crevice
