// Includes: where they are looked for, once per stage, cycles, confinement, limits, and the places of lines.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "EffectTestTools.h"
#include "effect/Includes.h"

namespace crevice {
namespace {

class EffectIncludes : public testing::Test {
protected:
    EffectIncludes() {
        effect_.name = "e";
        effect_.path = (folder_.path() / "effects/sub/e.effect").string();
        std::filesystem::create_directories(folder_.path() / "effects/sub");
    }
    void program(const std::string& name, const std::string& text, int line = 10) {
        effect_.programs[name] = {text, line};
    }
    void chunk(const std::string& name, const std::string& text) {
        folder_.write("effects/chunks/" + name + ".chunk", text);
    }
    FlatSource flatten(IncludeLimits limits = {}) {
        const AssetRoots roots({folder_.path()});
        return flattenProgram({effect_, roots, generated_, limits}, "main", {"e.effect", 3, 5, 4}, problems_);
    }
    Problem problem() const { return problems_.all().empty() ? Problem{} : problems_.all().front(); }

    EffectFolder folder_;
    EffectAsset effect_;
    Chunks generated_;
    Problems problems_;
};

int count(const std::string& text, const std::string& part) {
    int n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

TEST_F(EffectIncludes, EveryLineKnowsItsPlace) {
    program("main", "\nfirst\n#include <a>\nlast");
    chunk("a", "a1\n#include <deep/b>\na3\n");
    chunk("deep/b", "b1\n");
    const FlatSource flat = flatten();
    EXPECT_FALSE(problems_.hasErrors());
    ASSERT_EQ(std::count(flat.text.begin(), flat.text.end(), '\n'), static_cast<long>(flat.lines.size()));
    const auto placeOf = [&](const std::string& word) {
        const auto at = flat.text.find(word);
        const auto line = std::count(flat.text.begin(), flat.text.begin() + static_cast<long>(at), '\n') + 1;
        const SourceLoc where = flat.locate(static_cast<int>(line));
        return std::filesystem::path(where.file).filename().string() + ":" + std::to_string(where.line);
    };
    EXPECT_EQ(placeOf("first"), "e.effect:11");
    EXPECT_EQ(placeOf("a1"), "a.chunk:1");
    EXPECT_EQ(placeOf("b1"), "b.chunk:1");
    EXPECT_EQ(placeOf("a3"), "a.chunk:3");
    EXPECT_EQ(placeOf("last"), "e.effect:13");
}

TEST_F(EffectIncludes, OrderOfPlaces) {
    program("main", "#include <x>\n#include \"y\"\n#include <z>\n#include <./near>\n");
    program("x", "x_program\n");
    chunk("x", "x_chunk\n");
    chunk("y", "y_chunk\n");
    chunk("z", "z_chunk\n");
    generated_["x"] = "x_generated\n";
    generated_["z"] = "z_generated\n";
    folder_.write("effects/sub/near.chunk", "near_file\n");
    const FlatSource flat = flatten();
    EXPECT_FALSE(problems_.hasErrors());
    for (const char* word : {"x_program", "y_chunk", "z_generated", "near_file"})
        EXPECT_EQ(count(flat.text, word), 1) << word;
    for (const char* word : {"x_chunk", "x_generated", "z_chunk"}) EXPECT_EQ(count(flat.text, word), 0) << word;
}

TEST_F(EffectIncludes, RelativeToTheIncludingFile) {
    program("main", "#include <./parts/one>\n");
    folder_.write("effects/sub/parts/one.chunk", "#include <./two>\n#include <../three>\n");
    folder_.write("effects/sub/parts/two.chunk", "two_file\n");
    folder_.write("effects/sub/three.chunk", "three_file\n");
    const FlatSource flat = flatten();
    EXPECT_FALSE(problems_.hasErrors()) << problem().message;
    EXPECT_EQ(count(flat.text, "two_file") + count(flat.text, "three_file"), 2);
}

TEST_F(EffectIncludes, OncePerStage) {
    program("main", "#include <a>\n#include <b>\n#include <a>\n");
    chunk("a", "a_text\n");
    chunk("b", "#include <a>\nb_text\n");
    const FlatSource flat = flatten();
    EXPECT_EQ(count(flat.text, "a_text"), 1);
    EXPECT_EQ(count(flat.text, "b_text"), 1);
}

TEST_F(EffectIncludes, AnUntakenBranchDoesNotHideALaterInclude) {
    program("main", "#if OFF\n#include <a>\n#endif\n#include <a>\n");
    chunk("a", "a_text\n");
    const FlatSource flat = flatten();
    EXPECT_EQ(count(flat.text, "a_text"), 2);
    EXPECT_EQ(count(flat.text, "#ifndef"), 2);
    EXPECT_EQ(count(flat.text, "#endif"), 3);
}

TEST_F(EffectIncludes, CommentsHideIncludesAndKeepColumns) {
    program("main", "// #include <no>\n/* #include <no>\n*/ x /* y */ z\n");
    const FlatSource flat = flatten();
    EXPECT_FALSE(problems_.hasErrors());
    EXPECT_EQ(count(flat.text, "#include"), 0);
    EXPECT_EQ(flat.text.substr(flat.text.find('x')).find('z'), 10u);
}

TEST_F(EffectIncludes, BlanksBehindABackslashAndWindowsLineEndsContinueALine) {
    program("main", "#define A(x) \\\r\n x\r\n#define B \\ \t\n 2\n");
    EXPECT_EQ(flatten().text.substr(0, 34), "#define A(x) \\\n x \n#define B \\\n 2\n");
}

TEST_F(EffectIncludes, MissingChunkListsPlacesAndNearNames) {
    program("main", "a\n  #include <cc-camra>\n");
    chunk("cc-camera", "");
    flatten();
    EXPECT_EQ(problem().message, "no chunk or program 'cc-camra' to include");
    EXPECT_EQ(problem().where.line, 11);
    EXPECT_EQ(problem().where.column, 3);
    EXPECT_NE(problem().help.find("did you mean 'cc-camera'"), std::string::npos);
    EXPECT_NE(problem().help.find("effects/chunks/cc-camra.chunk"), std::string::npos);
}

TEST_F(EffectIncludes, MissingProgramIsReportedAtThePass) {
    program("man", "");
    flatten();
    EXPECT_EQ(problem().message, "no program 'main'");
    EXPECT_EQ(problem().where.line, 3);
    EXPECT_NE(problem().help.find("did you mean 'man'"), std::string::npos);
}

TEST_F(EffectIncludes, CycleShowsTheChain) {
    program("main", "#include <a>\n");
    chunk("a", "#include <b>\n");
    chunk("b", "\n#include <a>\n");
    flatten();
    EXPECT_EQ(problem().message, "include cycle: a -> b -> a");
    EXPECT_EQ(std::filesystem::path(problem().where.file).filename(), "b.chunk");
    EXPECT_EQ(problem().where.line, 2);
}

TEST_F(EffectIncludes, NoEscapeFromTheAssetFolders) {
    EffectFolder outside;
    outside.write("secret.chunk", "secret\n");
    program("main",
            "#include <../../../" + outside.path().filename().string() + "/secret>\n#include </etc/hostname>\n");
    const FlatSource flat = flatten();
    EXPECT_EQ(count(flat.text, "secret"), 0);
    ASSERT_EQ(problems_.all().size(), 2u);
    EXPECT_NE(problem().message.find("leaves the asset folders"), std::string::npos);
    EXPECT_EQ(problems_.all()[1].message, "no chunk or program '/etc/hostname' to include");
}

TEST_F(EffectIncludes, NoEscapeThroughALink) {
    EffectFolder outside;
    outside.write("secret.chunk", "secret\n");
    std::filesystem::create_symlink(outside.path() / "secret.chunk", folder_.path() / "effects/sub/link.chunk");
    program("main", "#include <./link>\n");
    EXPECT_EQ(count(flatten().text, "secret"), 0);
    EXPECT_NE(problem().message.find("leaves the asset folders"), std::string::npos);
}

TEST_F(EffectIncludes, Limits) {
    std::string many;
    for (int i = 0; i < 1001; ++i) many += "#include <a>\n";
    program("main", many);
    chunk("a", "");
    flatten();
    EXPECT_EQ(problem().message, "a shader has more than 1000 includes");
    ASSERT_EQ(problems_.all().size(), 1u);
}

TEST_F(EffectIncludes, DepthAndSizeLimits) {
    for (int i = 0; i < 80; ++i) generated_[fmt::format("d{}", i)] = fmt::format("#include <d{}>\n", i + 1);
    program("main", "#include <d0>\n");
    flatten();
    EXPECT_EQ(problem().message, "includes are nested deeper than 64");
    problems_ = {};
    program("main", std::string(100, 'x'));
    flatten({.maxBytes = 99});
    EXPECT_NE(problem().message.find("larger than"), std::string::npos);
}

TEST_F(EffectIncludes, MalformedIncludeAndVersion) {
    program("main", "#include cc\n#include <>\n#version 300 es\n");
    flatten();
    ASSERT_EQ(problems_.all().size(), 3u);
    EXPECT_EQ(problems_.all()[0].message, "malformed #include");
    EXPECT_EQ(problems_.all()[1].message, "malformed #include");
    EXPECT_EQ(problems_.all()[2].message, "a program must not have '#version'");
}

}  // namespace
}  // namespace crevice
