// The faults of the article of songjihu, S1 to S9 of docs/ao/songjihu.md, as far as they show in the map: the form
// `article` has each as predicted, the default form has none. Bounds that only say "clearly there" keep a margin to
// what was measured.
#include <set>

#include "AoTwoFormsFixture.h"

namespace crevice {
namespace {

// Mean of the weight by direction over the kernel and the noise tile, on a plane of any tilt.
constexpr double kMeanWeight = 0.64;

class AoSongjihu : public AoTwoFormsTest {
protected:
    AoSongjihu() : AoTwoFormsTest("songjihu", {"cc_ssaoMap", "cc_ssaoBlurMap", "songjihuBlurX", "songjihuBlurY"}) {}
};

/// Range and bias of the article out of the way: everything nearer occludes.
std::vector<StageSet> everythingNearer() {
    return {{"AoArticle.material.rangeStrength", "1"}, {"AoArticle.material.depthBias", "0"}};
}

Camera frontCamera(float near = 0.1f, float far = 100, float degrees = 30) {
    Camera camera;
    camera.fovY = glm::radians(degrees);
    camera.near = near;
    camera.far = far;
    return camera;
}

View frontView(const Camera& camera = frontCamera()) { return viewOf(camera, kWidth, kHeight); }

TEST_F(AoSongjihu, S1_ComparesWithTheFragment) {
    // On a plane that leans by an angle, the share of the hemisphere that appears on the nearer side of the fragment is
    // 1/2 - angle / 180 degrees: all of it occludes, half of what the weights let through where the plane leans little.
    for (float degrees : {6.0f, 12.0f, 45.0f}) {
        const double predicted = 1 - kMeanWeight * (0.5 - double(degrees) / 180);
        const double mean = mapOf("article", leaningPlane(degrees), frontView(), everythingNearer()).mean();
        RecordProperty("mean" + std::to_string(int(degrees)), std::to_string(mean - predicted));
        EXPECT_NEAR(mean, predicted, 0.05) << degrees;
        EXPECT_GE(mapOf("high", leaningPlane(degrees), frontView()).min(), 1 - kByteStep) << degrees;
        const FloatMap wide = mapOf("high", leaningPlane(degrees), frontView(), {}, {{"radius", "20"}});
        EXPECT_GE(wide.min(), 1 - kByteStep) << degrees << ", radius beyond the eye";
    }
}

TEST_F(AoSongjihu, S2_RangeAndBiasFollowTheFarPlane) {
    for (const std::string quality : {"article", "high"}) {
        const Sets sets = {{"AoArticle.material.rangeStrength", "0.002"}, {"AoArticle.material.depthBias", "0"}};
        const FloatMap near = mapOf(quality, plateScene(0.5f), frontView(frontCamera(0.1f, 50)), sets);
        const FloatMap far = mapOf(quality, plateScene(0.5f), frontView(frontCamera(0.1f, 5000)), sets);
        RecordProperty(quality, std::to_string(meanDifference(near, far)));
        EXPECT_LT(far.min(), 0.8f);
        if (quality == "article")
            EXPECT_GT(meanDifference(near, far), 0.02);
        else
            EXPECT_LE(meanDifference(near, far), 0.1 * kByteStep);
    }
}

TEST_F(AoSongjihu, S3_RangeIsCutHard) {
    // The range is .5 world units in both forms. A plate that crosses it by a hundredth switches the article's shadow
    // off.
    const Sets sets = {{"AoArticle.material.rangeStrength", "0.005"},
                       {"AoArticle.material.depthBias", "0"},
                       {"AoMain.material.rangeStrength", "0.5"}};
    for (const std::string quality : {"article", "high"}) {
        float darkest[2];
        for (int beyond : {0, 1}) {
            loadForm(quality, sets);
            renderer_->setScene(plateScene(beyond ? 0.505f : 0.495f));
            darkest[beyond] = darkestOfWall(map(frontView()), map(frontView(), "viewDepth"));
        }
        RecordProperty(quality, std::to_string(darkest[1] - darkest[0]));
        if (quality == "article")
            EXPECT_GT(darkest[1] - darkest[0], 0.15f);
        else
            EXPECT_LT(darkest[1] - darkest[0], 0.03f);
    }
}

TEST_F(AoSongjihu, S4_CannotHideEverything) {
    // The bottom of a narrow shaft, deeper than the longest sample: everything around it is nearer.
    Scene scene = leaningPlane(0);
    for (float side : {-1.0f, 1.0f}) {
        addBox(scene, {side * 1.53f, 0, -kDistance + 0.9f}, {3, 6, 1.8f});
        addBox(scene, {0, side * 1.53f, -kDistance + 0.9f}, {6, 3, 1.8f});
    }
    Camera camera = frontCamera();
    camera.orthographic = true;
    camera.orthoHeight = 2;
    const View view = viewOf(camera, 144, 144);
    for (const std::string quality : {"article", "high"}) {
        Sets sets = everythingNearer();
        sets.push_back({"AoMain.material.rangeStrength", "16"});
        const FloatMap ao = mapOf(quality, scene, view, sets);
        const double bottom = (ao.at(71, 71) + ao.at(72, 71) + ao.at(71, 72) + ao.at(72, 72)) / 4;
        RecordProperty(quality, std::to_string(bottom));
        if (quality == "article")
            EXPECT_GT(bottom, 1 - kMeanWeight - 0.05);
        else
            EXPECT_LT(bottom, 0.05);
    }
}

TEST_F(AoSongjihu, S5_NoiseTurnsByOneQuadrantOnly) {
    // A ledge to the left or to the right of the same floor: few points that turn by less than a full turn tell them
    // apart.
    Camera camera = frontCamera();
    camera.orthographic = true;
    camera.orthoHeight = 3;
    const View view = viewOf(camera, 128, 96);
    for (const std::string quality : {"article", "fast"}) {
        double means[2];
        for (int right : {0, 1}) {
            Scene scene = leaningPlane(0);
            addBox(scene, {right ? 2.3f : -2.3f, 0, -kDistance}, {4, 20, 1});
            Sets sets = everythingNearer();
            sets.push_back({"AoArticle.defines.SAMPLES", "4"});
            means[right] = 0;
            for (const char* seed : {"0", "1", "2", "3"})
                means[right] += mapOf(quality, scene, view, sets, {{"resolution", "full"}, {"seed", seed}}).mean() / 4;
        }
        RecordProperty(quality, std::to_string(means[0]) + " " + std::to_string(means[1]));
        const double ratio = (1 - means[1]) / (1 - means[0]);
        if (quality == "article")
            EXPECT_GT(std::abs(ratio - 1), 0.3);
        else
            EXPECT_LT(std::abs(ratio - 1), 0.01);
    }
}

TEST_F(AoSongjihu, S6_DividesByClipZ) {
    // With near .3 and far 10 uv is scaled by (10 - .3) / (10 + .3) about the middle of the picture: 6 %. On a leaning
    // plane samples shorter than that read, in the upper part, what is nearer throughout; in the lower what is farther.
    constexpr std::uint32_t kRows = 288;
    for (const std::string quality : {"article", "high"}) {
        for (float near : {0.3f, 0.003f}) {
            const FloatMap ao = mapOf(quality, leaningPlane(45), viewOf(frontCamera(near, 10), 48, kRows),
                                      everythingNearer(), {{"radius", "0.045"}});
            const double above = ao.rowMean(kRows / 8), below = ao.rowMean(kRows - 1 - kRows / 8);
            RecordProperty(quality + std::to_string(near), std::to_string(above) + " " + std::to_string(below));
            if (quality == "high") {
                EXPECT_GE(ao.min(), 1 - kByteStep);
            } else if (near == 0.3f) {
                EXPECT_LT(above, 1 - kMeanWeight + 0.05);
                EXPECT_GT(below, 0.99);
            } else {
                // Without the shift both are as S1 says, but for the samples that read their own pixel: more of them
                // far away.
                EXPECT_NEAR(above, below, 0.15);
                EXPECT_NEAR((above + below) / 2, 1 - kMeanWeight * 0.25, 0.1);
            }
        }
    }
}

TEST_F(AoSongjihu, S7_DepthAndNormalsAreCoarse) {
    // A slope of a thousandth: 16 bits of depth up to 1000 make steps of 15 mm, which the article takes for edges.
    const float slope = glm::degrees(0.001f);
    const Camera camera = frontCamera(0.1f, 1000);
    std::map<std::string, std::size_t> steps;
    for (const std::string quality : {"article", "high"}) {
        const FloatMap ao = mapOf(quality, leaningPlane(slope * 8), frontView(camera), everythingNearer());
        std::set<int> rows;
        for (std::uint32_t y = 0; y < kHeight; ++y) rows.insert(int(std::lround(ao.rowMean(y) * 50)));
        steps[quality] = rows.size();
    }
    RecordProperty("article", std::to_string(steps["article"]));
    EXPECT_GE(steps["article"], 6u) << "bands along the steps";
    EXPECT_EQ(steps["high"], 1u);
}

TEST_F(AoSongjihu, S9_BlursAcrossDepthSteps) {
    // The plate is open, the wall behind it is not; both face the viewer.
    const Scene scene = plateScene(0.5f);
    for (const std::string quality : {"article", "high"}) {
        loadForm(quality, {{"AoArticle.material.rangeStrength", "1"},
                           {"AoArticleBlurX.material.blurRadius", "2"},
                           {"AoArticleBlurY.material.blurRadius", "2"}});
        renderer_->setScene(scene);
        const FloatMap raw = map(frontView()), blurred = map(frontView(), "cc_ssaoBlurMap");
        const FloatMap depth = map(frontView(), "viewDepth");
        const float rawPlate = darkestOfPlate(raw, depth), blurredPlate = darkestOfPlate(blurred, depth);
        RecordProperty(quality, std::to_string(rawPlate) + " " + std::to_string(blurredPlate));
        EXPECT_GE(rawPlate, 1 - kByteStep);
        if (quality == "article")
            EXPECT_LT(blurredPlate, 0.95f);
        else
            EXPECT_GE(blurredPlate, 1 - kByteStep);
    }
}

TEST_F(AoSongjihu, FramesTakeNoiseAway) {
    // Rows along a step differ by noise alone.
    const View view = viewOf(wallCamera(3), 96, 90);
    double variance[2];
    for (int many : {0, 1}) {
        const FloatMap ao = mapOf("fast", wallScene(), view, {}, {{"temporalFrames", many ? "64" : "1"}});
        variance[many] = ao.rowVariance(ao.height * 5 / 8);
    }
    EXPECT_GT(variance[0], 1e-4);
    EXPECT_LT(variance[1], variance[0] / 8);
}

TEST_F(AoSongjihu, DownSamplesTheArticle) {
    const Scene scene = plateScene(0.5f);
    for (const char* factor : {"1", "2", "4"}) {
        loadForm("article", {}, {{"downSample", factor}});
        renderer_->setScene(scene);
        const std::uint32_t n = static_cast<std::uint32_t>(std::stoi(factor));
        EXPECT_EQ(map(frontView()).width, kWidth / n);
        EXPECT_EQ(map(frontView()).height, kHeight / n);
        EXPECT_EQ(map(frontView(), "cc_ssaoBlurMap").width, kWidth);
        // The default form keeps the resolution of its quality.
        loadForm("high", {}, {{"downSample", factor}});
        renderer_->setScene(scene);
        EXPECT_EQ(map(frontView()).width, kWidth);
    }
}

TEST_F(AoSongjihu, EveryOptionChangesTheMap) {
    const Scene scene = plateScene(1.2f);
    const View view = viewOf(frontCamera(), 48, 36);
    const FloatMap before = mapOf("high", scene, view);
    EXPECT_LT(before.min(), 0.9f);
    const Options changes[] = {{{"kernel", "article"}},  {{"kernel", "cosine"}},     {{"rangeCheck", "off"}},
                               {{"rangeCheck", "hard"}}, {{"rangeCheck", "smooth"}}, {{"strength", "0.5"}},
                               {{"sampleCount", "8"}},   {{"pattern", "tile4"}},     {{"seed", "3"}}};
    for (const Options& change : changes)
        EXPECT_GT(meanDifference(before, mapOf("high", scene, view, {}, change)), 1e-4) << change.begin()->first;
    for (const std::string property : {"reach", "rangeStrength"})
        EXPECT_GT(meanDifference(before, mapOf("high", scene, view, {{"AoMain.material." + property, "0.4"}})), 1e-4)
            << property;
    const FloatMap article = mapOf("article", scene, view, everythingNearer());
    EXPECT_LT(article.min(), 0.9f);
    for (const Options& change : {Options{{"strength", "2"}}, Options{{"sampleCount", "16"}}})
        EXPECT_GT(meanDifference(article, mapOf("article", scene, view, everythingNearer(), change)), 1e-4)
            << change.begin()->first;
}

}  // namespace
}  // namespace crevice
