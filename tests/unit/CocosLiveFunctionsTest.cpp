// Functions that an entry does not reach: their macros are not the shader's, their text is not compiled.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"
#include "cocos/analysis/LiveFunctions.h"

namespace crevice::cocos {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> dead(std::string_view text, const MacroBodies& macros = {}, std::string_view entry = "main") {
    std::vector<std::string> names;
    for (const FunctionRange& function : findDeadFunctions(text, entry, macros)) names.emplace_back(function.name);
    return names;
}

TEST(CocosLiveFunctions, ReachedByCallsOverSeveralSteps) {
    EXPECT_THAT(dead("float a() { return 1.0; }\nfloat b() { return a(); }\nfloat c(float x) { return b() + x; }\n"
                     "float d() { return c(1.0); }\nvoid main() { b(); }\n"),
                ElementsAre("c", "d"));
}

TEST(CocosLiveFunctions, OverloadsLiveTogether) {
    EXPECT_THAT(dead("float f(float x) { return x; }\nvec2 f(vec2 x) { return x; }\nvoid main() { f(1.0); }\n"
                     "float g() { return f(2.0); }\n"),
                ElementsAre("g"));
}

TEST(CocosLiveFunctions, ACallInAnyBranchCounts) {
    EXPECT_THAT(dead("float a() { return 1.0; }\nfloat b() { return 2.0; }\n#if A\nfloat c() { return 3.0; }\n#endif\n"
                     "void main() {\n#if A\n  a();\n#elif B\n  b();\n#endif\n}\n"),
                ElementsAre("c"));
}

TEST(CocosLiveFunctions, MacrosLeadOn) {
    const std::string text =
        "#define READ(x) unpack(x)\n#define OLD(x) forgotten(x)\nfloat unpack(float x) { return x; }\n"
        "float forgotten(float x) { return x; }\nvoid main() { READ(1.0); }\n";
    EXPECT_THAT(dead(text, {{"READ", {"unpack(x)"}}, {"OLD", {"forgotten(x)"}}}), ElementsAre("forgotten"));
    EXPECT_THAT(dead(text, {{"READ", {"un##x(x)"}}}), IsEmpty());  // Any name may be meant.
}

TEST(CocosLiveFunctions, InitialValuesCallAndPrototypesDoNot) {
    EXPECT_THAT(dead("float used();\nfloat unused();\nfloat used() { return 1.0; }\nfloat unused() { return 1.0; }\n"
                     "float global = used();\nvoid main() {}\n"),
                ElementsAre("unused"));
}

TEST(CocosLiveFunctions, TypesAndListsOverSeveralLines) {
    const std::string text =
        "layout(location = 0) out vec4 color;\nstruct S { vec4 a; };\nuniform Block { vec4 v; };\n"
        "highp vec4 fetch(\n  sampler2D map\n#if A\n  , vec2 uv\n#endif\n)\n{\n  return v;\n}\nvoid main() {}\n";
    const auto found = findDeadFunctions(text, "main", {});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].name, "fetch");
    EXPECT_EQ(text.substr(found[0].begin, 10), "highp vec4");
    EXPECT_EQ(text[found[0].end - 1], '}');
    EXPECT_EQ(found[0].firstLine, 3u);
    EXPECT_EQ(found[0].lastLine, 11u);
}

TEST(CocosLiveFunctions, WhatCannotBeToldStays) {
    EXPECT_THAT(dead("float a() { return 1.0; }\nfloat b() { return 1.0; }\n"), IsEmpty());  // no main
    EXPECT_THAT(dead("#if A\nfloat a() {\n#else\nfloat b() {\n#endif\n return 1.0; }\nvoid main() {}\n"), IsEmpty());
    EXPECT_THAT(dead("float a() {\n#if A\n return 1.0; }\n#else\n return 2.0; }\n#endif\nvoid main() {}\n"), IsEmpty());
    EXPECT_THAT(dead("float a()\n#if A\n#endif\n{ return 1.0; }\nvoid main() {}\n"), IsEmpty());
    EXPECT_THAT(dead("float a() {\n#define KEPT 1\nreturn 1.0; }\nvoid main() { int i = KEPT; }\n"), IsEmpty());
    EXPECT_THAT(dead("float a( { return 1.0; }\nvoid main() {}\n"), IsEmpty());
}

