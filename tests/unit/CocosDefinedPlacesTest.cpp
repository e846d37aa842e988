// Macros that are written out hold where their #define stands, and nowhere else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"

namespace crevice::cocos {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kColor = "layout(location = 0) out vec4 color;\n";
const std::string kSplit = "\n#if USE_B\n0.5\n#else\n0.25\n#endif\n";

std::string mainOf(const std::string& statements) { return "void main() {\n" + statements + "}\n"; }

std::size_t countOf(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(CocosDefinedPlaces, WithoutItsDefinitionTheNameMeansWhatGlslMeans) {
    CocosBench bench;
    bench.fragment("#if USE_A\n#define mix(a, b, c) ((a) + (b) * (c))\n#endif\n" + kColor +
                   mainOf("color = vec4(mix(1.0, 4.0," + kSplit + "));\n"));
    const std::string text = bench.fragmentText().flat.text;
    EXPECT_THAT(text, HasSubstr("((1.0) + (4.0) * ("));
    EXPECT_THAT(text, HasSubstr("\n#else\nmix(1.0, 4.0,"));
    bench.compile();
    bench.compile({{"USE_A", "1"}});
    bench.compile({{"USE_B", "1"}});
}

TEST(CocosDefinedPlaces, FunctionInTheOtherBranchIsNoCall) {
    CocosBench bench;
    bench.fragment(
        "#if USE_A\n#define ADD(a, b) ((a) + (b))\n#else\nfloat ADD(float a, float b) { return a + b; }\n#endif\n" +
        kColor + mainOf("color = vec4(ADD(1.0," + kSplit + "));\n"));
    EXPECT_THAT(bench.fragmentText().flat.text, HasSubstr("\nfloat ADD(float a, float b) { return a + b; }\n"));
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosDefinedPlaces, StatementWithoutDefinitionDoesNotVanish) {
    CocosBench bench;
    bench.fragment("#if USE_A\n#define st(v, k) v = v + k\n#elif USE_C\n#define st(v, k) v = v - k\n#endif\n" + kColor +
                   mainOf("float y = 1.0;\nst(y," + kSplit + ");\ncolor = vec4(y);\n"));
    EXPECT_THAT(bench.compileError(), HasSubstr("st"));
    EXPECT_EQ(bench.compileError({{"USE_A", "1"}}), "");
    EXPECT_EQ(bench.compileError({{"USE_C", "1"}}), "");
}

TEST(CocosDefinedPlaces, DefinedInEveryBranchLeavesNothingOver) {
    CocosBench bench;
    bench.fragment("#if USE_A\n#define ADD(a, b) ((a) + (b))\n#else\n#define ADD(a, b) ((b) + (a))\n#endif\n" + kColor +
                   mainOf("color = vec4(ADD(1.0," + kSplit + "));\n"));
    EXPECT_THAT(bench.fragmentText().flat.text, Not(HasSubstr("\nADD(")));
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosDefinedPlaces, SameConditionAgainAndGuardsAreNoChoice) {
    CocosBench bench;
    bench.chunk("guarded", "#ifndef GUARD\n#define GUARD\n#define MUL(a, b) ((a) * (b))\n#endif\n");
    bench.fragment("#include <guarded>\n#if USE_A\n#define ADD(a, b) ((a) + (b))\n#endif\n" + kColor +
                   mainOf("float y = MUL(2.0," + kSplit + ");\n#if USE_A\ny = ADD(y," + kSplit +
                          ");\n#endif\ncolor = vec4(y);\n"));
    EXPECT_EQ(countOf(bench.fragmentText().flat.text, "== 1"), 0u);
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosDefinedPlaces, UndefEndsTheName) {
    CocosBench bench;
    bench.effect("out vec2 v;\nvoid main() { v = vec2(1.0); gl_Position = vec4(1.0); }\n",
                 "#define IN in\nIN vec2 v;\n#undef IN\n" + kColor + "float use(float IN) { return IN; }\n" +
                     mainOf("color = vec4(use(v.x));\n"));
    EXPECT_THAT(bench.fragmentText().flat.text, HasSubstr("\nfloat use(float IN) { return IN; }\n"));
    bench.compile();
}

TEST(CocosDefinedPlaces, NoNameInFrontOfItsDefinition) {
    CocosBench bench;
    bench.effect("out vec2 v;\nvoid main() { v = vec2(1.0); gl_Position = vec4(1.0); }\n",
                 kColor + "float use(float IN) { return IN; }\n#define IN in\nIN vec2 v;\n" +
                     mainOf("color = vec4(use(v.x));\n"));
    EXPECT_THAT(bench.fragmentText().flat.text, HasSubstr("\nfloat use(float IN) { return IN; }\n"));
    bench.compile();
}

TEST(CocosDefinedPlaces, ContinuedLines) {
    CocosBench bench;
    bench.fragment("#define ADD(a, b) ((a) + (b))\n" + kColor +
                   mainOf("color = vec4(ADD(1.0,\n#if USE_A && \\\n  USE_B\n0.5\n#else\n0.25\n#endif\n));\n"));
    EXPECT_THAT(bench.fragmentText().flat.text, HasSubstr("#if USE_A &&"));
    bench.compile();
    bench.compile({{"USE_A", "1"}, {"USE_B", "1"}});
    bench.fragment("#if USE_A\n#define BE(v) (v)\n#else\n#define BE(v) \\\n#if USE_B \\\n(v) \\\n#else \\\n(-v) \\\n" +
                   std::string("#endif\n#endif\n") + kColor +
                   mainOf("float y = 1.0;\nfloat z = 1.0 + \\\n  BE(y);\ncolor = vec4(z);\n"));
    bench.compile();
    bench.compile({{"USE_A", "1"}});
    bench.compile({{"USE_B", "1"}});
}

TEST(CocosDefinedPlaces, UndefInABranchLeavesTheNameThere) {
    CocosBench bench;
    bench.fragment("#define ADD(a, b) ((a) + (b))\n#if USE_A\n#undef ADD\n" +
                   std::string("float ADD(float a, float b) { return a * b; }\n#endif\n") + kColor +
                   mainOf("color = vec4(ADD(1.0," + kSplit + "));\n"));
    EXPECT_THAT(bench.fragmentText().flat.text, HasSubstr("\n#else\nADD(1.0,"));
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosDefinedPlaces, ADefinitionAboveAllConditionsHoldsBesideAnEqualOne) {
    CocosBench bench;
    bench.effect("out vec2 v;\nvoid main() { v = vec2(1.0); gl_Position = vec4(1.0); }\n",
                 "#define HEAD in\n#if USE_A\n#ifndef HEAD\n#define HEAD in\n#endif\n#endif\nHEAD vec2 v;\n" + kColor +
                     mainOf("color = v.xyxy;\n"));
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosDefinedPlaces, ConditionsThatAskForADefinedNameAreNotTheSameTwice) {
    CocosBench bench;
    bench.fragment("#ifdef LATE\n#define ADD(a, b) ((a) + (b))\n#endif\n#define LATE\n" + kColor +
                   "float ADD(float a, float b);\n#ifdef LATE\nfloat use() { return ADD(1.0," + kSplit +
                   "); }\n#endif\n" + "float ADD(float a, float b) { return a + b; }\n" +
                   mainOf("color = vec4(use());\n"));
    bench.compile();
}

TEST(CocosDefinedPlaces, ConditionsNestAsDeepAsGlslTakes) {
    const auto nested = [](int depth) {
        std::string text;
        for (int i = 0; i < depth; ++i) text += "#if USE_A\n";
        for (int i = 0; i < depth; ++i) text += "#endif\n";
        return text + kColor + mainOf("color = vec4(1.0);\n");
    };
    CocosBench bench;
    bench.fragment(nested(64));
    bench.compile({{"USE_A", "1"}});
    bench.fragment(nested(65));
    EXPECT_EQ(bench.problem().message, "conditions are nested deeper than 64");
}

}  // namespace
}  // namespace crevice::cocos
