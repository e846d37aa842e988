// temporalFrames: noise indices of a still view add up to the same map, whichever they are, with less noise the more.
#include "AoHorizonFixture.h"

namespace crevice {
namespace {

constexpr std::uint32_t kWidth = 80, kHeight = 60;

class AoHorizonFrames : public AoHorizonTest, public testing::WithParamInterface<const char*> {
protected:
    FloatMap rawMap(const std::string& frames, const std::string& seed) {
        loadSlices(GetParam(), 1,
                   {{"quality", "fast"}, {"resolution", "full"}, {"temporalFrames", frames}, {"seed", seed}});
        Scene scene = wallScene();
        addBox(scene, {1, 0.3f, 0.4f}, {0.5f, 0.6f, 0.5f});
        renderer_->setScene(std::move(scene));
        return map(viewOf(wallCamera(4), kWidth, kHeight));
    }
    static double rootMeanSquare(const FloatMap& a, const FloatMap& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.values.size(); ++i) sum += std::pow(double(a.values[i]) - b.values[i], 2);
        return std::sqrt(sum / static_cast<double>(a.values.size()));
    }
};

TEST_P(AoHorizonFrames, ManyFramesConverge) {
    const FloatMap all = rawMap("64", "0");
    const FloatMap early = rawMap("32", "0"), late = rawMap("32", "32");
    const FloatMap one = rawMap("1", "7"), four = rawMap("4", "7");
    const double noiseOfOne = rootMeanSquare(one, all), noiseOfFour = rootMeanSquare(four, all);
    EXPECT_GT(noiseOfOne, 0.05);
    // Independent noise falls with the square root; these indices are spread evenly and do no worse.
    EXPECT_LT(noiseOfFour, 0.6 * noiseOfOne);
    EXPECT_LT(rootMeanSquare(early, late), 0.25 * noiseOfOne);
    EXPECT_LT(std::abs(early.mean() - late.mean()), 0.002);
}

INSTANTIATE_TEST_SUITE_P(, AoHorizonFrames, testing::Values("hbao", "gtao", "vbao"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace crevice
