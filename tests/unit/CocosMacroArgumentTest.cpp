// Preprocessor lines between the brackets of a macro's call: such a macro is written out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"

namespace crevice::cocos {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kColor = "layout(location = 0) out vec4 color;\n";

TEST(CocosMacroArgument, ConditionsInTheText) {
    CocosBench bench;
    bench.fragment(
        "#define MAD(a, b) (a + b * a)\n" + kColor +
        "void main() { float y = MAD(1.0,\n#if USE_A\n  2.0\n#else\n  3.0\n#endif\n  ); color = vec4(y); }\n");
    EXPECT_EQ(words(bench.fragmentText().flat.text),
              (std::vector<std::string>{"#define MAD(a, b) (a + b * a)", "layout(location = 0) out vec4 color;",
                                        "void main() { float y = (1.0 +", "#if USE_A", "2.0", "#else", "3.0", "#endif",
                                        "* 1.0); color = vec4(y); }"}));
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosMacroArgument, ConditionsOfAnotherMacro) {
    CocosBench bench;
    bench.fragment(
        "#define MAD(a, b) (a + b)\n#if USE_A\n#define CH(x) \\\n#if USE_B \\\n x \\\n#else \\\n 2.0 "
        "\\\n#endif\n#else\n"
        "#define CH(x) \\\n (x + 1.0) \\\n#if USE_C \\\n + 1.0 \\\n#endif\n#endif\n" +
        kColor + "void main() { float y = MAD(CH(1.0), 2.0); float z = CH(y); color = vec4(MAD(y,\n  CH(z))); }\n");
    for (const auto* a : {"0", "1"})
        for (const auto* b : {"0", "1"}) bench.compile({{"USE_A", a}, {"USE_B", b}, {"USE_C", b}});
}

TEST(CocosMacroArgument, TheMacroItselfInItsArgument) {
    CocosBench bench;
    bench.fragment("#define ADD(a, b) (a + b)\n#define TWICE(x) ADD(x, x)\n" + kColor +
                   "void main() { float y = TWICE(ADD(1.0,\n#if USE_A\n  TWICE(2.0)\n#elif USE_B\n  ADD(4.0, "
                   "TWICE(1.0))\n#endif\n#if !USE_A && !USE_B\n  3.0\n#endif\n  )); color = vec4(y); }\n");
    EXPECT_THAT(bench.fragmentText().flat.text, HasSubstr("(2.0 + 2.0)"));
    bench.compile();
    bench.compile({{"USE_A", "1"}});
    bench.compile({{"USE_B", "1"}});
}

TEST(CocosMacroArgument, WhatIsCalledWithTheArgumentIsWrittenOutToo) {
    CocosBench bench;
    bench.fragment("#define ADD(a, b) (a + b)\n#define ALIAS ADD\n#define OUTER(x) ALIAS(x, ADD(x, 1.0))\n" + kColor +
                   "void main() { float y = OUTER(\n#if USE_A\n  2.0\n#else\n  3.0\n#endif\n  ); color = vec4(y); }\n");
    bench.compile();
    bench.compile({{"USE_A", "1"}});
    bench.fragment("#define TWO \\\n (1.0 \\\n#if USE_A \\\n + 1.0 \\\n#endif \\\n )\n#define SAME(x) (x)\n" +
                   std::string("#define ALIAS SAME\n") + kColor + "void main() { color = vec4(ALIAS(SAME(TWO))); }\n");
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosMacroArgument, AChosenMacroWithinAnotherInItsArgument) {
    CocosBench bench;
    bench.fragment(
        "#if USE_A\n#define ONE(a) (a)\n#else\n#define ONE(a) (a * 2.0)\n#endif\n#if USE_B\n"
        "#define OTHER(a) ONE(a)\n#else\n#define OTHER(a) a\n#endif\n" +
        kColor +
        "void main() { float y = ONE(OTHER(\n#if USE_C\n  1.0\n#else\n  2.0\n#endif\n  )); "
        "color = vec4(y); }\n");
    for (const auto* a : {"0", "1"})
        for (const auto* b : {"0", "1"}) bench.compile({{"USE_A", a}, {"USE_B", b}});
}

TEST(CocosMacroArgument, FunctionsAreLeftAlone) {
    CocosBench bench;
    const std::string text =
        "void place(inout vec4 at, vec2 by\n#if USE_A\n  , float more\n#endif\n) { at.xy += by; }\n" + kColor +
        "void main() { color = vec4(0.0); place(color, vec2(1.0)\n#if USE_A\n  , 1.0\n#endif\n  ); }\n";
    bench.fragment(text);
    EXPECT_EQ(words(bench.fragmentText().flat.text), words(text));
    bench.compile({{"USE_A", "1"}});
    bench.fragment("#define PLACE place\n" + text + "#if 0\nPLACE(\n#endif\n");  // No macro with parameters.
    EXPECT_THAT(bench.fragmentText().flat.text, Not(HasSubstr("#define PLACE PLACE")));
}

TEST(CocosMacroArgument, BracketsThatABranchCloses) {
    CocosBench bench;
    const std::string add = "#define ADD(a, b) ((a) + (b))\n" + kColor;
    bench.fragment(add + "void main() { color = vec4(ADD(1.0,\n#if USE_A\n  2.0));\n#else\n  3.0));\n#endif\n}\n");
    const std::string text = bench.fragmentText().flat.text;
    EXPECT_THAT(text, HasSubstr("\n#if USE_A\n((1.0) + (2.0)));\n#else\n((1.0) + (3.0)));\n#endif\n"));
    bench.compile();
    bench.compile({{"USE_A", "1"}});
    bench.fragment(add + "void main() { color = vec4(ADD(1.0\n#if USE_A\n  , 2.0\n#else\n  , 3.0\n#endif\n  )); }\n");
    bench.compile();
    bench.compile({{"USE_A", "1"}});
    bench.fragment(add + "void main() { color = vec4(ADD(1.0\n#if USE_A\n  , 2.0\n#endif\n  )); }\n");
    EXPECT_EQ(bench.compileError({{"USE_A", "1"}}), "");  // The variant that gives too few is the compiler's.
    EXPECT_NE(bench.compileError(), "");
}

TEST(CocosMacroArgument, ABranchThatEndsWithinACallIsTheCompilersAlone) {
    CocosBench bench;
    bench.fragment("#define ADD(a, b) ((a) + (b))\n" + kColor +
                   "#if USE_A\nfloat q = ADD(1.0,\n#else\nfloat q = 2.0;\n#endif\nvoid main() { color = vec4(ADD(q,\n"
                   "#if USE_B\n1.0\n#else\n2.0\n#endif\n)); }\n");
    EXPECT_EQ(bench.compileError(), "");
    EXPECT_NE(bench.compileError({{"USE_A", "1"}}), "");
}

TEST(CocosMacroArgument, BranchesThatArePasted) {
    CocosBench bench;
    bench.fragment("#define CAT(a, b) a##b\n" + kColor +
                   "float oneTwo() { return 1.0; }\nfloat oneThree() { return 2.0; }\n" +
                   "void main() { color = vec4(CAT(one,\n#if USE_A\n  Two\n#else\n  Three\n#endif\n  )()); }\n");
    EXPECT_THAT(bench.fragmentText().flat.text, HasSubstr("\noneTwo\n"));
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosMacroArgument, ConditionsMayUseAMacroThatIsWrittenOut) {
    CocosBench bench;
    bench.fragment("#define ADD(a, b) ((a) + (b))\n#define COUNT ADD(1, 2)\n" + kColor +
                   "void main() { float y = ADD(1.0,\n#if USE_A\n  2.0\n#else\n  3.0\n#endif\n);\n"
                   "#if COUNT > 2\n  color = vec4(y);\n#else\n  color = missing;\n#endif\n}\n");
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosMacroArgument, ValuesKeepTheSemicolonOfTheirStatement) {
    CocosBench bench;
    bench.fragment("#define PICK(a, b) \\\n#if USE_A \\\n  a \\\n#else \\\n  b \\\n#endif\n#define SAME(x) x\n" +
                   kColor +
                   "void main() { float y = PICK(1.0, 2.0);\n  float z =\n  PICK(y, 2.0);\n"
                   "  z = SAME(\n#if USE_A\n  y\n#else\n  z\n#endif\n);\n  color = vec4(z); }\n");
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosMacroArgument, NestingAndOpenCallsEnd) {
    const auto repeat = [](const std::string& text, int count) {
        std::string all;
        for (int i = 0; i < count; ++i) all += text;
        return all;
    };
    const std::string macros = "#define ADD(a, b) (a + b)\n#define CH(x) \\\n#if USE_A \\\n x \\\n#endif\n" + kColor;
    const auto nested = [&](int depth) {
        return macros + "void main() { color = vec4(" + repeat("ADD(", depth) + "CH(1.0)" + repeat(", 1.0)", depth) +
               "); }\n";
    };
    CocosBench bench;
    bench.fragment(nested(30));
    bench.compile({{"USE_A", "1"}});
    bench.fragment(nested(2000));
    EXPECT_EQ(bench.problem().message, "the call of macro 'ADD' nests macros deeper than 64");
    bench.fragment(macros + "void main() {}\n" + repeat("CH(\n", 20'000));
    EXPECT_EQ(bench.problem().message, "the call of macro 'CH' is not closed");
    bench.fragment(macros + "void main() {}\nfloat y = ADD(\n" + repeat("CH(\n#if USE_A\n", 10'000));
    EXPECT_THAT(bench.problem().message, HasSubstr("is not closed"));
}

TEST(CocosMacroArgument, TheSemicolonBehindADirectiveIsSwallowedAndTheRestKept) {
    CocosBench bench;
    bench.fragment("#define SET(x) \\\n#if USE_A \\\nx = 1.0; \\\n#endif\nvoid f() { float a; SET(a); a += 2.0; }\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text),
                testing::ElementsAre("#define SET SET", "void f() { float a;", "#if USE_A", "a = 1.0;", "#endif",
                                     "a += 2.0; }"));
}

TEST(CocosMacroArgument, MacrosThatCallSuchMacrosAreExpandedToo) {
    CocosBench bench;
    bench.fragment(
        "#define INNER(t, n) \\\n#if HIGHP \\\nt n##_low; \\\n#endif \\\n#pragma //\n#define MIDDLE(n) INNER(vec3, n)\n"
        "#define OUTER(a, b) MIDDLE(a) MIDDLE(b)\n#define plain(x) (x)\nstruct S {\n  OUTER(first, second);\n"
        "  float z;\n};\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text),
                testing::ElementsAre("#define INNER INNER", "#define MIDDLE MIDDLE", "#define OUTER OUTER",
                                     "#define plain(x) (x)", "struct S {", "#if HIGHP", "vec3 first_low;", "#endif",
                                     "#if HIGHP", "vec3 second_low;", "#endif", "float z;", "};"));
}

TEST(CocosMacroArgument, AStatementEndsBehindTheLastBranch) {
    CocosBench bench;
    bench.fragment(
        "#define INIT(v) v = 1.0 \\\n#if USE_A \\\n + 1.0 \\\n#endif\n#define DONE(v) v = 1.0; \\\n#if USE_A "
        "\\\n v += 1.0; \\\n#endif\n" +
        kColor + "void main() { float x;\nINIT(x);\nDONE(x);\n color = vec4(x); }\n");
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

// Bounded by what is written and read, not by time: each of these took seconds or never ended.
TEST(CocosMacroArgument, WhatMultipliesEnds) {
    const auto repeat = [](const std::string& text, int count) {
        std::string all;
        for (int i = 0; i < count; ++i) all += text;
        return all;
    };
    CocosBench bench;
    const std::string main = kColor + "void main() { color = vec4(1.0); }\n";
    const std::string add = "#define ADD(a, b) (a + b)\n#define CH(x) \\\n#if USE_A \\\n x \\\n#endif\n";
    bench.fragment(add + "#define TWICE(x) x x\nfloat z() { return " + repeat("TWICE(", 20) + "CH(1.0)" +
                   repeat(")", 20) + "; }\n" + main);
    EXPECT_THAT(bench.problem().message, HasSubstr("write more than it can hold"));
    bench.fragment(add + "float z() { return ADD(1.0\n" + repeat("#if USE_A\n, 2.0\n#else\n, 3.0\n#endif\n", 400) +
                   "); }\n" + main);
    EXPECT_THAT(bench.compileError(), HasSubstr("error"));
    bench.fragment(add + repeat("ADD(1.0\n#if USE_A\n, 2.0\n#endif\n", 8000) + main);
    EXPECT_EQ(bench.problem().message, "the call of macro 'ADD' is not closed within 64 KB");
    bench.fragment(add + "#if USE_A\n" + repeat("#undef ADD\n#define ADD(a, b) a\n", 5000) + "#endif\n" + main);
    EXPECT_EQ(bench.problem().message, "");  // Equal ones are one.
    std::string branches = "#if USE_A\n", choices;
    for (int i = 0; i < 6000; ++i) branches += "#elif USE_" + std::to_string(i) + "\n";
    bench.fragment(branches + "#endif\n" + main);
    EXPECT_EQ(bench.problem().message, "the branches of this stage's conditions are too many to keep");
    for (int i = 0; i < 251; ++i)
        choices += "#if USE_" + std::to_string(i) + "\n#define CH(x) x * " + std::to_string(i) + "\n#endif\n";
    bench.fragment(add + choices + main);
    EXPECT_EQ(bench.problem().message, "macro 'CH' has more than 250 definitions");
}

}  // namespace
}  // namespace crevice::cocos
