// `crevice sheet`: where tiles and labels are, and what is refused.
#include "CliTools.h"
#include "core/Image.h"

namespace crevice::cli {
namespace {

class SheetTest : public CliTest {
protected:
    static constexpr glm::uvec2 kTile{64, 36};
    static constexpr std::uint32_t kGap = 8, kLabel = 22;  // 14 for the letters and a gap above

    /// Pixels of the sheet that are brighter than its paper, in a rectangle.
    static std::size_t countInk(const Image& sheet, glm::uvec2 begin, glm::uvec2 size) {
        std::size_t count = 0;
        for (std::uint32_t y = begin.y; y < begin.y + size.y; ++y) {
            for (std::uint32_t x = begin.x; x < begin.x + size.x; ++x) count += sheet.at(x, y).g > 0.7f ? 1 : 0;
        }
        return count;
    }
};

TEST_F(SheetTest, TilesAreTheScenesInOrderWithLabelsBelow) {
    ASSERT_EQ(run("sheet crease default crease -o sheet.png --size 64x36 --columns 2").code, 0);
    EXPECT_EQ(files(), std::vector<std::string>{"sheet.png"});
    const Image sheet = readImage(path("sheet.png"));
    EXPECT_EQ(sheet.width, 2 * (kTile.x + kGap) + kGap);
    EXPECT_EQ(sheet.height, 2 * (kTile.y + kLabel + kGap) + kGap);

    ASSERT_EQ(run("render crease -o crease.png --size 64x36").code, 0);
    const Image crease = readImage(path("crease.png"));
    const glm::uvec2 first{kGap, kGap}, third{kGap, 2 * kGap + kTile.y + kLabel};
    for (std::uint32_t y = 0; y < kTile.y; ++y) {
        for (std::uint32_t x = 0; x < kTile.x; ++x) {
            ASSERT_EQ(sheet.at(first.x + x, first.y + y), crease.at(x, y)) << x << " " << y;
            ASSERT_EQ(sheet.at(third.x + x, third.y + y), crease.at(x, y)) << x << " " << y;
        }
    }
    const std::size_t ink = countInk(sheet, {first.x, first.y + kTile.y}, {kTile.x, kLabel});
    EXPECT_GT(ink, 100u);
    EXPECT_EQ(ink, countInk(sheet, {third.x, third.y + kTile.y}, {kTile.x, kLabel}));  // the same word
    const std::uint32_t second = 2 * kGap + kTile.x;
    EXPECT_NE(ink, countInk(sheet, {second, first.y + kTile.y}, {kTile.x, kLabel}));
    EXPECT_EQ(countInk(sheet, {second, third.y}, {kTile.x, kTile.y + kLabel}), 0u);  // no fourth
}

/// A project with one scene: a white sphere before a blue background, and one that holds a mistake.
TEST_F(SheetTest, ScenesAndPipelinesOfCocosAreDrawn) {
    std::filesystem::create_directories(path("game/assets"));
    write("game/package.json", "{}");
    write("game/assets/main.scene",
          R"([ { "__type__": "cc.SceneAsset", "scene": { "__type__": "cc.Scene", "_children": [
      { "__type__": "cc.Node", "_lpos": { "__type__": "cc.Vec3", "x": 0, "y": 0, "z": 3 }, "_components": [
        { "__type__": "cc.Camera", "_clearFlags": 7, "_color": { "__type__": "cc.Color", "r": 0, "g": 0, "b": 255, "a": 255 } } ] },
      { "__type__": "cc.Node", "_components": [
        { "__type__": "cc.MeshRenderer", "_mesh": { "__uuid__": "1263d74c-8167-4928-91a6-4e2672411f47@17020" } } ] } ] } } ])");
    ASSERT_EQ(run("sheet game/assets/main.scene -o own.png --size 64x36").code, 0);
    const Image own = readImage(path("own.png"));
    EXPECT_EQ(own.at(kGap, kGap), glm::vec4(0, 0, 1, 1));  // the camera's colour
    EXPECT_NE(own.at(kGap + kTile.x / 2, kGap + kTile.y / 2), glm::vec4(0, 0, 1, 1));
    const std::string article = std::string(CREVICE_TEST_SOURCE_DIR) + "/tests/cocos/article-v36/";
    const std::string pipeline =
        "-p " + article + "project/assets/pipeline/ssao-deferred-pipeline.rpp --engine " + article + "engine";
    ASSERT_EQ(run("sheet crease -o sheet.png --size 64x36 " + pipeline).code, 0);
    ASSERT_EQ(run("render crease -o crease.png --size 64x36 --background #3c3e42 " + pipeline).code, 0);
    const Image sheet = readImage(path("sheet.png")), crease = readImage(path("crease.png"));
    for (std::uint32_t y = 0; y < kTile.y; ++y)
        for (std::uint32_t x = 0; x < kTile.x; ++x) ASSERT_EQ(sheet.at(kGap + x, kGap + y), crease.at(x, y)) << x;
}

