// crytek: the article's form shows what a ball of points must show, the default form does not (docs/ao/crytek.md).
#include "AoKernelFixture.h"

namespace crevice {
namespace {

using AoCrytek = AoKernelTest;

double meanOfSeeds(const std::vector<FloatMap>& maps) {
    double sum = 0;
    for (const FloatMap& one : maps) sum += one.mean() / static_cast<double>(maps.size());
    return sum;
}

TEST_F(AoCrytek, AFlatWallIsHalfDark) {
    // Half of the ball lies behind any plane: exactly 1/2 at every tilt and in both projections.
    for (float degrees : {0.0f, 55.0f}) {
        for (bool orthographic : {false, true}) {
            Camera camera = alongZ(30, 8);
            camera.orthographic = orthographic;
            camera.orthoHeight = 4;
            const View view = viewOf(camera, 48, 36);
            std::vector<FloatMap> articles;
            for (int seed = 0; seed < 4; ++seed)
                articles.push_back(rawMap("crytek", "article", leaningPlane(degrees), view,
                                          {{"AoArticle.params.seed", std::to_string(seed)}},
                                          {{"seed", std::to_string(seed)}}));
            EXPECT_NEAR(meanOfSeeds(articles), 0.5, 0.02) << degrees;
            EXPECT_GE(rawMap("crytek", "high", leaningPlane(degrees), view).min(), 1 - kByteStep) << degrees;
        }
    }
}

TEST_F(AoCrytek, AWallsFootHasTheVolumeOfTheBallThatIsFree) {
    // Beside a wall at k radii: half of the ball, less half of the cap beyond the wall, (2 - 3k + k³)/4 of the ball.
    const std::vector<float> distances = {0.1f, 0.3f, 0.5f, 0.8f};
    const std::vector<double> article = besideWall("crytek", "article", distances);
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const double k = distances[i];
        EXPECT_NEAR(article[i], 0.5 * (1 - (2 - 3 * k + k * k * k) / 4), 0.015) << k;
    }
    // The default form is nearer to what is true there, everywhere.
    const std::vector<double> remedied = besideWall("crytek", "ultra", distances, {}, 4);
    for (std::size_t i = 0; i < distances.size(); ++i) {
        EXPECT_LT(std::abs(remedied[i] - exactWall(distances[i])), 0.5 * std::abs(article[i] - exactWall(distances[i])))
            << distances[i] << ": " << remedied[i];
    }
}

TEST_F(AoCrytek, EdgesThatStandOutShine) {
    // A quarter of the ball is solid at a right-angled edge: 3/4 is brighter than the flat wall's 1/2.
    Scene scene = emptyScene();
    addBox(scene, {-10, -10, 0}, {20, 20, 20});  // its edge x = 0, y = 0
    const View view = viewOf(wallCamera(6), 48, 90);
    double atEdge = 0, away = 0;
    for (int seed = 0; seed < 8; ++seed) {
        const FloatMap article =
            rawMap("crytek", "article", scene, view, {{"AoArticle.params.seed", std::to_string(seed)}},
                   {{"seed", std::to_string(seed)}});
        atEdge += (article.rowMean(44, 16, 32) + article.rowMean(45, 16, 32)) / 16;
        away += article.rowMean(27, 16, 32) / 8;
    }
    EXPECT_NEAR(atEdge, 0.75, 0.03);
    EXPECT_NEAR(away, 0.5, 0.03);
    EXPECT_GE(rawMap("crytek", "high", scene, view).min(), 1 - kByteStep);
}

TEST_F(AoCrytek, WhatIsFarInFrontDarkens) {
    // Beside the silhouette of a plate ten radii in front, nearly every point of the ball but those in the open half is
    // hidden.
    const View view = viewOf(parallelAlongZ(4), 64, 48);
    const FloatMap article = rawMap("crytek", "article", halfPlate(5), view);
    const FloatMap remedied = rawMap("crytek", "high", halfPlate(5), view);
    double beside = 0;
    for (std::uint32_t y = 0; y < 48; ++y) beside += article.at(32, y) / 48.0;
    // At the silhouette half of the ball is before the plate's half of the picture: 1/2 of it plus half of the rest.
    EXPECT_NEAR(beside, 0.25, 0.04);
    for (std::uint32_t y = 0; y < 48; ++y)
        for (std::uint32_t x = 32; x < 64; ++x) ASSERT_GE(remedied.at(x, y), 1 - kByteStep) << x;
}

TEST_F(AoCrytek, FormsTakeNoNormalsAndNormals) {
    loadTechnique("crytek", "article");
    renderer_->setScene(wallScene());
    EXPECT_FALSE(stageReads("AoArticle", "cc_gbuffer_normalMap"));
    EXPECT_TRUE(stageReads("AoMain", "cc_gbuffer_normalMap"));
    EXPECT_TRUE(useOf("AoArticleBlur").enabled);
    EXPECT_FALSE(useOf("AoMain").enabled || useOf("AoResolve").enabled);
}

}  // namespace
}  // namespace crevice
