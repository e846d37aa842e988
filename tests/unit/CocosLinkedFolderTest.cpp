// Links to folders below chunk and asset folders: what lies behind them is found, edits of it are seen, circles end.
#include <gtest/gtest.h>

#include "EffectTestTools.h"
#include "cocos/CocosEffects.h"
#include "cocos/files/FileIndex.h"
#include "cocos/files/Fingerprint.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

/// `link` below the folder leads to `target` below it.
void link(const EffectFolder& folder, const std::string& link, const std::string& target) {
    fs::create_directories((folder.path() / link).parent_path());
    fs::create_directory_symlink(folder.path() / target, folder.path() / link);
}

TEST(CocosLinkedFolder, ChunksBehindItAreFound) {
    const EffectFolder folder;
    folder.write("elsewhere/deep/linked.chunk", "");
    link(folder, "ch/sublink", "elsewhere");
    const FileIndex index({folder.path() / "ch"}, ".chunk");
    EXPECT_EQ(index.names(), Names{"sublink/deep/linked"});
    ASSERT_NE(index.find("sublink/deep/linked"), nullptr);
    EXPECT_EQ(index.endingWith("linked").size(), 1u);
}

TEST(CocosLinkedFolder, AnEffectIncludesWhatLiesBehindIt) {
    const EffectFolder folder;
    folder.write("elsewhere/linked.chunk", "vec4 linked() { return vec4(1.0); }\n");
    link(folder, "p/assets/chunks/sublink", "elsewhere");
    for (const char* name : {"sublink/linked", "linked"}) {
        folder.write("p/assets/e.effect",
                     "CCEffect %{\n  techniques:\n  - passes: [ { vert: vs:vert, frag: fs:frag } ]\n}%\n"
                     "CCProgram vs %{\n  vec4 vert () { return vec4(0.0); }\n}%\n"
                     "CCProgram fs %{\n  #include <" +
                         std::string(name) + ">\n  vec4 frag () { return linked(); }\n}%\n");
        Roots roots;
        roots.project = folder.path() / "p";
        EffectLibrary library(AssetRoots({}), Log(), {.useDiskCache = false});
        library.addFrontEnd(std::make_unique<CocosEffects>(roots));
        VariantRequest request;
        request.effect = "e";
        try {
            EXPECT_FALSE(library.get(request, {}).fragment.empty());
        } catch (const Error& error) {
            ADD_FAILURE() << name << ": " << error.what();
        }
    }
}

TEST(CocosLinkedFolder, CirclesEndAndOneFileOfTwoNamesIsNotAmbiguous) {
    const EffectFolder folder;
    folder.write("ch/a/x.chunk", "");
    link(folder, "ch/a/loop", "ch");
    link(folder, "ch/a/self", "ch/a");
    link(folder, "ch/0again", "ch/a");  // before 'a' in the order of names
    link(folder, "ch/nothing", "gone");
    const FileIndex index({folder.path() / "ch"}, ".chunk");
    // 0again/loop leads to ch and 0again/self to a, both of which the walk stands within.
    EXPECT_EQ(index.names(), (Names{"0again/x", "a/x"}));
    EXPECT_EQ(index.endingWith("x").size(), 1u);
}

TEST(CocosLinkedFolder, LinksThatMultiplyAreBounded) {
    const EffectFolder folder;
    for (int i = 0; i < 30; ++i)
        for (const char* name : {"/a", "/b"}) link(folder, std::to_string(i) + name, std::to_string(i + 1));
    folder.write("30/x.chunk", "");  // 2^30 paths lead here
    const FileIndex index({folder.path() / "0"}, ".chunk");
    EXPECT_GE(index.entries().size(), 1u);
    EXPECT_LE(index.entries().size(), 4u);
}

TEST(CocosLinkedFolder, EditsBehindItAreSeen) {
    const EffectFolder folder;
    folder.write("elsewhere/linked.chunk", "a");
    link(folder, "p/assets/sublink", "elsewhere");
    link(folder, "p/assets/loop", "p");
    Roots roots;
    roots.project = folder.path() / "p";
    const std::string first = fingerprintOf(roots);
    EXPECT_FALSE(first.empty()) << "a circle is no reason to keep nothing";
    EXPECT_EQ(fingerprintOf(roots), first);
    folder.write("elsewhere/linked.chunk", "longer");
    EXPECT_NE(fingerprintOf(roots), first);
}

}  // namespace
}  // namespace crevice::cocos
