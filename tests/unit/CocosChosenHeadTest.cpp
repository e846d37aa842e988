// Heads of declarations of which a condition chooses one: each is written with its whole declaration.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"

namespace crevice::cocos {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kColor = "layout(location = 0) out vec4 color;\n";

std::string choice(const std::string& name, const std::string& one, const std::string& other) {
    return "#if USE_A\n#define " + name + " " + one + "\n#else\n#define " + name + " " + other + "\n#endif\n";
}

void compileBoth(const CocosBench& bench) {
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosChosenHead, ModifiersOfVaryings) {
    CocosBench bench;
    bench.effect("out vec4 v_color;\nvoid main() { v_color = vec4(1.0); gl_Position = v_color; }\n",
                 choice("MOD", "in", "in mediump") + kColor + "MOD vec4 v_color;\nvoid main() { color = v_color; }\n");
    const std::string text = bench.fragmentText().flat.text;
    EXPECT_THAT(text, HasSubstr("\nin vec4 v_color;\n"));
    EXPECT_THAT(text, HasSubstr("\nin mediump vec4 v_color;\n"));
    compileBoth(bench);
}

TEST(CocosChosenHead, WhatStandsInFrontAndSeveralInALine) {
    CocosBench bench;
    bench.effect(
        "flat out int v_a; out vec2 v_b;\nvoid main() { v_a = 1; v_b = vec2(1.0); gl_Position = vec4(1.0); }\n",
        choice("MOD", "in", "in highp") + kColor +
            "flat MOD int v_a; MOD vec2 v_b;\nvoid main() { color = vec4(v_b, float(v_a), 1.0); }\n");
    const std::string text = bench.fragmentText().flat.text;
    EXPECT_THAT(text, HasSubstr("\nflat in int v_a;\n"));
    EXPECT_THAT(text, HasSubstr("\nflat in highp int v_a;\n"));
    compileBoth(bench);
}

TEST(CocosChosenHead, BlocksInALineAndInSeveral) {
    CocosBench bench;
    const std::string head = choice("UB", "uniform", "layout(std140) uniform") + kColor;
    bench.fragment(head + "UB Block { vec4 c; };\nvoid main() { color = c; }\n");
    compileBoth(bench);
    bench.fragment(head + "UB Block {\n  vec4 c;\n#if USE_MORE\n  vec4 d;\n#endif\n};\nvoid main() { color = c; }\n");
    compileBoth(bench);
    bench.compile({{"USE_MORE", "1"}});
}

TEST(CocosChosenHead, OverTheEndOfTheLine) {
    CocosBench bench;
    bench.fragment(choice("UB", "uniform", "uniform highp") + kColor +
                   "UB sampler2D\n  map;\nvoid main() { color = texture(map, vec2(0.0)); }\n");
    compileBoth(bench);
}

TEST(CocosChosenHead, WithinAnotherMacro) {
    CocosBench bench;
    const std::string heads = choice("UB", "uniform highp", "uniform lowp");
    const std::string main = "void main() { color = texture(one, vec2(0.0)); }\n";
    bench.fragment(heads + "#define MAP UB sampler2D\n" + kColor + "MAP one;\n" + main);
    const std::string text = bench.fragmentText().flat.text;
    EXPECT_THAT(text, HasSubstr("\nuniform highp sampler2D one;\n"));
    EXPECT_THAT(text, HasSubstr("\nuniform lowp sampler2D one;\n"));
    compileBoth(bench);
    bench.fragment(heads + "#define MAP(n) \\\n  UB sampler2D n\n#define TWO(a, b) MAP(a); MAP(b)\n" + kColor +
                   "TWO(one, two);\nMAP(three); MAP(four);\n" + main);
    compileBoth(bench);
    bench.fragment(heads + "#define MAP(n) UB sampler2D n;\n" + kColor + "MAP(one)\nfloat f() { return 1.0; }\n" +
                   "void main() { color = texture(one, vec2(f())); }\n");
    EXPECT_THAT(bench.fragmentText().flat.text, HasSubstr("#endif\nfloat f() { return 1.0; }\n"));
    compileBoth(bench);
}

TEST(CocosChosenHead, SeveralInOneDeclaration) {
    CocosBench bench;
    bench.effect("flat out vec2 v_a;\nvoid main() { v_a = vec2(1.0); gl_Position = vec4(1.0); }\n",
                 choice("KIND", "flat in", "in") + "#if USE_B\n#define HIGH(t) in highp t\n#else\n" +
                     "#define HIGH(t) in t\n#endif\n#define FLAT HIGH\n" + kColor +
                     "flat FLAT(vec2) v_a;\nvoid main() { color = v_a.xyxy; }\n");
    compileBoth(bench);
    bench.compile({{"USE_B", "1"}});
    bench.fragment(choice("UB", "uniform", "layout(set = 1) uniform") +
                   "#if USE_B\n#define IMAGE highp sampler2D one; uniform highp sampler2D\n#else\n"
                   "#define IMAGE sampler2D one; uniform sampler2D\n#endif\n" +
                   kColor +
                   "UB IMAGE two;\nvoid main() { color = texture(one, vec2(0.0)) + texture(two, vec2(0.0)); }\n");
    EXPECT_THAT(bench.fragmentText().flat.text, HasSubstr("\nlayout(set = 1) uniform highp sampler2D one; "));
    compileBoth(bench);
    bench.compile({{"USE_A", "1"}, {"USE_B", "1"}});
}

TEST(CocosChosenHead, BracesInMacrosOfTheirOwn) {
    CocosBench bench;
    const std::string block = "#define END };\n" + kColor + "BEGIN(Block)\n  vec4 c;\n  vec4 d;\nEND\n" +
                              "uniform sampler2D map;\nvoid main() { color = c + texture(map, d.xy); }\n";
    bench.fragment("#define BEGIN(n) uniform n {\n" + block);
    EXPECT_NE(bench.compile().info.find("Block"), nullptr);
    bench.fragment(
        "#if USE_A\n#define BEGIN(n) uniform n {\n#else\n#define BEGIN(n) layout(std140) uniform n {\n#endif\n" +
        block);
    compileBoth(bench);
    bench.fragment("#define LOOP(n) for (int i = 0; i < n; ++i) {\n#define DONE }\nfloat gone() { return missing; }\n" +
                   kColor + "void main() { color = vec4(0.0); LOOP(3) color.x += float(i); DONE }\n");
    EXPECT_THAT(bench.fragmentText().flat.text, Not(HasSubstr("gone")));
    bench.compile();
}

TEST(CocosChosenHead, ManyInALineDoNotMultiply) {
    CocosBench bench;
    std::string line;
    for (int i = 0; i < 12; ++i) line += "UB vec4 u" + std::to_string(i) + "; ";
    std::string inOne;
    for (int i = 0; i < 12; ++i) inOne += "UB" + std::to_string(i) + " ";
    std::string heads;
    for (int i = 0; i < 12; ++i) heads += choice("UB" + std::to_string(i), "uniform", "uniform highp");
    bench.fragment(choice("UB", "in", "in highp") + heads + kColor + line + "\n" + inOne + "vec4 all;\n" +
                   "void main() { color = vec4(1.0); }\n");
    EXPECT_LT(bench.fragmentText().flat.text.size(), 20'000u);
}

TEST(CocosChosenHead, ContinuedConditionsInTheRest) {
    CocosBench bench;
    bench.effect("out vec2 v_a;\nvoid main() { v_a = vec2(1.0); gl_Position = vec4(1.0); }\n",
                 choice("TAKE(t)", "in highp t", "in t") + kColor +
                     "TAKE(vec2)\n#if USE_A && \\\n  USE_B\n  v_b\n#else\n  v_a\n#endif\n;\n" +
                     "void main() { color = vec4(1.0); }\n");
    const std::string text = bench.fragmentText().flat.text;
    EXPECT_THAT(text, HasSubstr("\nin highp vec2\n#if USE_A &&"));
    EXPECT_THAT(text, HasSubstr("\nin vec2\n#if USE_A &&"));
    compileBoth(bench);
}

TEST(CocosChosenHead, StatementsInABranchAreNotReadBeyondIt) {
    CocosBench bench;
    bench.effect("out vec2 v_a;\nvoid main() { v_a = vec2(1.0); gl_Position = vec4(1.0); }\n",
                 choice("TAKE", "in highp", "in") + kColor +
                     "#if USE_B\nTAKE vec2\n#else\nTAKE vec3\n#endif\n  v_a;\nvoid main() { color = vec4(1.0); }\n");
    const std::string text = bench.fragmentText().flat.text;
    std::ptrdiff_t open = 0;
    for (const std::string& line : words(text)) open += int(line.starts_with("#if")) - int(line == "#endif");
    EXPECT_EQ(open, 0);
}

}  // namespace
}  // namespace crevice::cocos
