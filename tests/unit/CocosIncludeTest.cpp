// #include in Cocos' dialect: five rules of lookup, once per stage, places, mistakes, limits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "CocosFrontTools.h"

namespace crevice::cocos {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(CocosInclude, ProgramOfTheSameEffectComesFirst) {
    CocosBench bench;
    bench.chunk("shared", "float fromChunk;\n");
    bench.fragment("#include <shared>\n", "CCProgram shared %{\nfloat fromProgram;\n}%\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), ElementsAre("float fromProgram;"));
}

TEST(CocosInclude, ChunksSeeTheProgramsOfTheEffect) {
    CocosBench bench;
    bench.chunk("entry", "#include <surface>\nfloat last;\n");
    bench.fragment("#include <entry>\n", "CCProgram surface %{\nfloat first;\n}%\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), ElementsAre("float first;", "float last;"));
}

TEST(CocosInclude, DotIsRelativeToTheIncludingFile) {
    CocosBench bench;
    bench.folder.write("p/assets/effects/chunks/a.chunk", "#include <../b>\n#include <./c>\n");
    bench.folder.write("p/assets/effects/b.chunk", "float b;\n");
    bench.folder.write("p/assets/effects/chunks/c.chunk", "float c;\n");
    bench.folder.write("p/assets/chunks/c.chunk", "float wrong;\n");
    bench.fragment("#include <./chunks/a>\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), ElementsAre("float b;", "float c;"));
}

TEST(CocosInclude, DotsMayBeMeantFromAChunkFolderOrAFormerPlace) {
    CocosBench bench;
    bench.folder.write("e/editor/assets/effects/advanced/tools.chunk", "float tools;\n");
    bench.folder.write("e/editor/assets/lib/other.chunk", "float other;\n");
    bench.engineChunk("near", "float wrong;\n");
    bench.folder.write("p/assets/effects/near.chunk", "float near;\n");
    bench.folder.write("p/assets/effects/deep/er/a.chunk",
                       "#include <../effects/advanced/tools>\n#include <./lib/other>\n#include <../../near>\n");
    bench.fragment("#include <./deep/er/a>\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), ElementsAre("float tools;", "float other;", "float near;"));
}

TEST(CocosInclude, ChunkFoldersComeBeforeNeighboursAndProjectBeforeEngine) {
    CocosBench bench;
    bench.engineChunk("builtin/uniforms/a", "float engineA;\n");
    bench.engineChunk("common/b", "float engineB;\n");
    bench.chunk("common/b", "float projectB;\n");
    bench.folder.write("p/assets/effects/common/b.chunk", "float neighbourB;\n");
    bench.folder.write("p/assets/lib/c.chunk", "float belowAssets;\n");
    bench.fragment("#include <builtin/uniforms/a>\n#include <common/b>\n#include <lib/c>\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text),
                ElementsAre("float engineA;", "float projectB;", "float belowAssets;"));
}

TEST(CocosInclude, NeighbourWithoutDot) {
    CocosBench bench;
    bench.folder.write("p/assets/effects/chunks/near.chunk", "#include <nearer>\n");
    bench.folder.write("p/assets/effects/chunks/nearer.chunk", "float nearer;\n");
    bench.fragment("#include <chunks/near>\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), ElementsAre("float nearer;"));
}

TEST(CocosInclude, UniqueBaseNameAnywhere) {
    CocosBench bench;
    bench.engineChunk("common/data/unpack", "float unpack;\n");
    bench.folder.write("p/assets/deep/er/own.chunk", "float own;\n");
    bench.fragment("#include <unpack>\n#include <er/own>\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), ElementsAre("float unpack;", "float own;"));
}

TEST(CocosInclude, AmbiguousBaseNameIsAnError) {
    CocosBench bench;
    bench.engineChunk("a/twice", "float a;\n");
    bench.engineChunk("b/twice", "float b;\n");
    bench.fragment("\n  #include <twice>\n");
    const Problem problem = bench.problem();
    EXPECT_EQ(problem.message, "no chunk or program 'twice' to include");
    EXPECT_THAT(problem.help, HasSubstr("both end so"));
    EXPECT_EQ(problem.where.file, bench.file());
    EXPECT_EQ(problem.where.line, 12);
    EXPECT_EQ(problem.where.column, 3);
}

TEST(CocosInclude, QuotesAreBracketsAndAnEndingIsAllowed) {
    CocosBench bench;
    bench.chunk("a", "float a;\n");
    bench.chunk("b", "float b;\n");
    bench.fragment("#include \"a\"\n# include <b.chunk>\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), ElementsAre("float a;", "float b;"));
}

TEST(CocosInclude, OncePerStageAtTheFirstTextualPlace) {
    CocosBench bench;
    bench.chunk("a", "float a;\n");
    bench.chunk("b", "#include <a>\nfloat b;\n");
    bench.effect("#include <a>\nvoid main() {}\n", "#include <b>\n#include <a>\n#include <b>\nfloat end;\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), ElementsAre("float a;", "float b;", "float end;"));
}

TEST(CocosInclude, FirstPlaceInABranchHidesLaterOnesAsInCocos) {
    CocosBench bench;
    bench.chunk("a", "float a;\n");
    bench.fragment("#if USE_A\n#include <a>\n#endif\n#include <a>\nfloat end;\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), ElementsAre("#if USE_A", "float a;", "#endif", "float end;"));
}

TEST(CocosInclude, TwoNamesOfOneFileAreOneChunk) {
    CocosBench bench;
    bench.engineChunk("common/data/unpack", "float unpack;\n");
    bench.fragment("#include <unpack>\n#include <common/data/unpack>\n");
    EXPECT_THAT(words(bench.fragmentText().flat.text), ElementsAre("float unpack;"));
}

TEST(CocosInclude, CommentsHideIncludesAndLinesKeepTheirPlaces) {
    CocosBench bench;
    bench.chunk("a", "\n\nfloat a; // one\n/* two\nthree */ float b;\n");
    bench.fragment("// #include <missing>\n/*\n#include <missing>\n*/\n#include <a>\n");
    const StageText text = bench.fragmentText();
    EXPECT_THAT(words(text.flat.text), ElementsAre("float a;", "float b;"));
    EXPECT_EQ(originOf(text, "float a;"), "a.chunk:3");
    EXPECT_EQ(originOf(text, "float b;"), "a.chunk:5");
}

TEST(CocosInclude, ProgramsAreChunksToo) {
    CocosBench bench;
    bench.engineChunk("legacy/main-functions/general-vs", "vec4 vert() { return vec4(0.0); }\n");
    bench.folder.write(
        "p/assets/effects/t.effect",
        "CCEffect %{\n  techniques:\n  - passes:\n    - vert: general-vs:vert\n      frag: own:frag\n}%\n"
        "CCProgram own %{\nvec4 frag() { return vec4(1.0); }\n}%\n");
    const EffectVariant variant = bench.compile();
    EXPECT_EQ(variant.name, "t|general-vs:vert|own:frag");
    ASSERT_EQ(variant.info.outputs.size(), 1u);
    EXPECT_EQ(variant.info.outputs[0].name, "cc_FragColor");
    EXPECT_EQ(variant.info.outputs[0].location, 0u);
}

TEST(CocosInclude, MissingProgramIsNamedAtThePass) {
    CocosBench bench;
    bench.folder.write("p/assets/effects/t.effect",
                       "CCEffect %{\n  techniques:\n  - passes:\n    - vert: gone:vert\n      frag: own\n}%\n"
                       "CCProgram own %{\nvoid main() {}\n}%\n");
    const Problem problem = bench.problem();
    EXPECT_EQ(problem.message, "no program or chunk 'gone'");
    EXPECT_EQ(problem.where.line, 4);
}

TEST(CocosInclude, MissingChunkSaysWhereAndWhatIsNear) {
    CocosBench bench;
    bench.chunk("lighting", "float a;\n");
    bench.chunk("outer", "float a;\n  #include <lightning>\n");
    bench.fragment("#include <outer>\n");
    const Problem problem = bench.problem();
    EXPECT_EQ(problem.message, "no chunk or program 'lightning' to include");
    EXPECT_THAT(problem.help, HasSubstr("did you mean 'lighting'?"));
    EXPECT_THAT(problem.where.file, HasSubstr("outer.chunk"));
    EXPECT_EQ(problem.where.line, 2);
}

TEST(CocosInclude, PathsOutsideOfTheFoldersAreRefused) {
    CocosBench bench;
    bench.folder.write("secret.chunk", "float secret;\n");
    bench.fragment("#include <../../../secret>\n");
    EXPECT_THAT(bench.problem().help, HasSubstr("leads out of"));
    bench.fragment("#include <" + (bench.folder.path() / "secret").string() + ">\n");
    EXPECT_THAT(bench.problem().help, HasSubstr("relative"));
}

TEST(CocosInclude, CyclesAreErrorsWithTheirChain) {
    CocosBench bench;
    bench.chunk("a", "#include <b>\n");
    bench.chunk("b", "#include <a>\n");
    bench.fragment("#include <a>\n");
    EXPECT_EQ(bench.problem().message, "include cycle: a -> b -> a");
}

TEST(CocosInclude, TooManyAndTooDeepIncludesEnd) {
    CocosBench bench;
    for (int i = 0; i < 70; ++i) bench.chunk("d" + std::to_string(i), "#include <d" + std::to_string(i + 1) + ">\n");
    bench.chunk("d70", "float a;\n");
    bench.fragment("#include <d0>\n");
    EXPECT_EQ(bench.problem().message, "includes are nested deeper than 64");
    std::string many;
    for (int i = 0; i < 2100; ++i) many += "#include <d70>\n";
    bench.fragment(many);
    EXPECT_EQ(bench.problem().message, "a stage has more than 2000 includes");
}

TEST(CocosInclude, AGigabyteOfIncludesEnds) {
    CocosBench bench;
    const std::string line = "float aLineThatIsRatherLongAndSaysNothingButFillsTheFileUpToItsVeryEnd;\n";
    std::string three;
    while (three.size() < (3u << 20)) three += line;
    std::string all;
    for (int i = 0; i < 6; ++i) {
        bench.chunk("big" + std::to_string(i), three);
        all += "#include <big" + std::to_string(i) + ">\n";
    }
    bench.fragment(all);
    EXPECT_EQ(bench.problem().message, "the flattened stage is larger than 16 MB");
    std::ofstream(bench.folder.path() / "p/assets/chunks/huge.chunk") << three << three;
    bench.fragment("#include <huge>\n");
    EXPECT_THAT(bench.problem().message, HasSubstr("larger"));
}

}  // namespace
}  // namespace crevice::cocos