TEST(CocosLiveFunctions, ConditionsThatCrossKeepTheirFunctionAlone) {
    const std::string gone = "float gone() { return 1.0; }\n";
    const std::string main = "float after() { return 1.0; }\nvoid main() {}\n";
    for (const char* const body : {"float a(float x) {\n#if A\n if (x > 0.0) {\n#endif\n x = 1.0;\n#if A\n }\n#endif\n "
                                   "return x; }\n",
                                   "float a() {\n#if A\n return 1.0; }\n#else\n return 2.0; }\n#endif\n",
                                   "float a() {\n#if A\n return 1.0; }\n#elif B\n return 2.0; }\n#else\n }\n#endif\n",
                                   "#if A\nfloat a(float x) {\n#else\nfloat a(vec2 x) {\n#endif\n return 1.0; }\n",
                                   "#if A\nfloat a()\n#else\nvec2 a()\n#endif\n{ return 1.0; }\n",
                                   "float a(vec2 x\n#if A\n , float y)\n#else\n )\n#endif\n{\n#if A\n if (y > 0.0) {\n"
                                   "#else\n {\n#endif\n } return 1.0; }\n"})
        EXPECT_THAT(dead(gone + body + main), ElementsAre("gone", "after")) << body;
}

TEST(CocosLiveFunctions, NamesBehindABodyThatABranchEnds) {
    // The head is not understood, so its body is none: `return helper(x);` in its second branch is no prototype.
    const std::string text =
        "float helper(float x) { return x; }\nfloat gone() { return 1.0; }\n#if A\nfloat f(float x)\n#else\n"
        "highp float f(float x)\n#endif\n{\n#if B\n return 1.0; }\n#else\n return helper(x); }\n#endif\n"
        "uniform vec4 u;\nvoid main() {}\n";
    EXPECT_THAT(dead(text), ElementsAre("gone"));
}

TEST(CocosLiveFunctions, SemicolonsThatEndNothingAreLeftOut) {
    CocosBench bench;
    bench.fragment(
        "float twice(float x) { if (x > 1.0) { return x; }; return x * 2.0; };\nstruct S { float a; };;\n"
        "uniform Block { vec4 c; };\nconst float k[2] = float[2](1.0, 2.0); ;\n"
        "#define BOTH(n) uniform sampler2D n; vec4 read_##n(vec2 uv) { return texture(n, uv); }\nBOTH(map);\n"
        "layout(location = 0) out vec4 color;\nvoid main() { color = c * twice(k[0]) * read_map(vec2(0.0)); };\n");
    const auto lines = words(bench.fragmentText().flat.text);
    EXPECT_THAT(lines, Contains("float twice(float x) { if (x > 1.0) { return x; }; return x * 2.0; }"));
    EXPECT_THAT(lines, Contains("struct S { float a; };"));
    EXPECT_THAT(lines, Contains("uniform Block { vec4 c; };"));
    EXPECT_THAT(lines, Contains("const float k[2] = float[2](1.0, 2.0);"));
    EXPECT_THAT(lines, Contains("void main() { color = c * twice(k[0]) * read_map(vec2(0.0)); }"));
    bench.compile();
}

TEST(CocosLiveFunctions, ConstructorsInCapitalsAreNoMacros) {
    const std::string text = "struct PBR { vec4 c; };\nfloat gone() { return 1.0; }\nvoid main() { PBR(vec4(1.0)); }\n";
    EXPECT_THAT(dead(text), ElementsAre("gone"));
    EXPECT_THAT(dead("#define struct_PBR\n" + text.substr(text.find("float"))), IsEmpty());
}

