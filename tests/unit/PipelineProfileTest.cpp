// The keys for Cocos' effects: "profile", "fallbacks", "macros", and queues of several phases.
#include "PipelineTestTools.h"

namespace crevice {
namespace {

using test::document;
using test::parse;
using test::problemsOf;

TEST(PipelineProfile, IsOursUnlessTheDocumentNamesOne) {
    EXPECT_EQ(parse(document("", "")).profile, Profile::Crevice);
    EXPECT_EQ(parse(document("", "", R"(, "profile": "cocos-3.3")")).profile, Profile::Cocos33);
    EXPECT_EQ(parse(document("", "", R"(, "profile": "cocos-3.6")")).profile, Profile::Cocos36);
    const std::string unknown = problemsOf(document("", "", R"(, "profile": "cocos-3.8")"));
    EXPECT_NE(unknown.find("cocos-3.8"), std::string::npos) << unknown;
    EXPECT_NE(unknown.find("cocos-3.6"), std::string::npos) << unknown;
}

TEST(PipelineProfile, FallbacksAreOnUntilTheyAreSwitchedOff) {
    const PipelineDesc plain = parse(document("", "", R"(, "profile": "cocos-3.6")"));
    EXPECT_TRUE(plain.fallbacks.rebindLiterals);
    EXPECT_TRUE(plain.fallbacks.globalSamplers);
    const PipelineDesc off =
        parse(document("", "", R"(, "profile": "cocos-3.6", "fallbacks": { "rebindLiterals": false })"));
    EXPECT_FALSE(off.fallbacks.rebindLiterals);
    EXPECT_TRUE(off.fallbacks.globalSamplers);
}

TEST(PipelineProfile, WhatOnlyAProfileUsesNeedsOne) {
    EXPECT_NE(problemsOf(document("", "", R"(, "fallbacks": { "globalSamplers": false })"))
                  .find("'fallbacks' without 'profile' has no effect"),
              std::string::npos);
    EXPECT_NE(problemsOf(document("", "", R"(, "macros": { "CC_USE_HDR": true })"))
                  .find("'macros' without 'profile' has no effect"),
              std::string::npos);
}

TEST(PipelineProfile, MacrosAreBoolsIntegersOrWords) {
    const PipelineDesc desc = parse(document("", "", R"(, "profile": "cocos-3.6", "macros": { "CC_USE_HDR": false })"));
    EXPECT_FALSE(desc.macros.find("CC_USE_HDR")->boolean());
    EXPECT_NE(problemsOf(document("", "", R"(, "profile": "cocos-3.6", "macros": { "A": 0.5 })"))
                  .find("define 'A' of 'macros' must be a bool, an integer or a string"),
              std::string::npos);
}

TEST(PipelineProfile, QueuesTakeOnePhaseOrSeveral) {
    const PipelineDesc desc = parse(document(
        "", R"(, "queues": [ { "phase": "a" }, { "phases": ["default", "deferred"], "sort": "back-to-front" }, {} ])"));
    const std::vector<QueueDesc>& queues = desc.flows.at(0).stages.at(0).queues;
    ASSERT_EQ(queues.size(), 3u);
    EXPECT_EQ(queues[0].phases, std::vector<std::string>{"a"});
    EXPECT_EQ(queues[1].phases, (std::vector<std::string>{"default", "deferred"}));
    EXPECT_EQ(queues[2].phases, std::vector<std::string>{"default"});
    EXPECT_NE(problemsOf(document("", R"(, "queues": [ { "phase": "a", "phases": ["b"] } ])"))
                  .find("has both 'phase' and 'phases'"),
              std::string::npos);
    EXPECT_NE(problemsOf(document("", R"(, "queues": [ { "phases": [3] } ])")).find("a phase must be a name"),
              std::string::npos);
}

}  // namespace
}  // namespace crevice
