// Macros: found in conditions, described by pragmas, checked, and turned into #define lines.
#include <gtest/gtest.h>

#include "EffectTestTools.h"

namespace crevice {
namespace {

FlatSource flatOf(const std::string& text) {
    FlatSource flat;
    flat.text = text;
    flat.files = {"f.chunk"};
    for (int line = 1; line <= std::count(text.begin(), text.end(), '\n'); ++line) flat.lines.push_back({0, line});
    return flat;
}

std::vector<DefineInfo> find(const std::string& text) {
    const FlatSource flat = flatOf(text);
    Problems problems;
    auto infos = findDefines({&flat}, problems);
    EXPECT_FALSE(problems.hasErrors());
    return infos;
}

std::vector<std::string> namesOf(const std::vector<DefineInfo>& infos) {
    std::vector<std::string> names;
    for (const DefineInfo& info : infos) names.push_back(info.name);
    return names;
}

TEST(EffectDefines, FoundInOrderOfFirstAppearance) {
    EXPECT_EQ(namesOf(find("#if B && (A > 2 || defined(C)) \\\n && G\n#elif D\n#endif\n#ifdef E\n#endif\n#ifndef "
                           "F\n#endif\n#if A\n#endif\n")),
              (std::vector<std::string>{"B", "A", "C", "G", "D", "E", "F"}));
}

TEST(EffectDefines, OwnDefinesAndCompilerNamesAreNone) {
    EXPECT_TRUE(find("#if __VERSION__ > 300 && GL_ES\n#endif\n#define X 1\n#if X\n#endif\nint y; if (z) {}\n").empty());
}

TEST(EffectDefines, PlacesAreTheConditions) {
    const auto infos = find("\n  #if  USE_X\n#endif\n");
    ASSERT_EQ(infos.size(), 1u);
    EXPECT_EQ(infos[0].where.line, 2);
    EXPECT_EQ(infos[0].where.column, 8);
    EXPECT_EQ(infos[0].where.length, 5);
}

TEST(EffectDefines, MetaPragmas) {
    const auto infos = find(
        "#pragma define-meta N range([-2, 64]) default(16)\n#pragma define-meta R range([3, 5])\n#pragma define-meta O "
        "options([v_uv, "
        "v_uv1])\n#pragma define-meta B default(true)\n#pragma define-meta P\n#pragma define OLD range([1, 2])\n");
    ASSERT_EQ(infos.size(), 6u);
    EXPECT_EQ(infos[0].type, DefineType::Number);
    EXPECT_EQ(infos[0].range, std::pair(-2, 64));
    EXPECT_EQ(infos[0].defaultValue, "16");
    EXPECT_EQ(infos[1].defaultValue, "3");
    EXPECT_EQ(infos[2].type, DefineType::String);
    EXPECT_EQ(infos[2].options, (std::vector<std::string>{"v_uv", "v_uv1"}));
    EXPECT_EQ(infos[2].defaultValue, "v_uv");
    EXPECT_EQ(infos[3].defaultValue, "1");
    EXPECT_EQ(infos[4].type, DefineType::Bool);
    EXPECT_EQ(infos[4].defaultValue, "0");
    EXPECT_EQ(infos[5].range, std::pair(1, 2));
}

TEST(EffectDefines, LinesForTheCompiler) {
    const auto infos = find(
        "#pragma define-meta N range([1, 9]) default(4)\n#if A\n#endif\n#ifdef E\n#endif\n#ifndef K\n#define K "
        "3\n#endif\n");
    EXPECT_EQ(defineLines(infos, {}), "#define N 4\n#define A 0\n");
    EXPECT_EQ(defineLines(infos, {{"N", "9"}, {"A", "1"}, {"E", "1"}, {"K", "5"}}),
              "#define N 9\n#define A 1\n#define E 1\n#define K 5\n");
}

TEST(EffectDefines, MetaLinesAreEmptied) {
    EXPECT_EQ(withoutDefineMeta(flatOf("a\n#pragma define-meta X \\\n range([0, 1])\n#pragma other\nb\n")),
              "a\n\n\n#pragma other\nb\n");
}

TEST(EffectDefines, MalformedRangeIsReported) {
    const FlatSource flat = flatOf("#pragma define-meta N range([5, 1])\n");
    Problems problems;
    findDefines({&flat}, problems);
    ASSERT_EQ(problems.all().size(), 1u);
    EXPECT_EQ(problems.all()[0].message, "the range of 'N' is not two ascending integers");
}

class EffectDefineValues : public testing::Test {
protected:
    EffectDefineValues() {
        bench.fullscreen(
            "#pragma define-meta COUNT range([1, 8]) default(2)\n#pragma define-meta AXIS options([x, y])\n#pragma "
            "define-meta FLAG\n"
            "in vec2 v_uv;\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(v_uv.AXIS * float(COUNT));\n#if "
            "FLAG\nc += 1.0;\n#endif\n}\n");
    }
    EffectBench bench;
};

TEST_F(EffectDefineValues, ValuesReachTheShader) {
    EXPECT_NE(bench.get({{"COUNT", "8"}}).fragment, bench.get({{"COUNT", "7"}}).fragment);
    EXPECT_NE(bench.get({{"AXIS", "x"}}).fragment, bench.get({{"AXIS", "y"}}).fragment);
    EXPECT_EQ(bench.get({{"AXIS", "x"}}).fragment, bench.get().fragment);
    EXPECT_GT(bench.get({{"FLAG", "1"}}).fragment.size(), bench.get().fragment.size());
}

TEST_F(EffectDefineValues, DiscoverNamesThemAll) {
    EXPECT_EQ(namesOf(bench.effects.discoverDefines("e")), (std::vector<std::string>{"COUNT", "AXIS", "FLAG"}));
}

TEST_F(EffectDefineValues, WrongOnesAreReportedWhereTheyWereAsked) {
    const Problem unknown = bench.problem({{"FLAGG", "1"}});
    EXPECT_EQ(unknown.message, "effect 'e' has no define 'FLAGG'");
    EXPECT_EQ(unknown.where.file, "ask.json");
    EXPECT_EQ(unknown.where.line, 7);
    EXPECT_NE(unknown.help.find("did you mean 'FLAG'"), std::string::npos);
    EXPECT_NE(unknown.help.find("COUNT"), std::string::npos);
    EXPECT_EQ(bench.problem({{"COUNT", "9"}}).message, "define 'COUNT' is 9, outside its range");
    EXPECT_EQ(bench.problem({{"COUNT", "9"}}).help, "give 1 to 8");
    EXPECT_EQ(bench.problem({{"COUNT", "two"}}).message, "define 'COUNT' needs an integer, not 'two'");
    EXPECT_EQ(bench.problem({{"AXIS", "z"}}).message, "define 'AXIS' cannot be 'z'");
    EXPECT_EQ(bench.problem({{"FLAG", "2"}}).message, "define 'FLAG' is 2, but it is on or off");
    EXPECT_EQ(bench.problem({{"FLAG", "1\n#define EVIL"}}).message, "'1\n#define EVIL' is no value for define 'FLAG'");
}

TEST(EffectDefinesOfPasses, EmbeddedMacrosAreFixed) {
    EffectBench bench;
    bench.fullscreen(
        "layout(location = 0) out vec4 c;\nvoid main() { c = vec4(0.0);\n#if FIXED\nc += 1.0;\n#endif\n}\n",
        "      embeddedMacros: { FIXED: true }\n");
    const auto fixed = bench.get().fragment;
    EXPECT_EQ(bench.get({{"FIXED", "1"}}).fragment, fixed);
    EXPECT_EQ(bench.problem({{"FIXED", "0"}}).message, "define 'FIXED' is 0, but the pass of effect 'e' fixes it to 1");
}

}  // namespace
}  // namespace crevice