TEST(CocosLiveFunctions, WhatTheStageCannotHoldGoesWhenNobodyNamesIt) {
    CocosBench bench;
    bench.effect(
        "void clip(float v) { if (v < 0.0) discard; }\nfloat slope(float v) { return dFdx(v); }\n"
        "float stays() { return 1.0; }\n"
        "void main() {\n  gl_Position = vec4(1.0);\n#ifdef USE_A\n  gl_Position *= float(USE_A);\n#endif\n}\n",
        "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(1.0); }\n");
    Problems problems;
    const auto stages = bench.flatten(problems);
    ASSERT_EQ(stages.size(), 2u);
    EXPECT_THAT(stages[0].flat.text, Not(HasSubstr("clip")));
    EXPECT_THAT(stages[0].flat.text, HasSubstr("stays"));  // USE_A may be any word.
    bench.compile();
    bench.compile({{"USE_A", "1"}});
    bench.effect("void clip(float v) { if (v < 0.0) discard; }\nvoid main() { clip(1.0); gl_Position = vec4(1.0); }\n",
                 "void main() {}\n");
    EXPECT_THAT(bench.compileError(), HasSubstr("'discard'"));
}

const std::string kHelper = "float helper(float x) { return x; }\n";

TEST(CocosLiveFunctions, NamesInBodiesThatAreNotUnderstoodAreAlive) {
    const std::string more = "float gone() { return 1.0; }\nvoid main() { foo(1.0); }\n";
    for (const char* const body : {"float[2] foo(float x) { return float[2](helper(x), x); }\n",
                                   "#define DECLARE(n) float n(float x)\nDECLARE(foo) { return helper(x); }\n",
                                   "#define HEAD float foo(float x)\nHEAD\n{\n  return helper(x);\n}\n",
                                   "#define foo bar\nfloat foo(float x) { return helper(x); }\n",
                                   "#define TYPE float one; float\nTYPE foo(float x) { return helper(x); }\n",
                                   "#define THEN helper(1.0)\nfloat foo(float x) { return THEN; }\n"})
        EXPECT_THAT(dead(kHelper + body + more), ElementsAre("gone")) << body;
}

TEST(CocosLiveFunctions, DefinesOfTheTextLeadOn) {
    const std::string main = "float gone() { return 1.0; }\nvoid main() { CALL(1.0); }\n";
    EXPECT_THAT(dead("#define CALL(a) helper(a)\n" + kHelper + main), ElementsAre("gone"));
    EXPECT_THAT(dead("#define CALL(a,\\\n  b) helper(a, b)\n" + kHelper + main), ElementsAre("gone"));
    EXPECT_THAT(dead("#  define CALL \\\n  helper\n" + kHelper + main), ElementsAre("gone"));
    EXPECT_THAT(dead("#define CALL(a) hel##a(a)\n" + kHelper + main), IsEmpty());
}

TEST(CocosLiveFunctions, NamesFromOutsideMayBeAny) {
    const std::string text = kHelper + "float gone() { return 1.0; }\nvoid main() { TONE(1.0); }\n";
    EXPECT_THAT(dead(text), IsEmpty());  // Nobody here says what TONE is.
    EXPECT_THAT(dead(text, {{"TONE", {"helper"}}}), ElementsAre("gone"));
    const MacroBodies none;
    EXPECT_THAT(findDeadFunctions("float a() { return 1.0; }\nvoid main() { float b = float(mode); }\n", "main", none,
                                  {{"mode"}, {}}),
                IsEmpty());
}

