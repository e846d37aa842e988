// Declarations of several names with conditions among their qualifiers: each name has a number and all the qualifiers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"

namespace crevice::cocos {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string replaced(std::string text, const std::string& storage) {
    for (std::size_t at = 0; (at = text.find("IO", at)) != std::string::npos;) text.replace(at, 2, storage);
    return text;
}

/// A pass whose varyings v_a and v_b are declared so, `IO` being in or out.
void declare(const CocosBench& bench, const std::string& declaration, const std::string& behind = "") {
    bench.effect(replaced(declaration, "out") + "void main() { v_a = v_b = vec2(1.0); gl_Position = vec4(0.0); }\n",
                 replaced(declaration, "in") + behind +
                     "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(v_a, v_b); }\n");
}

StageText numbered(const CocosBench& bench) {
    Problems problems;
    std::vector<StageText> stages = bench.flatten(problems);
    numberStages(stages, {}, {}, problems);
    problems.throwIfErrors();
    return stages.back();
}

TEST(CocosDeclarationFront, ConditionsStandInFrontOfEachName) {
    const CocosBench bench;
    declare(bench, "#if USE_A\nflat\n#endif\nIO vec2 v_a, v_b;\n");
    EXPECT_EQ(bench.compileError({{"USE_A", "0"}}), "");
    EXPECT_EQ(bench.compileError({{"USE_A", "1"}}), "");
    const StageText text = numbered(bench);
    EXPECT_THAT(words(text.flat.text),
                ElementsAre("#if USE_A", "flat", "#endif", "layout(location = 0) in vec2 v_a;", "#if USE_A", "flat",
                            "#endif", "layout(location = 1) in vec2 v_b;", "layout(location = 0) out vec4 color;",
                            "void main() { color = vec4(v_a, v_b); }"));
}

TEST(CocosDeclarationFront, LinesThatWereAddedKeepThePlacesBehindThem) {
    const CocosBench bench;
    declare(bench, "#if USE_A\nflat\n#endif\nIO vec2 v_a, v_b;\n", "float x = missing;\n");
    const StageText text = numbered(bench);
    EXPECT_EQ(static_cast<std::size_t>(std::count(text.flat.text.begin(), text.flat.text.end(), '\n')),
              text.flat.lines.size());
    EXPECT_EQ(text.conditionOf.size(), text.flat.lines.size());
    // Seven lines down to the vertex program, five of it, two between, and the fifth of the fragment program.
    EXPECT_EQ(originOf(text, "in vec2 v_b"), originOf(text, "in vec2 v_a"));
    EXPECT_THAT(bench.compileError({{"USE_A", "1"}}), HasSubstr("t.effect:19:"));
}

TEST(CocosDeclarationFront, BranchesNestAndHaveOthers) {
    const CocosBench bench;
    declare(bench,
            "float k = 1.0; mediump\n#if USE_B\n#if USE_A\nflat\n#else\nsmooth\n#endif\n#endif\nIO\nvec2 v_a,\nv_b;\n");
    for (const char* a : {"0", "1"})
        for (const char* b : {"0", "1"}) EXPECT_EQ(bench.compileError({{"USE_A", a}, {"USE_B", b}}), "") << a << b;
}

TEST(CocosDeclarationFront, QualifiersInFrontOfBranchesHoldForEachName) {
    const CocosBench bench;
    declare(bench, "#if USE_A\n#define Q flat IO\n#else\n#define Q IO\n#endif\nmediump\nQ vec2 v_a, v_b;\n");
    EXPECT_EQ(bench.compileError({{"USE_A", "0"}}), "");
    EXPECT_EQ(bench.compileError({{"USE_A", "1"}}), "");
    const std::string text = numbered(bench).flat.text;
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find("mediump", at)) != std::string::npos; ++at) ++count;
    EXPECT_EQ(count, 3u);  // in front of the branches, and of the second name in each
}

TEST(CocosDeclarationFront, WhatStandsBetweenIsNotRepeated) {
    // The function in the branch is none of the statement's words.
    const CocosBench bench;
    declare(bench, "IO vec2 v_a, v_b;\n", "#if USE_A\nfloat f() { return 1.0; }\n#endif\n");
    const std::string text = numbered(bench).flat.text;
    EXPECT_THAT(text, HasSubstr("layout(location = 0) in vec2 v_a; layout(location = 1) in vec2 v_b;"));
    EXPECT_EQ(bench.compileError({{"USE_A", "1"}}), "");
}

}  // namespace
}  // namespace crevice::cocos
