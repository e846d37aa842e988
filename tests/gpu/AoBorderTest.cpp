// What stands beside the frame: the techniques on slices take it that surfaces go on as they leave the picture.
#include <cmath>

#include "AoHorizonFixture.h"

namespace crevice {
namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 72;

struct Known {
    float distance;  // from the wall's foot, in radii
    double endless;  // openness of a floor beside a wall without end, hard reach, in closed form
    double cut;      // the same beside one of kCut: 1 - (1 - cos α) / 2, α the angle of its top
};
constexpr Known kBesideWall[] = {{0.2f, 0.626, 0.854}, {0.3f, 0.688, 0.916}, {0.5f, 0.804, 0.964}};

class AoBorder : public AoHorizonTest, public testing::WithParamInterface<std::string> {};

TEST_P(AoBorder, WallThatLeavesTheFrameRisesOn) {
    // Seen at 45 degrees, the wall is cut by the frame's border a fifth of the radius above its foot. The guess is
    // worth at least a third of the way from what is seen to what is there, and never more than the wall without end.
    Options options;
    if (GetParam() == "vbao") options["thickness"] = "4";
    loadSlices(GetParam(), 1, options);
    Scene scene = emptyScene();
    addSquare(scene, {10, 0, 0}, {0, 1, 0}, 20);
    addSquare(scene, {0, 10, 0}, {1, 0, 0}, 20);
    renderer_->setScene(std::move(scene));
    constexpr float kSeen = 1.2f, kCut = 0.2f;
    const glm::vec3 across = glm::vec3(1, -1, 0) / std::sqrt(2.0f);
    const float middle = 0.5f * kSeen * float(kWidth) / float(kHeight) - kCut / std::sqrt(2.0f);
    const Camera camera = cameraTowards({1, 1, 0}, middle * across, kSeen, true, {0, 0, 1});
    const std::vector<Image> images =
        targets(viewOf(camera, kWidth, kHeight), {"cc_ssaoMap", "cc_gbuffer_positionMap"});
    float highest = 0;
    for (const Known& known : kBesideWall) {
        double sum = 0;
        int count = 0;
        for (std::uint32_t y = 0; y < kHeight; ++y)
            for (std::uint32_t x = 0; x < kWidth; ++x) {
                const glm::vec3 p(images[1].at(x, y));
                highest = std::max(highest, p.y);
                if (std::abs(p.y) > 1e-3f || std::abs(p.x - known.distance) > 0.03f) continue;
                sum += images[0].at(x, y).x;
                ++count;
            }
        ASSERT_GT(count, 50);
        EXPECT_LT(sum / count, known.cut - (known.cut - known.endless) / 3) << known.distance;
        EXPECT_GT(sum / count, known.endless - 0.03) << known.distance;
    }
    EXPECT_NEAR(highest, kCut, 0.03) << "the wall is cut";
}

INSTANTIATE_TEST_SUITE_P(, AoBorder, testing::Values("gtao", "vbao"), [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace crevice