TEST_F(SheetTest, AScenesMistakeCostsItsTileAndTheExitCode) {
    write("broken.gltf", "{ \"asset\": ");
    const Outcome result = run("sheet crease broken.gltf crease -o sheet.png --size 160x40 --columns 3");
    EXPECT_EQ(result.code, 1);
    EXPECT_NE(result.err.find("broken.gltf:1:11: error: the text ends"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("no picture of 1 of 3 scenes: broken"), std::string::npos) << result.err;
    const Image sheet = readImage(path("sheet.png"));
    const glm::uvec2 tile{160, 40};
    const auto column = [&](std::uint32_t i) { return kGap + i * (tile.x + kGap); };
    for (std::uint32_t y = 0; y < tile.y; ++y)
        for (std::uint32_t x = 0; x < tile.x; ++x)
            ASSERT_EQ(sheet.at(column(0) + x, kGap + y), sheet.at(column(2) + x, kGap + y)) << x;
    EXPECT_GT(countInk(sheet, {column(1), kGap}, tile), 100u);                       // NO PICTURE
    EXPECT_GT(countInk(sheet, {column(1), kGap + tile.y}, {tile.x, kLabel}), 100u);  // and its name
    expectRefused("sheet broken.gltf broken.gltf -o none.png --size 64x36", "the text ends", "complete the document");
}

TEST_F(SheetTest, AnEnvironmentLightsEveryTile) {
    ASSERT_EQ(run("sheet crease crease -o plain.png --size 64x36 --environment none").code, 0);
    ASSERT_EQ(run("sheet crease crease -o sky.png --size 64x36 --environment sky").code, 0);
    const Image plain = readImage(path("plain.png")), sky = readImage(path("sky.png"));
    const auto differs = [&](std::uint32_t left) {
        int count = 0;
        for (std::uint32_t y = 0; y < kTile.y; ++y)
            for (std::uint32_t x = 0; x < kTile.x; ++x)
                count += plain.at(left + x, kGap + y) != sky.at(left + x, kGap + y) ? 1 : 0;
        return count;
    };
    EXPECT_GT(differs(kGap), 500);
    EXPECT_GT(differs(2 * kGap + kTile.x), 500);
    expectRefused("sheet crease -o a.png --environment nowhere.hdr", "cannot read 'nowhere.hdr'", "");
}

TEST_F(SheetTest, MistakesAreRefused) {
    expectRefused("sheet -o a.png", "no scene given", "name files");
    expectRefused("sheet crease", "no output given", "-o SHEET.png");
    expectRefused("sheet creese -o a.png", "no scene named 'creese'", "did you mean 'crease'");
    expectRefused("sheet crease -o a.png --columns 0", "--columns", "from 1");
    expectRefused("sheet crease crease -o a.png --size 9000x9000 --columns 2", "the sheet would be", "smaller --size");
}

}  // namespace
}  // namespace crevice::cli