// Cocos gives a macro whose value a condition takes a 1, a 0 or a number, and none of its words (formats, 1.6).
TEST(CocosLiveFunctions, WhatAConditionTakesTheValueOfIsANumber) {
    const auto text = [](const std::string& condition) {
        CocosBench bench;
        bench.fragment(condition +
                       "\n#endif\nfloat gone() {\n#if USE_GONE\n  return missing;\n#endif\n  return 1.0; }\n" +
                       "layout(location = 0) out vec4 color;\nvoid main() {\n#ifdef USE_A\n" +
                       "  color = vec4(USE_A > 0 ? 1.0 : 0.0);\n#endif\n}\n");
        return bench.fragmentText();
    };
    for (const std::string condition : {"#if USE_A", "#if !(USE_A)", "#if 0\n#elif USE_A && defined(USE_A)"}) {
        EXPECT_THAT(text(condition).flat.text, Not(HasSubstr("gone"))) << condition;
        EXPECT_THAT(macroNames(text(condition)), ElementsAre("USE_A")) << condition;
    }
    // One that is only asked for may be any word, of the function too.
    for (const std::string condition : {"#ifdef USE_A", "#ifndef USE_A", "#if defined(USE_A)", "#if !defined USE_A"})
        EXPECT_THAT(text(condition).flat.text, HasSubstr("gone")) << condition;
}

TEST(CocosLiveFunctions, MacrosOfManyWordsAreReadOnce) {
    const auto define = [](const std::string& name, const std::string& word) {
        std::string line = "#define " + name;
        for (int i = 0; i < 5000; ++i) line += " " + word;
        return line + "\n";
    };
    std::string types;
    for (const char* line : {"#define T U\n", "#define U V\n", "#define V float\n"})
        for (int i = 0; i < 5000; ++i) types += line;
    const std::string text = types + define("A", "B") + define("B", "C") + define("C", "highp") + define("X", "Y") +
                             define("Y", "Z") + define("Z", "highp uniform") +
                             "A float a() { return 1.0; }\nT b() { return 1.0; }\nX float c() { return 1.0; }\n"
                             "void main() {}\n";
    EXPECT_THAT(dead(text), ElementsAre("a", "b"));  // 'X' leads to a word that no function begins with
}

TEST(CocosLiveFunctions, MacrosMayStandForTypesOverFourSteps) {
    // A is met as the fourth step first, where its own are too many, and then as the first one.
    EXPECT_THAT(dead("#define D C\n#define C B\n#define B A\n#define A T\n#define T float\n"
                     "D a() { return 1.0; }\nA b() { return 1.0; }\nC c() { return 1.0; }\nvoid main() {}\n"),
                ElementsAre("b", "c"));
}

TEST(CocosLiveFunctions, BothTheEntryAndMainAreFollowed) {
    EXPECT_THAT(dead(kHelper + "float gone() { return 1.0; }\n#if 0\nvoid main() { helper(1.0); }\n#endif\n"
                               "vec4 frag() { return vec4(1.0); }\n",
                     {}, "frag"),
                ElementsAre("gone"));
}

TEST(CocosLiveFunctions, WhatStandsInFrontOfTheTypeGoesToo) {
    const auto start = [](const std::string& text) {
        const auto found = findDeadFunctions(text, "main", {});
        return found.empty() ? std::string() : text.substr(found[0].begin, 12);
    };
    const std::string gone = "vec4 gone() { return vec4(1.0); }\nvoid main() {}\n";
    EXPECT_EQ(start("uniform vec4 u;\nprecise " + gone), "precise vec4");
    EXPECT_EQ(start("#define PREC highp\nPREC " + gone), "PREC vec4 go");
    EXPECT_EQ(start("#define PREC uniform int i; highp\nPREC " + gone), "");
    EXPECT_EQ(start("#define CALL(x) int x;\nCALL(i) " + gone), "");
    EXPECT_EQ(start("#if A\nhighp\n#endif\n" + gone), "");
    EXPECT_EQ(start("#if A\nhighp\n#else\nvec4 v;\n#endif\n" + gone), "");
}

