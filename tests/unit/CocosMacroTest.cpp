// Macros of Cocos' dialect: hoisted, with preprocessor lines in their bodies, in front of varyings, nested, bombs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"

namespace crevice::cocos {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

TEST(CocosMacro, PragmaDefineHoldsForTheWholeStage) {
    CocosBench bench;
    bench.chunk("late", "#pragma define MODE_B 1\n#pragma define twice(x) ((x) * 2.0)\n");
    bench.fragment(
        "layout(location = 0) out vec4 color;\n#if MODE == MODE_B\nfloat f() { return twice(0.5); }\n#else\n"
        "float f() { return 0.0; }\n#endif\n#include <late>\nvoid main() { color = vec4(f()); }\n");
    const StageText text = bench.fragmentText();
    const auto lines = words(text.flat.text);
    ASSERT_GE(lines.size(), 2u);
    EXPECT_EQ(lines[0], "#define MODE_B 1");
    EXPECT_EQ(lines[1], "#define twice(x) ((x) * 2.0)");
    EXPECT_EQ(originOf(text, "#define twice"), "late.chunk:2");
    EXPECT_THAT(macroNames(text), ElementsAre("MODE"));  // MODE_B is the stage's own.
    bench.compile({{"MODE", "1"}});
}

TEST(CocosMacro, BranchesOfOtherVersionsDefineNothing) {
    CocosBench bench;
    bench.fragment(
        "#if __VERSION__ < 300\n#pragma define A 1\n#elif __VERSION__ >= 450\n#pragma define A 2\n#else\n"
        "#pragma define A 3\n#endif\n");
    EXPECT_EQ(words(bench.fragmentText().flat.text)[0], "#define A 2");
}

/// The shadow pass of a surface: the effect says what a macro is, and then the pass' own chunk says so otherwise.
TEST(CocosMacro, DefinedAgainItHasTheNewMeaning) {
    CocosBench bench;
    bench.chunk("for-shadows", "#define WAY 0\n#ifndef WAY\n  #define WAY 7\n#endif\n");
    bench.fragment(
        "layout(location = 0) out vec4 color;\n#pragma define-meta HAS_WAY\n#define WAY HAS_WAY\n"
        "float before() { return float(WAY); }\n#include <for-shadows>\n#if WAY\n#error the first one holds\n#endif\n"
        "#if WAY > 0\n#error the guarded one holds\n#endif\n"
        "#define twice(x) ((x) * 2.0)\n#define twice(x) ((x) + (x))\n"
        "void main() { color = vec4(before(), twice(0.5), float(WAY), 1.0); }\n");
    bench.compile({{"HAS_WAY", "1"}});
    bench.compile({{"HAS_WAY", "0"}});
    EXPECT_THAT(macroNames(bench.fragmentText()), ElementsAre("HAS_WAY"));
}

TEST(CocosMacro, DefinedAgainBehindAPragmaItHasTheNewMeaning) {
    CocosBench bench;
    bench.fragment(
        "layout(location = 0) out vec4 color;\n#pragma define WAY 1\n#define WAY 2\n#if WAY != 2\n#error pragma's\n"
        "#endif\nvoid main() { color = vec4(WAY); }\n");
    bench.compile({});
}

TEST(CocosMacro, DifferentDefinitionsKeepTheirConditions) {
    CocosBench bench;
    bench.fragment(
        "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(A); }\n#if USE_X\n#pragma define A 1.0\n"
        "#else\n#pragma define A 2.0\n#endif\n");
    const auto lines = words(bench.fragmentText().flat.text);
    EXPECT_EQ(lines[0], "#if (USE_X)");
    EXPECT_EQ(lines[1], "#define A 1.0");
    EXPECT_EQ(lines[2], "#elif !((USE_X))");
    EXPECT_EQ(lines[3], "#define A 2.0");
    EXPECT_EQ(lines[4], "#endif");
    bench.compile({{"USE_X", "0"}});
    bench.compile({{"USE_X", "1"}});
}

/// The attributes that a variant has, without those that a program always has.
std::vector<std::string> inputsOf(const CocosBench& bench, const Defines& defines) {
    std::vector<std::string> inputs;
    for (const ShaderVariable& input : bench.compile(defines).info.inputs)
        inputs.push_back(input.name + " " + input.type);
    return inputs;
}

TEST(CocosMacro, DefinitionsThatAConditionChoosesAreAllWritten) {
    CocosBench bench;
    bench.effect(
        "#if USE_WIDE\n#define TAKE(name) in vec4 name;\n#define ADD(name) at += name;\n"
        "#elif USE_NONE\n#define TAKE(name)\n#define ADD(name)\n"
        "#else\n#define TAKE(name) in vec2 name;\n#define ADD(name) \\\n#if USE_Z \\\nat.z += name.x; \\\n#else \\\n"
        "at.xy += name; \\\n#endif\n#endif\n"
        "#define TAKE_BOTH TAKE(a_one) TAKE(a_two)\nTAKE_BOTH\n"
        "void main() { vec4 at = vec4(0.0); ADD(\n a_one)\n ADD(a_two)\n gl_Position = at; }\n",
        "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(1.0); }\n");
    EXPECT_THAT(inputsOf(bench, {}), ElementsAre("a_one vec2", "a_two vec2"));
    EXPECT_THAT(inputsOf(bench, {{"USE_Z", "1"}}), ElementsAre("a_one vec2", "a_two vec2"));
    EXPECT_THAT(inputsOf(bench, {{"USE_WIDE", "1"}}), ElementsAre("a_one vec4", "a_two vec4"));
    EXPECT_THAT(inputsOf(bench, {{"USE_NONE", "1"}}), ElementsAre());
}

/// A macro A(name) … that declares a vec4 where USE_A is defined, else a vec2.
std::string chosenDeclaration(char letter) {
    const std::string name(1, letter);
    return "#if USE_" + name + "\n#define " + name + "(x) in vec4 x;\n#else\n#define " + name +
           "(x) in vec2 x;\n#endif\n";
}

TEST(CocosMacro, OneLineMayCallSeveralChosenMacros) {
    CocosBench bench;
    std::string definitions;
    for (const char letter : {'A', 'B', 'C'}) definitions += chosenDeclaration(letter);
    bench.effect(
        definitions + "A(a_a) B(\n  a_b) C(a_c)\nvoid main() { gl_Position = a_a.xyxy + a_b.xyxy + a_c.xyxy; }\n",
        "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(1.0); }\n");
    EXPECT_THAT(inputsOf(bench, {}), ElementsAre("a_a vec2", "a_b vec2", "a_c vec2"));
    EXPECT_THAT(inputsOf(bench, {{"USE_B", "1"}}), ElementsAre("a_a vec2", "a_b vec4", "a_c vec2"));
    EXPECT_THAT(inputsOf(bench, {{"USE_A", "1"}, {"USE_C", "1"}}), ElementsAre("a_a vec4", "a_b vec2", "a_c vec4"));
}

TEST(CocosMacro, AnyNumberOfChosenMacrosInOneLine) {
    CocosBench bench;
    std::string definitions, calls;
    for (char letter = 'A'; letter <= 'P'; ++letter) {
        definitions += chosenDeclaration(letter);
        calls += std::string(1, letter) + "(a_" + std::string(1, letter) + ") ";
    }
    const std::string fragment = "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(1.0); }\n";
    const std::string main = "void main() { gl_Position = a_A.xyxy + a_P.xyxy; }\n";
    for (const std::string& line : {calls + "\n", "#define ALL " + calls + "\nALL\n"}) {
        bench.effect(definitions + line + main, fragment);
        const auto inputs = inputsOf(bench, {{"USE_P", "1"}});
        EXPECT_THAT(inputs, Contains("a_A vec2"));
        EXPECT_THAT(inputs, Contains("a_P vec4"));
        Problems problems;
        EXPECT_LT(bench.flatten(problems).front().flat.lines.size(),
                  16u * 14u + 10u);  // Each is written twice, not 2^16 times.
    }
}

TEST(CocosMacro, ChoicesWithinEachOtherAreBounded) {
    CocosBench bench;
    std::string definitions = "#define Z(x) in vec4 x;\n";
    for (char letter = 'Y'; letter >= 'A'; --letter) {
        const std::string name(1, letter), next(1, static_cast<char>(letter + 1));
        definitions += "#if USE_" + name + "\n#define " + name + "(x) " + next + "(x)\n#else\n#define " + name +
                       "(x) " + next + "(x##y)\n#endif\n";
    }
    bench.fragment(definitions + "A(x)\n");  // 2^25 ways
    EXPECT_EQ(bench.problem().message, "macro 'A' stands for too many alternatives to write them all out");
}

TEST(CocosMacro, DefinitionsOfBothKindsMayBeChosen) {
    CocosBench bench;
    bench.effect(
        "#if USE_A\n#define TYPE(x) in vec4 x;\n#else\n#define TYPE in vec2\n#endif\nTYPE (a_at);\n"
        "#if USE_B\n#define SET(to) \\\n#if 1 \\\n  to = a_at.xyxy; \\\n#endif\n#else\n#define SET(to) "
        "in_place(to)\n#endif\n"
        "void in_place(out vec4 at) { at = a_at.yxyx; }\n"
        "void main() { SET(gl_Position); }\n",
        "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(1.0); }\n");
    Problems problems;
    const auto stages = bench.flatten(problems);
    ASSERT_FALSE(problems.hasErrors());
    const auto lines = words(stages[0].flat.text);
    EXPECT_THAT(lines, Contains("in vec2 (a_at);"));  // Without parameters the brackets stay.
    EXPECT_THAT(lines, Contains("in vec4 a_at;"));
    EXPECT_THAT(lines, Contains("gl_Position = a_at.xyxy;"));
    EXPECT_THAT(lines, Contains("in_place(gl_Position);"));  // The semicolon is this definition's alone.
}

TEST(CocosMacro, EachCopyOfACallHasItsIncludes) {
    CocosBench bench;
    bench.chunk("kind", "in vec2 a_uv;\n");
    bench.effect(
        "#if USE_A\n#define TAKE() \\\n#include <kind> \\\nin vec4 a_more;\n#else\n#define TAKE() \\\n"
        "#include <kind> \\\nin vec2 a_more;\n#endif\nTAKE()\n#include <kind>\n"
        "void main() { gl_Position = a_uv.xyxy + a_more.xyxy; }\n",
        "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(1.0); }\n");
    EXPECT_THAT(inputsOf(bench, {}), UnorderedElementsAre("a_uv vec2", "a_more vec2"));
    EXPECT_THAT(inputsOf(bench, {{"USE_A", "1"}}), UnorderedElementsAre("a_uv vec2", "a_more vec4"));
}

// Bounded by what is read, not by time: each line would look through all that follow.
TEST(CocosMacro, ManyOpenCallsAreNotEachLookedThrough) {
    CocosBench bench;
    const std::string two = chosenDeclaration('A');
    std::string plain, open, broken;
    for (int i = 0; i < 100'000; ++i) {
        plain += "PLAIN (\n";
        open += "A(\n";
        broken += "PLAIN(\n#if 1\n#endif\n";
    }
    const std::string object = "#define PLAIN \\\n#if 1 \\\nfloat f \\\n#endif\n";
    bench.fragment(object + plain);
    EXPECT_THAT(bench.problem().message, HasSubstr("write more than it can hold"));
    bench.fragment(two + object + plain);
    EXPECT_THAT(bench.problem().message, HasSubstr("write more than it can hold"));
    bench.fragment(two + object + broken);
    EXPECT_THAT(bench.problem().message, HasSubstr("write more than it can hold"));
    bench.fragment(two + open);
    EXPECT_EQ(bench.problem().message, "the call of macro 'A' is not closed within 64 KB");
    Problems problems;
    bench.flatten(problems);
    EXPECT_EQ(problems.all().size(), 1u);
}

TEST(CocosMacro, PragmaAndTextMayDefineANameInTurns) {
    CocosBench bench;
    bench.fragment(
        "layout(location = 0) out vec4 color;\n#if USE_X\n#pragma define POSITION vec4(1.0)\n#else\n"
        "#define POSITION vec4(0.0)\n#endif\nvoid main() { color = POSITION; }\n");
    bench.compile({{"USE_X", "0"}});
    bench.compile({{"USE_X", "1"}});
}

TEST(CocosMacro, BodiesWithPreprocessorLinesAreWrittenOut) {
    CocosBench bench;
    bench.chunk("more", "float more() { return 1.0; }\n");
    bench.chunk(
        "entry",
        "#define ENTRY() \\\n#if USE_MORE \\\n  #include <more> \\\n  void main() { color = vec4(more()); } \\\n"
        "#elif USE_LESS // a comment \\\n  void main() { color = vec4(0.5); } \\\n#else \\\n"
        "  void main() { color = vec4(0.0); } \\\n#endif \\\n#pragma // swallows what follows the call\n");
    bench.fragment("#include <entry>\nlayout(location = 0) out vec4 color;\nENTRY();\n");
    const StageText text = bench.fragmentText();
    EXPECT_THAT(
        words(text.flat.text),
        ElementsAre("#define ENTRY ENTRY", "layout(location = 0) out vec4 color;", "#if USE_MORE",
                    "float more() { return 1.0; }", "void main() { color = vec4(more()); }", "#elif USE_LESS",
                    "void main() { color = vec4(0.5); }", "#else", "void main() { color = vec4(0.0); }", "#endif"));
    EXPECT_EQ(originOf(text, "void main() { color = vec4(0.5)"), "entry.chunk:6");
    EXPECT_EQ(originOf(text, "float more()"), "more.chunk:1");
    EXPECT_THAT(macroNames(text), ElementsAre("USE_MORE", "USE_LESS"));
    for (const char* define : {"USE_MORE", "USE_LESS", "USE_NONE"}) bench.compile({{define, "1"}});
}

TEST(CocosMacro, ArgumentsNestBracketsAndSpanLines) {
    CocosBench bench;
    bench.fragment(
        "#define PUT(to, what) \\\n#if 1 \\\nto = what; \\\n#endif\nvoid f() {\n  vec4 v;\n  PUT(v,\n"
        "      mix(vec4(0.0, 1.0, 2.0, (3.0)),\n          vec4(1.0), vec4(0.5)))\n}\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text),
                Contains("v = mix(vec4(0.0, 1.0, 2.0, (3.0)),           vec4(1.0), vec4(0.5));"));
    bench.fragment("#define PUT(to) \\\n#if 1 \\\nto; \\\n#endif\nfloat PUTTER; // PUT is only part of the word\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), Contains("float PUTTER;"));
}

TEST(CocosMacro, AnEmptyFunctionLikeDefineTakesTheNextLine) {
    CocosBench bench;
    bench.fragment(
        "layout(location = 0) out vec4 color;\n#define unpackIt(c)\n  dot(c, vec4(1.0, 0.5, 0.25, 0.125))\n"
        "#define nothing(c)\n#define NOTHING\n\nvoid main() { nothing(1) color = vec4(unpackIt(vec4(1.0))); }\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), Contains("#define unpackIt(c) \\"));
    bench.compile();
}

TEST(CocosMacro, QualifiersInFrontOfVaryingsAreExpanded) {
    CocosBench bench;
    bench.chunk("varyings",
                "VARYING highp vec3 v_a;\n#if USE_COLOR\n  VARYING lowp vec4 v_color;\n#endif\n#define COUNT 2\n");
    bench.effect(
        "#define VARYING out\n#include <varyings>\nvoid main() { v_a = vec3(COUNT); gl_Position = vec4(0.0); }\n",
        "#define VARYING in\n#include <varyings>\nlayout(location = 0) out vec4 color;\n"
        "void main() { color = vec4(v_a, 1.0); }\n");
    const StageText text = bench.fragmentText();
    EXPECT_THAT(words(text.flat.text), Contains("in highp vec3 v_a;"));
    EXPECT_THAT(words(text.flat.text), Contains("#define COUNT 2"));
    EXPECT_EQ(originOf(text, "in highp vec3 v_a;"), "varyings.chunk:1");
    bench.compile();
}

TEST(CocosMacro, ParametersOfFunctionsAreNoDeclarations) {
    CocosBench bench;
    bench.fragment("#define FN(n) float n(in float x, out float y)\nFN(f) { y = x; return x; }\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), Contains("FN(f) { y = x; return x; }"));
}

TEST(CocosMacro, MistakesInAMacroPointIntoItAndToTheCall) {
    CocosBench bench;
    bench.chunk("entry", "#define ENTRY() \\\n#if 1 \\\n void main() { colour = vec4(1.0); } \\\n#endif\n");
    bench.fragment("#include <entry>\nlayout(location = 0) out vec4 color;\n\nENTRY();\n");
    const std::string error = bench.compileError();
    EXPECT_THAT(error, HasSubstr("entry.chunk:3:"));
    EXPECT_THAT(error, HasSubstr("'colour'"));
    EXPECT_THAT(error, HasSubstr("t.effect:14"));  // The call.
}

TEST(CocosMacro, WrongCallsAreErrorsOfTheAuthorsLine) {
    CocosBench bench;
    bench.fragment("#define PUT(a, b) \\\n#if 1 \\\na = b; \\\n#endif\n\nvoid f() { PUT(x) }\n");
    Problem problem = bench.problem();
    EXPECT_EQ(problem.message, "macro 'PUT' takes 2 arguments, 1 are given");
    EXPECT_EQ(problem.where.line, 16);
    bench.fragment("#define PUT(a, b) \\\n#if 1 \\\na = b; \\\n#endif\n\nvoid f() { PUT(x, (y }\n");
    problem = bench.problem();
    EXPECT_EQ(problem.message, "the call of macro 'PUT' is not closed");
    EXPECT_EQ(problem.where.line, 16);
}

TEST(CocosMacro, ConditionsMustCloseOverIncludes) {
    CocosBench bench;
    bench.chunk("open", "\n#if USE_A\nfloat a;\n");
    bench.fragment("#include <open>\nfloat b;\n");
    Problem problem = bench.problem();
    EXPECT_EQ(problem.message, "this condition has no '#endif'");
    EXPECT_EQ(problem.where.line, 2);
    EXPECT_THAT(problem.where.file, HasSubstr("open.chunk"));
    bench.fragment("#include <open>\n#endif\nfloat b;\n");
    EXPECT_EQ(bench.problem().message, "");  // Closed by another file: odd, and allowed.
    bench.fragment("float b;\n  #endif\n");
    problem = bench.problem();
    EXPECT_EQ(problem.message, "this line belongs to no '#if'");
    EXPECT_EQ(problem.where.line, 12);
    EXPECT_EQ(problem.where.column, 3);
}

// What hostile files do.
TEST(CocosMacro, BombsOfWrittenOutMacrosEnd) {
    CocosBench bench;
    std::string text = "#define M0() \\\n#if 1 \\\nfloat a; \\\n#endif\n";
    for (int i = 1; i < 40; ++i) {
        const std::string inner = "M" + std::to_string(i - 1) + "()";
        text += "#define M" + std::to_string(i) + "() " + inner + " " + inner + "\n";
    }
    bench.fragment(text + "M39()\n");
    EXPECT_THAT(bench.problem().message, HasSubstr("expands without end"));
    bench.fragment("#define A() \\\n#if 1 \\\nB() \\\n#endif\n#define B() A() A()\nA()\n");
    EXPECT_EQ(bench.problem().message, "");  // A macro is not expanded within itself.
    std::string doubled = "#define D(x) \\\n#if 1 \\\nx x x x x x x x \\\n#endif\nD(";
    for (int i = 0; i < 60'000; ++i) doubled += "a";
    bench.fragment(doubled + ")\n");
    EXPECT_EQ(bench.problem().message, "");
}

TEST(CocosMacro, BombsForTheCompilersPreprocessorEnd) {
    CocosBench bench;
    std::string objects = "#define M0 1.0 + 1.0\n";
    std::string calls = "#define F(x) (x) * (x)\n";
    for (int i = 1; i < 64; ++i) {
        const std::string inner = "M" + std::to_string(i - 1);
        objects += "#define M" + std::to_string(i) + " " + inner + " + " + inner + "\n";
    }
    bench.fragment(objects + "\nfloat f() { return M63; }\n");
    Problem problem = bench.problem();
    EXPECT_EQ(problem.message, "macro 'M63' stands for more than 2000000 words here");
    EXPECT_EQ(problem.where.line, 76);
    std::string nested = "1.0";
    for (int i = 0; i < 40; ++i) nested = "F(" + nested + ")";
    bench.fragment(calls + "float f() { return " + nested + "; }\n");
    EXPECT_EQ(bench.problem().message, "macro 'F' stands for more than 2000000 words here");
    bench.fragment(calls + "#define G F\n#define H(x) G(G(G(G(G(x)))))\n#if H(H(H(H(H(H(1))))))\n#endif\n");
    EXPECT_THAT(bench.problem().message, HasSubstr("stands for more than 2000000 words here"));
    bench.fragment("#define R R + R\n#define S(x) S(x) + S(x)\nfloat f() { return R + S(R); }\n");
    EXPECT_EQ(bench.problem().message, "");  // Recursion is none.
}

TEST(CocosMacro, StatementsThatWouldExhaustTheCompilersStackEnd) {
    CocosBench bench;
    std::string sum = "float f(float a) { return a";
    for (int i = 0; i < 30'000; ++i) sum += " + a";
    bench.fragment(sum + "; }\n");
    EXPECT_EQ(bench.problem().message, "this statement is longer than the compiler can take");
    EXPECT_EQ(bench.problem().where.line, 11);
    std::string macros = "#define A0 x + x\n";
    for (int i = 1; i < 14; ++i) {
        const std::string inner = "A" + std::to_string(i - 1);
        macros += "#define A" + std::to_string(i) + " " + inner + " + " + inner + "\n";
    }
    bench.fragment(macros + "float f(float x) { return A13; }\n");
    EXPECT_EQ(bench.problem().message, "this statement is longer than the compiler can take");
    std::string table = "const float table[3000] = float[](0.0";
    for (int i = 1; i < 3000; ++i) table += ", 0.5";
    bench.fragment(table + ");\n");
    EXPECT_EQ(bench.problem().message, "");
}

TEST(CocosMacro, DeepNestingEnds) {
    CocosBench bench;
    std::string nested = "1.0";
    for (int i = 0; i < 5000; ++i) nested = "F(" + nested + ")";
    bench.fragment("#define F(x) (x) * (x)\nfloat f() { return " + nested + "; }\n");
    EXPECT_THAT(bench.problem().message, HasSubstr("stands for more than"));
    bench.fragment("#if " + std::string(100'000, '(') + "1" + std::string(100'000, ')') + "\nfloat a;\n#endif\n");
    EXPECT_THAT(bench.problem().message, HasSubstr("nest"));
}

}  // namespace
}  // namespace crevice::cocos
