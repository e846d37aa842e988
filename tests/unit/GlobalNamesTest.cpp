// Numbers of set 0: built-in slots, pins, free numbers, and the clashes that are refused.
#include "plan/GlobalNames.h"

#include <gtest/gtest.h>

namespace crevice {
namespace {

const SourceLoc kParent{"parent.json", 3, 5, 1};
const SourceLoc kChild{"child.json", 7, 9, 1};

/// The problems that freeze() throws; empty when it does not.
std::vector<Problem> refusals(GlobalNames& names) {
    try {
        names.freeze();
    } catch (const Error& error) {
        return error.problems();
    }
    return {};
}

std::uint32_t number(const GlobalLayout& layout, const char* name) {
    const GlobalSlot* slot = layout.find(name);
    return slot ? slot->binding : 999;
}

TEST(GlobalNames, BuiltInSlotsHaveTheNumbersOfTheContract) {
    const GlobalLayout layout = GlobalNames().freeze();
    struct Expected {
        const char* name;
        GlobalKind kind;
        std::uint32_t binding, size;
    };
    const std::vector<Expected> expected{
        {"CCGlobal", GlobalKind::UniformBlock, 0, 48},       {"CCCamera", GlobalKind::UniformBlock, 1, 544},
        {"CCShadow", GlobalKind::UniformBlock, 2, 304},      {"cc_shadowMap", GlobalKind::Sampler2D, 3, 0},
        {"cc_environment", GlobalKind::SamplerCube, 4, 0},   {"cc_spotLightingMap", GlobalKind::Sampler2D, 5, 0},
        {"CCSpotShadow", GlobalKind::UniformBlock, 28, 96},  {"CCPunctualLights", GlobalKind::StorageBuffer, 30, 0},
        {"CCLightGrid", GlobalKind::StorageBuffer, 31, 0},   {"CCEnvironment", GlobalKind::StorageBuffer, 60, 0},
        {"cc_environmentBrdf", GlobalKind::Sampler2D, 61, 0}};
    ASSERT_EQ(layout.slots().size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const GlobalSlot& slot = layout.slots()[i];
        EXPECT_EQ(slot.name, expected[i].name);
        EXPECT_EQ(slot.kind, expected[i].kind) << slot.name;
        EXPECT_EQ(slot.binding, expected[i].binding) << slot.name;
        EXPECT_EQ(slot.size, expected[i].size) << slot.name;
        EXPECT_FALSE(slot.target) << slot.name;
        EXPECT_EQ(layout.bindings().at(slot.name), (BindingSlot{0, slot.binding}));
    }
    EXPECT_EQ(layout.bindings().at("CCLocal"), (BindingSlot{2, 0}));
    EXPECT_EQ(layout.bindings().at("CCForwardLight"), (BindingSlot{2, 1}));
    EXPECT_EQ(layout.bindings().size(), expected.size() + 2);
}

TEST(GlobalNames, CocosTargetsKeepCocosNumbersWhateverTheOrder) {
    GlobalNames names;
    names.addTarget("cc_mine", {}, kParent);
    names.addTarget("cc_lighting_resultMap", {}, kParent);
    names.addTarget("cc_gbuffer_emissiveMap", {}, kParent);
    names.addTarget("cc_gbuffer_normalMap", 8, kParent);
    names.addTarget("cc_gbuffer_positionMap", {}, kParent);
    names.addTarget("cc_gbuffer_albedoMap", {}, kParent);
    names.addTarget("cc_shadowMap", {}, kParent);
    const GlobalLayout layout = names.freeze();
    EXPECT_EQ(number(layout, "cc_gbuffer_albedoMap"), 6u);
    EXPECT_EQ(number(layout, "cc_gbuffer_positionMap"), 7u);
    EXPECT_EQ(number(layout, "cc_gbuffer_normalMap"), 8u);
    EXPECT_EQ(number(layout, "cc_gbuffer_emissiveMap"), 9u);
    EXPECT_EQ(number(layout, "cc_lighting_resultMap"), 10u);
    EXPECT_EQ(number(layout, "cc_shadowMap"), 3u);
    EXPECT_TRUE(layout.find("cc_shadowMap")->target);
    EXPECT_EQ(number(layout, "cc_mine"), 11u);
}

TEST(GlobalNames, TheArticlesNumbersComeFromPins) {
    GlobalNames names;
    names.pinBlock("CCSsao", 12, kChild);
    names.addTarget("cc_ssaoMap", 11, kChild);
    names.addTarget("cc_ssaoBlurMap", 13, kChild);
    names.addBlock("CCSsao", 1040, {}, kChild);
    const GlobalLayout layout = names.freeze();
    EXPECT_EQ(number(layout, "cc_ssaoMap"), 11u);
    EXPECT_EQ(number(layout, "CCSsao"), 12u);
    EXPECT_EQ(layout.find("CCSsao")->size, 1040u);
    EXPECT_EQ(number(layout, "cc_ssaoBlurMap"), 13u);
    EXPECT_TRUE(layout.notes().all().empty());
}

TEST(GlobalNames, FreeNumbersGoToTargetsThenBlocksAroundPins) {
    GlobalNames names;
    names.addBlock("CCOne", 16, {}, kParent);
    names.addTarget("cc_a", {}, kParent);
    names.addTarget("cc_pinned", 12, kParent);
    names.addTarget("helper", {}, kParent);
    names.addTarget("cc_b", {}, kParent);
    names.addBlock("CCTwo", 16, {}, kParent);
    const GlobalLayout layout = names.freeze();
    EXPECT_EQ(number(layout, "cc_a"), 11u);
    EXPECT_EQ(number(layout, "cc_pinned"), 12u);
    EXPECT_EQ(number(layout, "cc_b"), 13u);
    EXPECT_EQ(number(layout, "CCOne"), 14u);
    EXPECT_EQ(number(layout, "CCTwo"), 15u);
    EXPECT_EQ(layout.find("helper"), nullptr);
    EXPECT_FALSE(layout.bindings().contains("helper"));
}

TEST(GlobalNames, FreeNumbersSkipOurOwnBlocks) {
    GlobalNames names;
    for (int i = 0; i < 19; ++i) names.addTarget("cc_t" + std::to_string(i), {}, kParent);
    const GlobalLayout layout = names.freeze();
    EXPECT_EQ(number(layout, "cc_t16"), 27u);
    EXPECT_EQ(number(layout, "cc_t17"), 29u);
    EXPECT_EQ(number(layout, "cc_t18"), 32u);  // 28, 30 and 31 are ours
}

TEST(GlobalNames, ADerivedPipelineChangesNoNumberOfItsParent) {
    const auto declareParent = [](GlobalNames& names) {
        names.addTarget("cc_a", {}, kParent);
        names.addTarget("cc_b", 14, kParent);
        names.addTarget("cc_c", {}, kParent);
    };
    GlobalNames parent;
    declareParent(parent);
    parent.addBlock("CCParent", 32, {}, kParent);
    const GlobalLayout before = parent.freeze();

    GlobalNames child;
    declareParent(child);
    child.addTarget("cc_d", {}, kChild);
    child.addTarget("cc_e", 16, kChild);
    child.addBlock("CCChild", 16, {}, kChild);  // its stage was inserted before the parent's
    child.addBlock("CCParent", 32, {}, kParent);
    const GlobalLayout after = child.freeze();
    for (const GlobalSlot& slot : before.slots())
        EXPECT_EQ(number(after, slot.name.c_str()), slot.binding) << slot.name;
    EXPECT_EQ(number(before, "CCParent"), 13u);
    EXPECT_EQ(number(after, "cc_d"), 15u);
    EXPECT_EQ(number(after, "CCChild"), 17u);
}

TEST(GlobalNames, GivenFilesOrderDocumentsThatDeclareNoTarget) {
    GlobalNames parent({"parent.json"});
    parent.addBlock("CCParent", 32, {}, kParent);
    GlobalNames child({"parent.json", "child.json"});
    child.addTarget("cc_d", {}, kChild);
    child.addBlock("CCParent", 32, {}, kParent);
    EXPECT_EQ(number(parent.freeze(), "CCParent"), 11u);
    const GlobalLayout after = child.freeze();
    EXPECT_EQ(number(after, "CCParent"), 11u);
    EXPECT_EQ(number(after, "cc_d"), 12u);
}

TEST(GlobalNames, AChildsPinOnANumberOfItsParentIsAClash) {
    GlobalNames names;
    names.addTarget("cc_a", {}, kParent);
    names.addTarget("cc_b", 11, kChild);
    const auto problems = refusals(names);
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].message, "'cc_b' and 'cc_a' both have binding 11 of set 0");
    EXPECT_EQ(problems[0].where.file, "child.json");
    ASSERT_EQ(problems[0].remarks.size(), 1u);
    EXPECT_EQ(problems[0].remarks[0].where.file, "parent.json");
    EXPECT_FALSE(problems[0].help.empty());
}