TEST(CocosLiveFunctions, BlocksAreNoFunctions) {
    EXPECT_THAT(dead("#define NAME(x) Block\nuniform NAME(x) { vec4 v; };\nvoid main() { v; }\n"), IsEmpty());
    EXPECT_THAT(dead("uniform Block(x) { vec4 v; };\nvoid main() { v; }\n"), IsEmpty());
    EXPECT_THAT(dead("#define OPEN {\nfloat a() OPEN return 1.0; }\nfloat b() { return 1.0; }\nvoid main() {}\n"),
                IsEmpty());
}

TEST(CocosLiveFunctions, PragmasWithinThem) {
    CocosBench bench;
    const std::string main = "vec4 tone(float x) { return vec4(x); }\nlayout(location = 0) out vec4 color;\n";
    bench.fragment(
        "float unused() {\n#if USE_A\n#pragma define VALUE 1.0\n  return 1.0;\n#else\n"
        "#pragma define VALUE 2.0\n  return 2.0;\n#endif\n}\n" +
        main + "void main() { color = vec4(VALUE); }\n");
    EXPECT_THAT(bench.fragmentText().flat.text, HasSubstr("unused"));
    bench.compile();
    bench.compile({{"USE_A", "1"}});
    bench.fragment("float unused() {\n#pragma define-meta PICK options([one, two])\n  return 1.0; }\n" + main +
                   "void main() { float one = 1.0, two = 2.0; color = vec4(PICK); }\n");
    EXPECT_THAT(macroNames(bench.fragmentText()), ElementsAre("PICK"));
    bench.compile({{"PICK", "two"}});
}

TEST(CocosLiveFunctions, OptionsNameThem) {
    CocosBench bench;
    bench.fragment(
        "#pragma define-meta TONE options([toneA, toneB])\nvec4 toneA(vec4 c) { return c; }\n"
        "vec4 toneB(vec4 c) { return c * 0.5; }\nfloat gone() { return missing; }\n"
        "layout(location = 0) out vec4 color;\nvoid main() { color = TONE(vec4(1.0)); }\n");
    EXPECT_THAT(bench.fragmentText().flat.text, Not(HasSubstr("gone")));
    bench.compile({{"TONE", "toneA"}});
    bench.compile({{"TONE", "toneB"}});
    bench.fragment(
        "vec4 toneA(vec4 c) { return c; }\nlayout(location = 0) out vec4 color;\n"
        "void main() {\n#ifdef tone\n  color = tone(vec4(1.0));\n#endif\n}\n");
    EXPECT_THAT(bench.fragmentText().flat.text, HasSubstr("toneA"));
    bench.compile({{"tone", "toneA"}});
}

TEST(CocosLiveFunctions, OptionsOfTheOtherStageNameThem) {
    CocosBench bench;
    const auto write = [&](const std::string& name, const std::string& call) {
        bench.effect("#pragma define-meta " + name + " options([fa, fb])\nvoid main() { gl_Position = vec4(0.0); }\n",
                     "#define APPLY(f) f(1.0)\nfloat fa(float x) { return x; }\n"
                     "float fb(float x) { return x + 1.0; }\nfloat gone() { return missing; }\n"
                     "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(" +
                         call + "); }\n");
    };
    const auto expect = [&](const std::string& name) {
        EXPECT_THAT(bench.fragmentText().flat.text, Not(HasSubstr("gone")));
        EXPECT_EQ(bench.compileError({{name, "fa"}}), "");
        EXPECT_EQ(bench.compileError({{name, "fb"}}), "");
    };
    write("FUNC", "APPLY(FUNC)");
    expect("FUNC");
    write("FUNC", "FUNC(1.0)");
    expect("FUNC");
    write("func", "func(1.0)");
    expect("func");
    write("FUNC", "1.0");  // named nowhere: its options are not alive
    EXPECT_THAT(bench.fragmentText().flat.text, Not(HasSubstr("fa")));
}

