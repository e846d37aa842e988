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

TEST_F(SheetTest, MistakesAreRefused) {
    expectRefused("sheet -o a.png", "no scene given", "name files");
    expectRefused("sheet crease", "no output given", "-o SHEET.png");
    expectRefused("sheet creese -o a.png", "no scene named 'creese'", "did you mean 'crease'");
    expectRefused("sheet crease -o a.png --columns 0", "--columns", "from 1");
    expectRefused("sheet crease crease -o a.png --size 9000x9000 --columns 2", "the sheet would be", "smaller --size");
}

}  // namespace
}  // namespace crevice::cli
