// Which folder is the engine: a checkout, a part of it, an installed editor.
#include <gtest/gtest.h>

#include "CocosFrontTools.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

TEST(CocosRoots, ACheckoutAndItsParts) {
    EffectFolder folder;
    folder.write("my engine/editor/assets/effects/advanced/a.effect", "");
    const fs::path engine = fs::canonical(folder.path()) / "my engine";
    for (const char* part : {"", "editor", "editor/assets", "editor/assets/effects", "editor/assets/effects/advanced"})
        EXPECT_EQ(Roots({{}, {}, engineFolder(engine / part)}).engineAssets().lexically_normal(),
                  (engine / "editor/assets").lexically_normal())
            << part;
}

TEST(CocosRoots, AnInstalledEditor) {
    for (const char* below :
         {"resources/3d/engine", "resources/resources/3d/engine", "Contents/Resources/resources/3d/engine"}) {
        EffectFolder folder;
        folder.write(std::string("creator/") + below + "/editor/assets/chunks/a.chunk", "");
        const fs::path creator = folder.path() / "creator";
        EXPECT_EQ(engineFolder(creator), creator / below);
        EXPECT_EQ(engineFolder(creator / below), creator / below);
    }
}

TEST(CocosRoots, OtherFoldersStayAsTheyAre) {
    EffectFolder folder;
    folder.write("plain/chunks/a.chunk", "");
    folder.write("editor/notes.txt", "");
    EXPECT_EQ(engineFolder(folder.path() / "plain"), folder.path() / "plain");
    EXPECT_EQ(engineFolder(folder.path() / "editor"), folder.path() / "editor");
    EXPECT_EQ(engineFolder({}), fs::path());
}

}  // namespace
}  // namespace crevice::cocos
