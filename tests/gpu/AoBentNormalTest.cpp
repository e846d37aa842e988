// Bent normals of gtao and vbao: the normal where all is open, away from a wall beside it, and the mean direction that
// geometry says.
#include "AoHorizonFixture.h"

namespace crevice {
namespace {

constexpr double kPi = 3.14159265358979;
constexpr std::uint32_t kWidth = 120, kHeight = 90;

class AoBentNormal : public AoHorizonTest, public testing::WithParamInterface<const char*> {
protected:
    void loadBent(const std::string& quality, float radius = 1) {
        Options options{{"bentNormals", "true"}, {"quality", quality}};
        if (std::string(GetParam()) == "vbao") options["thickness"] = "4";
        loadSlices(GetParam(), radius, options);
    }
};

TEST_P(AoBentNormal, OpenPlaneKeepsItsNormal) {
    loadBent("high");
    const glm::vec3 normal = glm::normalize(glm::vec3(0.2f, 0.5f, 0.8f));
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, normal, 100);
    renderer_->setScene(std::move(scene));
    for (bool orthographic : {true, false}) {
        const View view = viewOf(cameraTowards({0.3f, 0.1f, 1}, {0, 0, 0}, 4, orthographic), kWidth, kHeight);
        const Image bent = targets(view, {"cc_bentNormalMap"})[0];
        for (std::uint32_t y = 0; y < kHeight; ++y)
            for (std::uint32_t x = 0; x < kWidth; ++x)
                ASSERT_LT(glm::distance(glm::vec3(bent.at(x, y)), normal), 1e-2f) << x << ' ' << y;
    }
}

TEST_P(AoBentNormal, SkyHasNone) {
    loadBent("high");
    Scene scene = emptyScene();
    addBox(scene, {0, 0, 0}, {1, 1, 1});
    renderer_->setScene(std::move(scene));
    const std::vector<Image> images =
        targets(viewOf(cameraTowards({0.5f, 0.6f, 1}, {0, 0, 0}, 4, false), kWidth, kHeight),
                {"cc_bentNormalMap", "viewDepth"});
    int sky = 0, surface = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const bool isSky = images[1].at(x, y).x > 1e8f;
            ++(isSky ? sky : surface);
            ASSERT_NEAR(glm::length(glm::vec3(images[0].at(x, y))), isSky ? 0 : 1, 2e-3);
        }
    EXPECT_GT(sky, 500);
    EXPECT_GT(surface, 500);
}

TEST_P(AoBentNormal, FloorBesideAWallLeansAwayFromIt) {
    loadBent("reference");
    renderer_->setScene(wallScene());
    for (bool orthographic : {true, false}) {
        const View view = viewOf(cameraTowards({1, 1, 0}, {0, 0, 0}, 4, orthographic), kWidth, kHeight);
        const std::vector<Image> images = targets(view, {"cc_bentNormalMap", "cc_gbuffer_positionMap"});
        glm::dvec3 sum(0);
        int count = 0;
        for (std::uint32_t y = kHeight / 4; y < 3 * kHeight / 4; ++y)
            for (std::uint32_t x = kWidth / 4; x < 3 * kWidth / 4; ++x) {
                const glm::vec3 p(images[1].at(x, y));
                if (p.y > 1e-3f || std::abs(p.x - 0.3f) > 0.05f) continue;
                sum += glm::dvec3(glm::vec3(images[0].at(x, y)));
                ++count;
            }
        ASSERT_GT(count, 50);
        const glm::dvec3 mean = glm::normalize(sum);
        // Hidden are the directions of sine x towards the wall above k, seen as a disc: what is left of the disc's
        // integral of (x, z), z the height over it.
        constexpr double k = 0.3;
        double away = 0, up = 2 * kPi / 3;
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i) {
            const double x = k + (1 - k) * (i + 0.5) / kSteps, half = std::sqrt(1 - x * x);
            away += x * 2 * half * (1 - k) / kSteps;
            up -= kPi / 2 * half * half * (1 - k) / kSteps;
        }
        const glm::dvec3 expected = glm::normalize(glm::dvec3(away, up, 0));
        EXPECT_GT(expected.x, 0.2);
        EXPECT_LT(glm::distance(mean, expected), 0.03) << mean.x << ' ' << mean.y << ' ' << mean.z;
    }
}

INSTANTIATE_TEST_SUITE_P(, AoBentNormal, testing::Values("gtao", "vbao"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace crevice