TEST(CocosLiveFunctions, TheirMacrosAreNotTheShaders) {
    CocosBench bench;
    bench.fragment(
        "#if USE_AROUND\nfloat away() {\n#if USE_WITHIN\n#pragma define-meta USE_TOLD\n  return missing;\n#endif\n"
        "  return gone; }\n#endif\nfloat near() {\n#if USE_NEAR\n  return 1.0;\n#endif\n  return 2.0; }\n"
        "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(near()); }\n");
    const StageText text = bench.fragmentText();
    EXPECT_THAT(macroNames(text), ElementsAre("USE_AROUND", "USE_NEAR"));
    EXPECT_THAT(text.flat.text, Not(HasSubstr("away")));
    const auto lines = static_cast<std::size_t>(std::count(text.flat.text.begin(), text.flat.text.end(), '\n'));
    EXPECT_EQ(lines, text.flat.lines.size());
    bench.compile({{"USE_AROUND", "1"}});  // although `gone` is declared nowhere
    bench.compile({{"USE_NEAR", "1"}});
}

TEST(CocosLiveFunctions, WhatIsNeverCompiledTurnsNothingOff) {
    CocosBench bench;
    const std::string main = "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(1.0); }\n";
    for (const char* never : {"#if 0\nfloat broken( { {\n#endif\n", "#if 1\n#else\n} ) {\n#endif\n",
                              "#if 1\n#elif USE_X\n#if USE_Y\n}\n#endif\n#endif\n"}) {
        bench.fragment(never + std::string("float gone() { return missing; }\n") + main);
        EXPECT_THAT(bench.fragmentText().flat.text, testing::Not(testing::HasSubstr("gone"))) << never;
    }
    bench.fragment(
        "#if 0\n#else\nfloat kept() { return 1.0; }\n#endif\nlayout(location = 0) out vec4 color;\n"
        "void main() { color = vec4(kept()); }\n");
    bench.compile();
}

TEST(CocosLiveFunctions, SemicolonsBehindBodiesThatAMacroWritesOrThatHaveSeveralHeads) {
    CocosBench bench;
    const std::string main = "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(ONE); }\n";
    bench.fragment(
        "#define FN(n) float n(float x) { return x; }\n#define LONG(n) \\\n  float n(float x) { \\\n"
        "    return x; \\\n  }\nFN(one);\nLONG(two);\n#define ONE one(two(1.0))\n" +
        main);
    bench.compile();
    bench.fragment(
        "#define LIST(n) float n[2] = {1.0, 2.0}\n#define KIND(n) struct n { float x; }\nLIST(one);\nKIND(Two);\n"
        "#define ONE (one[0] + Two(1.0).x)\n" +
        main);
    bench.compile();  // Theirs end declarations.
    bench.fragment(
        "#if USE_A\nfloat one(float x)\n#else\nfloat one()\n#endif\n{ return 1.0; };\n#if USE_A\n"
        "#define ONE one(1.0)\n#else\n#define ONE one()\n#endif\n" +
        main);
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosLiveFunctions, AMacroInOneBranchIsAFunctionInTheOther) {
    CocosBench bench;
    const std::string macro = "#define ADD(a, b) \\\n  (a \\\n#if USE_B \\\n  + b \\\n#endif \\\n  )\n";
    const std::string function = "float ADD(float a, float b) { return a + b; }\n";
    const std::string main = "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(ADD(1.0, 2.0)); }\n";
    for (const std::string& text : {"#if USE_A\n" + macro + "#else\n" + function + "#endif\n",
                                    "#if USE_A\n" + function + "#else\n" + macro + "#endif\n",
                                    "#if USE_A\n" + macro + "#endif\n#if !USE_A\n" + function + "#endif\n",
                                    "#if USE_A\n" + macro + "#endif\n#ifndef ADD\n" + function + "#endif\n"}) {
        bench.fragment(text + main);
        for (const auto* a : {"0", "1"})
            for (const auto* b : {"0", "1"}) bench.compile({{"USE_A", a}, {"USE_B", b}});
    }
}

}  // namespace
}  // namespace crevice::cocos
