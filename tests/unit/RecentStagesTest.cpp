// Tests of RecentStages: what is compiled again, and what is not.
#include <gtest/gtest.h>

#include "effect/RecentStages.h"

namespace crevice {
namespace {

StageSource fragment(const std::string& defines, const std::string& text, const std::string& file = "a.effect") {
    StageSource source;
    source.stage = kFragmentBit;
    source.head = "#version 450\n" + defines;
    source.text = source.flat.text = text;
    source.numbered = true;
    source.flat.files = {file};
    for (int line = 1; line <= 8; ++line) source.flat.lines.push_back({0, line});
    return source;
}

struct Bench {
    ShaderCompiler compiler;
    RecentStages stages;
    Problems problems;

    RecentStages::Stage get(const StageSource& source) {
        auto stage = stages.get(source, true, compiler, problems);
        EXPECT_TRUE(stage) << source.head << source.text;
        return stage.value_or(RecentStages::Stage{});
    }
    /// Facts that are shared are those of one stage.
    bool share(const StageSource& a, const StageSource& b) { return get(a).facts == get(b).facts; }
};

const std::string kOut = "layout(location = 0) out vec4 color;\n";
const std::string kPlain = kOut + "void main() { color = vec4(1.0); }\n";

TEST(RecentStages, AMacroThatNothingNamesChangesNothing) {
    Bench bench;
    EXPECT_TRUE(bench.share(fragment("#define USE_BONES 0\n", kPlain), fragment("#define USE_BONES 1\n", kPlain)));
    EXPECT_TRUE(bench.share(fragment("", kPlain), fragment("#define USE_BONES 1\n", kPlain)));
}

TEST(RecentStages, AMacroThatTheTextNamesMakesAnotherStage) {
    Bench bench;
    for (const char* use :
         {"void main() { color = vec4(FACTOR); }\n", "#if FACTOR > 1\n#endif\nvoid main() { color = vec4(1.0); }\n",
          "#ifdef FACTOR\n#endif\nvoid main() { color = vec4(1.0); }\n"})
        EXPECT_FALSE(
            bench.share(fragment("#define FACTOR 1\n", kOut + use), fragment("#define FACTOR 2\n", kOut + use)))
            << use;
}

TEST(RecentStages, AMacroThatAMacroNamesMakesAnotherStage) {
    Bench bench;
    const std::string text = kOut + "void main() { color = vec4(OUTER); }\n";
    EXPECT_FALSE(bench.share(fragment("#define INNER 1\n#define OUTER INNER\n", text),
                             fragment("#define INNER 2\n#define OUTER INNER\n", text)));
    EXPECT_FALSE(bench.share(fragment("#define INNER 1\n#define TWICE(x) x * INNER\n", kPlain),
                             fragment("#define INNER 2\n#define TWICE(x) x * INNER\n", kPlain)));
}

TEST(RecentStages, NamesThatAreOnlyPutTogetherCountAsNamed) {
    Bench bench;
    const std::string text = kOut + "#define JOIN(a, b) a##b\nvoid main() { color = vec4(JOIN(FAC, TOR)); }\n";
    const auto one = bench.get(fragment("#define FACTOR 1\n", text)),
               two = bench.get(fragment("#define FACTOR 2\n", text));
    EXPECT_NE(one.code.words, two.code.words);
}

TEST(RecentStages, NamesThatAreBrokenOverLinesCountAsNamed) {
    for (const char* name : {"FAC\\\nTOR", "FAC\\\r\nTOR", "F\\\nACTO\\\nR", "FAC\\\n\\\nTOR"}) {
        Bench bench;
        const std::string text = kOut + "void main() { color = vec4(" + name + "); }\n";
        EXPECT_FALSE(bench.share(fragment("#define FACTOR 1\n", text), fragment("#define FACTOR 2\n", text))) << name;
    }
    Bench bench;
    const std::string text = kOut + "#define JOIN(a, b) a#\\\n#b\nvoid main() { color = vec4(JOIN(FAC, TOR)); }\n";
    EXPECT_FALSE(bench.share(fragment("#define FACTOR 1\n", text), fragment("#define FACTOR 2\n", text)));
}

TEST(RecentStages, BodiesOverSeveralLinesBreakNoName) {
    Bench bench;
    const std::string text = kOut + "#define ONE \\\n  vec4(1.0)\nvoid main() { color = ONE; }\n";
    EXPECT_TRUE(bench.share(fragment("#define USE_BONES 0\n", text), fragment("#define USE_BONES 1\n", text)));
}

TEST(RecentStages, ANameWithinANameIsAnother) {
    Bench bench;
    const std::string text = kOut + "#define FACTOR_X 1\nvoid main() { color = vec4(FACTOR_X); }\n";
    EXPECT_TRUE(bench.share(fragment("#define FACTOR 1\n", text), fragment("#define FACTOR 2\n", text)));
}

TEST(RecentStages, FactsNameTheFileThatIsAsked) {
    Bench bench;
    const std::string text = kOut +
                             "layout(set = 1, binding = 0) uniform sampler2D map;\n"
                             "void main() { color = texture(map, vec2(0.5)); }\n";
    EXPECT_EQ(bench.get(fragment("", text, "a.effect")).facts->info.find("map")->where.file, "a.effect");
    EXPECT_EQ(bench.get(fragment("", text, "b.effect")).facts->info.find("map")->where.file, "b.effect");
}

TEST(RecentStages, MistakesAreTold) {
    Bench bench;
    EXPECT_FALSE(bench.stages.get(fragment("", "void main() { wrong }\n"), false, bench.compiler, bench.problems));
    EXPECT_TRUE(bench.problems.hasErrors());
}

}  // namespace
}  // namespace crevice