TEST(GlobalNames, TheSameBlockTwiceIsOneBlock) {
    GlobalNames names;
    names.addBlock("CCSsao", 1040, {}, kParent);
    names.addBlock("CCSsao", 1040, {}, kChild);
    names.addBlock("CCShadow", 304, {}, kParent);
    names.addBlock("CCPunctualLights", 16, {}, kParent);
    const GlobalLayout layout = names.freeze();
    EXPECT_EQ(layout.slots().size(), 12u);  // eleven of ours, and it
    EXPECT_EQ(number(layout, "CCShadow"), 2u);
}

TEST(GlobalNames, TwoSizesOfABlockNameBothPlaces) {
    GlobalNames names;
    names.addBlock("CCSsao", 1040, {}, kParent);
    names.addBlock("CCSsao", 528, {}, kChild);
    names.addBlock("CCCamera", 64, {}, kChild);
    const auto problems = refusals(names);
    ASSERT_EQ(problems.size(), 2u);
    EXPECT_EQ(problems[0].message, "block 'CCSsao' has 528 bytes here and 1040 bytes elsewhere");
    EXPECT_EQ(problems[0].where.line, kChild.line);
    ASSERT_EQ(problems[0].remarks.size(), 1u);
    EXPECT_EQ(problems[0].remarks[0].where.line, kParent.line);
    EXPECT_EQ(problems[1].remarks.at(0).message, "'CCCamera' is built in with 544 bytes");
}

