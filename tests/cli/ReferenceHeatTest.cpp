// `crevice reference --heat`: the error of a measured map as a picture.
#include "CliTools.h"
#include "core/Image.h"
#include "truth/ErrorHeat.h"

namespace crevice::cli {
namespace {

class ReferenceHeatTest : public CliTest {};

TEST_F(ReferenceHeatTest, ShowsTheErrorOfEachMap) {
    const std::string reference = "reference crease -q --size 40x24 --samples 64 ";
    ASSERT_EQ(run(reference + "-o a.exr").code, 0);
    ASSERT_EQ(run(reference + "--seed 2 -o b.exr").code, 0);
    const Outcome outcome = run(reference + "-o t.exr --measure a.exr --heat ha.png --measure b.exr --heat hb.png");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(outcome.out.ends_with("t.exr\nha.png\nhb.png\n")) << outcome.out;
    const Image truth = readImage(path("t.exr"));
    std::size_t coloured = 0;
    for (const char* name : {"a", "b"}) {
        const Image map = readImage(path(std::string(name) + ".exr"));
        const Image heat = readImage(path("h" + std::string(name) + ".png"));
        ASSERT_EQ(heat.width, 40u);
        for (std::uint32_t y = 0; y < heat.height; ++y)
            for (std::uint32_t x = 0; x < heat.width; ++x) {
                const glm::ivec3 found(glm::round(glm::vec3(heat.at(x, y)) * 255.0f));
                const glm::ivec3 expected(heatColor(map.at(x, y).x - truth.at(x, y).x));
                if (found == glm::ivec3(128)) continue;  // sky
                ASSERT_EQ(found, expected) << name << ' ' << x << ',' << y;
                coloured += expected != glm::ivec3(heatColor(0));
            }
    }
    EXPECT_GT(coloured, 50u);
}

TEST_F(ReferenceHeatTest, AHeatWithoutAMapIsRefused) {
    expectRefused("reference crease -o a.exr --heat h.png", "--heat: 'h.png' has no map", "a --measure for each");
    expectRefused("reference crease -o a.exr --measure a.exr --heat h.gif", "--heat: '.gif' is not a kind of picture",
                  ".png");
}

}  // namespace
}  // namespace crevice::cli
