// Where surfaces meet it is darker: by how much, how far, and how that compares with the exact value.
#include "AoFixture.h"
#include "stages/SsaoKernel.h"

namespace crevice {
namespace {

constexpr float kHeight = 4;  // world units that the frame sees; the radius is 1
constexpr std::uint32_t kColumns = 48, kRows = 160;

/// The kernel itself: no exponent.
std::vector<StageSet> plain(std::vector<StageSet> more = {}) {
    std::vector<StageSet> sets = {{"SsaoStage.material.radius", "1"}, {"SsaoStage.material.power", "1"}};
    sets.insert(sets.end(), more.begin(), more.end());
    return sets;
}

std::uint32_t rowAtDistance(float distance) {
    std::uint32_t best = 0;
    for (std::uint32_t row = 0; row < kRows; ++row) {
        if (std::abs(floorDistance(row, kRows, kHeight) - distance) <
            std::abs(floorDistance(best, kRows, kHeight) - distance))
            best = row;
    }
    return best;
}

class AoCrease : public AoTest {};

TEST_F(AoCrease, WallsFootDarkensTheFloorLessAndLess) {
    loadMap("default", plain());
    renderer_->setScene(wallScene());
    const FloatMap ao = map(viewOf(wallCamera(kHeight), kColumns, kRows));
    double before = 0;
    for (float distance = 0.05f; distance < 1.2f; distance += 0.1f) {
        const double here = ao.rowMean(rowAtDistance(distance));
        EXPECT_GE(here, before - 0.004) << distance;  // .004: what is left of the noise in the mean of a row
        before = here;
    }
    EXPECT_LT(ao.rowMean(rowAtDistance(0.05f)), 0.75);
    EXPECT_EQ(ao.rowMean(rowAtDistance(1.2f)), 1);
}

TEST_F(AoCrease, CornerIsDarkerThanWall) {
    loadMap("default", plain());
    Camera camera = Camera::lookAt({6, 6, 6}, {0.2f, 0, 0.2f});
    camera.orthographic = true;
    camera.orthoHeight = 2;
    const View view = viewOf(camera, 64, 64);
    renderer_->setScene(wallScene());
    const FloatMap walls = map(view);
    renderer_->setScene(cornerScene());
    const FloatMap corner = map(view);
    double cornerMean = 0, wallMean = 0;
    for (std::uint32_t y = 28; y < 36; ++y)
        for (std::uint32_t x = 28; x < 36; ++x) cornerMean += corner.at(x, y), wallMean += walls.at(x, y);
    RecordProperty("corner", std::to_string(cornerMean / 64));
    RecordProperty("wall", std::to_string(wallMean / 64));
    EXPECT_LT(cornerMean, wallMean - 64 * 0.1);
    EXPECT_LT(wallMean, 64 * 0.95);
}

TEST_F(AoCrease, FewSamplesShowWhatManyShow) {
    std::vector<double> means;
    for (const char* samples : {"64", "32", "16", "8"}) {
        loadMap("default", plain({{"SsaoStage.params.samples", samples}}));
        renderer_->setScene(wallScene());
        means.push_back(map(viewOf(wallCamera(1.2f), 48, 48)).mean());
    }
    EXPECT_LT(means[0], 0.97);
    for (std::size_t i = 1; i < means.size(); ++i) EXPECT_NEAR(means[i], means[0], 0.04) << i;
}

/// What the estimator tends to as samples and seeds grow: for every direction (cosine-weighted, on a fine grid) and
/// every length of the ladder, is the sample inside the wall, and how much does the wall that the camera sees there
/// weigh?
double infiniteSampleLimit(double k) {
    constexpr int kDirections = 128, kLengths = 64;
    const glm::dvec2 view(0.70710678, 0.70710678);  // of wallCamera(): towards the wall, and down
    double occlusion = 0;
    for (int i = 0; i < kDirections; ++i) {
        for (int j = 0; j < kDirections; ++j) {
            const double r = std::sqrt((i + 0.5) / kDirections * (1 - 0.05 * 0.05));
            const double towards = r * std::cos(6.283185307179586 * (j + 0.5) / kDirections);
            const double up = std::sqrt(1 - r * r);
            for (int n = 0; n < kLengths; ++n) {
                const double t = (n + 0.5) / kLengths;
                const double length = 0.1 + 0.9 * t * t;
                const double depthInWall = towards * length - k;
                if (depthInWall <= 0) continue;
                // Back along the view ray to the wall: how far is that in front of the surface at the pixel?
                const double sampleDepth = towards * length * view.x - up * length * view.y;
                const double inFront = depthInWall / view.x - sampleDepth;
                occlusion += std::clamp((1 - inFront) / 0.5, 0.0, 1.0);
            }
        }
    }
    return 1 - occlusion / (double(kDirections) * kDirections * kLengths);
}

TEST_F(AoCrease, MeanOfManySeedsIsItsOwnLimit) {
    const std::uint32_t rows[] = {rowAtDistance(0.2f), rowAtDistance(0.5f)};
    double means[2] = {};
    constexpr int kSeeds = 16;
    renderer_->setScene(wallScene());
    for (int seed = 0; seed < kSeeds; ++seed) {
        loadMap("default", plain({{"SsaoStage.params.seed", std::to_string(seed)}, {"SsaoStage.params.bake", "off"}}));
        const FloatMap ao = map(viewOf(wallCamera(kHeight), kColumns, kRows));
        for (int i = 0; i < 2; ++i) means[i] += ao.rowMean(rows[i], 12, 36) / kSeeds;
    }
    for (int i = 0; i < 2; ++i) {
        const double k = floorDistance(rows[i], kRows, kHeight);
        EXPECT_NEAR(means[i], infiniteSampleLimit(k), 0.02) << k;
    }
}

TEST_F(AoCrease, DefaultPowerComesCloserToTheExactWall) {
    auto error = [&](std::vector<StageSet> sets) {
        loadMap("default", std::move(sets));
        renderer_->setScene(wallScene());
        const FloatMap ao = map(viewOf(wallCamera(kHeight), kColumns, kRows));
        double sum = 0;
        int rows = 0;
        for (std::uint32_t row = 0; row < kRows; ++row) {
            const float k = floorDistance(row, kRows, kHeight);
            if (k <= 0 || k >= 1) continue;
            sum += std::pow(ao.rowMean(row) - exactWall(k), 2);
            ++rows;
        }
        return std::sqrt(sum / rows);
    };
    const double raw = error(plain());
    const double shipped = error({{"SsaoStage.material.radius", "1"}});
    EXPECT_GT(raw, 0.13);
    EXPECT_LT(shipped, 0.115);
    RecordProperty("rmse_power_1", std::to_string(raw));
    RecordProperty("rmse_default", std::to_string(shipped));
}

}  // namespace
}  // namespace crevice