TEST(GlobalNames, BadPinsAreRefused) {
    struct Case {
        const char* name;
        std::uint32_t pin;
        const char* message;
    };
    const std::vector<Case> cases{
        {"helper", 11, "target 'helper' cannot have a binding: it is not in set 0"},
        {"cc_a", 2, "'cc_a' and 'CCShadow' both have binding 2 of set 0"},
        {"cc_a", 3, "'cc_a' and 'cc_shadowMap' both have binding 3 of set 0"},
        {"cc_a", 6, "'cc_a' cannot have binding 6 of set 0: it is kept for 'cc_gbuffer_albedoMap'"},
        {"cc_a", 28, "'cc_a' and 'CCSpotShadow' both have binding 28 of set 0"},
        {"cc_a", 64, "binding 64 of 'cc_a' is too large"},
        {"cc_gbuffer_albedoMap", 12, "'cc_gbuffer_albedoMap' has the number 6 in set 0 and cannot be pinned to 12"},
        {"cc_shadowMap", 12, "'cc_shadowMap' has the number 3 in set 0 and cannot be pinned to 12"},
        {"cc_environment", 4, "target 'cc_environment' has a name that is built in for something else"},
    };
    for (const Case& bad : cases) {
        GlobalNames names;
        names.addTarget(bad.name, bad.pin, kParent);
        const auto problems = refusals(names);
        ASSERT_EQ(problems.size(), 1u) << bad.message;
        EXPECT_EQ(problems[0].message, bad.message);
        EXPECT_EQ(problems[0].where.file, "parent.json");
        EXPECT_FALSE(problems[0].help.empty()) << bad.message;
    }
}

TEST(GlobalNames, NamesOfOtherThingsAreRefused) {
    GlobalNames names;
    names.addTarget("cc_a", {}, kParent);
    names.addTarget("cc_a", {}, kChild);
    names.addBlock("cc_a", 16, {}, kChild);
    names.addBlock("CCLocal", 144, {}, kChild);
    names.pinBlock("cc_a", 12, kChild);
    names.pinBlock("CCForwardLight", 12, kChild);
    names.addBlock("CCB", 16, 14, kParent);
    names.pinBlock("CCB", 15, kChild);
    const auto problems = refusals(names);
    std::vector<std::string> messages;
    for (const Problem& problem : problems) messages.push_back(problem.message);
    EXPECT_EQ(messages,
              (std::vector<std::string>{"target 'cc_a' is declared twice", "block 'cc_a' has the name of a target",
                                        "block 'CCLocal' is filled per object by the framework (set 2)",
                                        "'cc_a' is a target, not a block",
                                        "block 'CCForwardLight' is in set 2 and has its number there",
                                        "'CCB' is pinned to 15 here and to 14 elsewhere"}));
}

TEST(GlobalNames, APinThatNoStageUsesKeepsItsNumberAndIsNoted) {
    GlobalNames names;
    names.pinBlock("CCSsoa", 11, kParent);
    names.addBlock("CCSsao", 1040, {}, kParent);
    const GlobalLayout layout = names.freeze();
    EXPECT_EQ(layout.find("CCSsoa"), nullptr);
    EXPECT_EQ(number(layout, "CCSsao"), 12u);
    ASSERT_EQ(layout.notes().all().size(), 1u);
    EXPECT_EQ(layout.notes().all()[0].severity, Severity::Note);
    EXPECT_NE(layout.notes().all()[0].help.find("'CCSsao'"), std::string::npos);
}

TEST(GlobalNames, SevenUniformBlocksFitAndEightDoNot) {
    GlobalNames fits, full;
    for (GlobalNames* names : {&fits, &full}) {
        names->addBlock("CCA", 16, {}, kParent);
        names->addBlock("CCB", 16, {}, kParent);
        names->addBlock("CCD", 16, {}, kParent);
    }
    EXPECT_EQ(fits.freeze().slots().size(), 14u);  // eleven of ours, and three
    full.addBlock("CCC", 16, {}, kChild);
    const auto problems = refusals(full);
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_NE(problems[0].message.find("8 uniform blocks are too many"), std::string::npos) << problems[0].message;
    EXPECT_NE(problems[0].message.find("CCC"), std::string::npos);
    EXPECT_EQ(problems[0].where.file, "child.json");
}

}  // namespace
}  // namespace crevice
