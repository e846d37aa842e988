// The faults of Unity's URP article, U2 to U10 of docs/ao/urp.md, as far as they show in the map: the form `article`
// has each as predicted, the default form has none. Bounds that only say "clearly there" keep a margin to what was
// measured.
#include "AoTwoFormsFixture.h"

namespace crevice {
namespace {

class AoUrp : public AoTwoFormsTest {
protected:
    AoUrp() : AoTwoFormsTest("urp", {"cc_ssaoMap", "cc_ssaoBlurMap"}) {}
};

/// A step of that height across the picture, on a wall `distance` away.
Scene stepScene(float height, float distance) {
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, -distance}, {0, 0, 1}, 40);
    addBox(scene, {0, 10, -distance}, {40, 20, 2 * height});
    return scene;
}

Camera frontCamera(float scale = 1) {
    Camera camera;
    camera.fovY = glm::radians(30.0f);
    camera.near = 0.1f * scale;
    camera.far = 200 * scale;
    return camera;
}

View frontView(float scale = 1) { return viewOf(frontCamera(scale), kWidth, kHeight); }

TEST_F(AoUrp, U2_LengthsAreTiedToTheIndex) {
    // Four samples have the lengths .5, .71, .87 and 1 in every pixel: averaged over pixels and seeds they do not come
    // to what many samples find beside a step. Lengths that noise moves do.
    Camera camera = frontCamera();
    camera.orthographic = true;
    camera.orthoHeight = 2.4f;
    const View view = viewOf(camera, 128, 120);
    for (const std::string quality : {"article", "high"}) {
        std::vector<double> profiles[2];
        for (int many : {0, 1}) {
            const std::string samples = many ? "20" : "4";
            for (const char* seed : {"0", "1", "2", "3"}) {
                const FloatMap ao = mapOf(quality, stepScene(0.5f, kDistance), view,
                                          {{"AoArticle.material.contrast", "1"},
                                           {"AoArticle.material.strength", "0.3"},
                                           {"AoArticle.defines.SAMPLES", samples},
                                           {"AoMain.defines.SAMPLES", samples}},
                                          {{"seed", seed}});
                // Rows below the middle are the wall at increasing distance from the step.
                profiles[many].resize(40);
                for (std::uint32_t y = 0; y < 40; ++y) profiles[many][y] += (1 - ao.rowMean(62 + y)) / 4;
            }
        }
        double off = 0, whole = 0;
        for (std::size_t y = 0; y < 40; ++y) {
            off += std::abs(profiles[0][y] - profiles[1][y]);
            whole += profiles[1][y];
        }
        RecordProperty(quality, std::to_string(off / whole));
        if (quality == "article")
            EXPECT_GT(off / whole, 0.15);
        else
            EXPECT_LT(off / whole, 0.05);
    }
}

TEST_F(AoUrp, U4_OutOfTheRadiusStillCounts) {
    // A plate half as far again as the radius: only depth is compared, and with the sample's.
    for (const std::string quality : {"article", "high"}) {
        loadForm(quality);
        renderer_->setScene(plateScene(1.5f));
        const float darkest = darkestOfWall(map(frontView()), map(frontView(), "viewDepth"));
        RecordProperty(quality, std::to_string(darkest));
        if (quality == "article")
            EXPECT_LT(darkest, 0.8f);
        else
            EXPECT_GE(darkest, 1 - kByteStep);
    }
}

TEST_F(AoUrp, U5_ReadsTheBorderForWhatIsOutside) {
    // A plane leans towards the viewer beyond the lower border: the border's own depth there is too far, beyond the
    // upper too near.
    for (const std::string quality : {"article", "high"}) {
        const FloatMap ao = mapOf(quality, leaningPlane(60), frontView());
        double border = 1;
        for (std::uint32_t y : {0u, 1u, 2u, kHeight - 1}) border = std::min(border, ao.rowMean(y));
        const double middle = ao.rowMean(kHeight / 2, kWidth / 3, kWidth * 2 / 3);
        RecordProperty(quality, std::to_string(border) + " " + std::to_string(middle));
        EXPECT_GT(middle, 0.95);
        if (quality == "article")
            EXPECT_LT(border, 0.9);
        else
            EXPECT_GE(ao.min(), 1 - kByteStep);
    }
    // Nor does a radius that reaches beyond the eye and all borders find anything there.
    EXPECT_GE(mapOf("high", leaningPlane(30), frontView(), {}, {{"radius", "20"}}).min(), 1 - kByteStep);
}

TEST_F(AoUrp, U6_BlursAcrossDepthSteps) {
    // The plate is open, the wall behind it is not; both face the viewer.
    for (const std::string quality : {"article", "high"}) {
        loadForm(quality);
        renderer_->setScene(plateScene(0.5f));
        const FloatMap raw = map(frontView()), blurred = map(frontView(), "cc_ssaoBlurMap");
        const FloatMap depth = map(frontView(), "viewDepth");
        const float rawPlate = darkestOfPlate(raw, depth), blurredPlate = darkestOfPlate(blurred, depth);
        RecordProperty(quality, std::to_string(rawPlate) + " " + std::to_string(blurredPlate));
        EXPECT_GE(rawPlate, 1 - kByteStep);
        if (quality == "article")
            EXPECT_LT(blurredPlate, 0.9f);
        else
            EXPECT_GE(blurredPlate, 1 - kByteStep);
    }
}

TEST_F(AoUrp, U7_HalfResolutionLosesEdges) {
    // How far the plate's own pixels are from open, at half resolution without any other blur.
    for (const std::string quality : {"article", "high"}) {
        if (quality == "article")
            loadForm(quality, {}, {{"downSample", "2"}, {"blur", "low"}});
        else
            loadForm(quality, {}, {{"resolution", "half"}});
        renderer_->setScene(plateScene(0.5f));
        const FloatMap blurred = map(frontView(), "cc_ssaoBlurMap"), depth = map(frontView(), "viewDepth");
        EXPECT_EQ(map(frontView()).width, kWidth / 2);
        EXPECT_EQ(blurred.width, kWidth);
        float plate = 1;
        for (std::size_t i = 0; i < blurred.values.size(); ++i)
            if (depth.values[i] < kDistance - 0.25f) plate = std::min(plate, blurred.values[i]);
        RecordProperty(quality, std::to_string(plate));
        if (quality == "article")
            EXPECT_LT(plate, 0.85f);
        else
            EXPECT_GE(plate, 1 - kByteStep);
    }
}

TEST_F(AoUrp, U9_OneSampleCanHideEverything) {
    // A shallow step, lower than a tenth of the radius: at most 3 % of the sky of the wall beside it are hidden on
    // average.
    Camera camera = frontCamera();
    camera.orthographic = true;
    camera.orthoHeight = 1.2f;
    const View view = viewOf(camera, 128, 96);
    for (const std::string quality : {"article", "high"}) {
        const FloatMap ao = mapOf(quality, stepScene(0.05f, kDistance), view, {{"AoArticle.material.beta", "0"}});
        double mean = 0;
        for (std::uint32_t y = 50; y < 80; ++y) mean += ao.rowMean(y) / 30;
        RecordProperty(quality, std::to_string(ao.min()) + " " + std::to_string(mean));
        if (quality == "article")
            EXPECT_EQ(ao.min(), 0);
        else
            EXPECT_GT(ao.min(), 0.5f);
    }
}

TEST_F(AoUrp, U9_UnitsOfLengthMatter) {
    // Epsilon and falloff are lengths of the article, however large the scene is.
    for (const std::string quality : {"article", "high"}) {
        std::vector<FloatMap> maps;
        for (float scale : {0.01f, 100.0f}) {
            loadForm(quality, {}, {{"radius", std::to_string(scale)}});
            Scene scene = leaningPlane(0, scale);
            addBox(scene, {0, 0, -kDistance * scale}, glm::vec3(1.1f, 0.9f, 1) * scale);
            renderer_->setScene(std::move(scene));
            maps.push_back(map(frontView(scale)));
        }
        RecordProperty(quality, std::to_string(meanDifference(maps[0], maps[1])));
        if (quality == "article")
            EXPECT_GT(meanDifference(maps[0], maps[1]), 0.02);
        else
            EXPECT_LE(meanDifference(maps[0], maps[1]), 0.25 * kByteStep);
    }
}

TEST_F(AoUrp, U9_StrengthMeetsTheCornerOfAWall) {
    // Averaged over the noise, seen at 45 degrees: from a fifth of the radius on.
    loadForm("reference");
    renderer_->setScene(wallScene());
    const FloatMap ao = map(viewOf(wallCamera(3), 160, 150), "cc_ssaoBlurMap");
    double before = 0;
    for (std::uint32_t row = 76; row < 140; ++row) {
        const double k = floorDistance(row, 150, 3);
        EXPECT_GE(ao.rowMean(row, 60, 100), before - 0.002) << "farther is brighter, at " << k;
        before = ao.rowMean(row, 60, 100);
        if (k > 0.18 && k < 1) {
            EXPECT_NEAR(before, exactWall(k), 0.05) << "at " << k;
        }
    }
    EXPECT_LT(ao.min(), 0.66f);
}

TEST_F(AoUrp, U10_BiasTakesDistantContactAway) {
    // The same picture of the same step, from near through a wide lens and from far through a narrow one.
    for (const std::string quality : {"article", "high"}) {
        double hidden[2];
        for (int far : {0, 1}) {
            const float distance = far ? 50.0f : 5.0f;
            Camera camera;
            camera.fovY = 2 * std::atan(0.6f / distance);
            camera.near = 0.5f;
            camera.far = 200;
            const FloatMap ao = mapOf(quality, stepScene(0.05f, distance), viewOf(camera, kWidth, kHeight));
            hidden[far] = 1 - ao.mean();
        }
        RecordProperty(quality, std::to_string(hidden[0]) + " " + std::to_string(hidden[1]));
        EXPECT_GT(hidden[0], 0.002);
        if (quality == "article")
            EXPECT_LT(hidden[1], 0.4 * hidden[0]);
        else
            EXPECT_NEAR(hidden[1], hidden[0], 0.1 * hidden[0]);
    }
}

TEST_F(AoUrp, NormalsFromDepth) {
    // Planes and a box: rebuilt normals are those of the surface but beside an edge, where five depths do best.
    Camera camera = Camera::lookAt({10, 5, 3}, {0.5f, 0.3f, 0});
    camera.fovY = glm::radians(16.0f);
    const View view = viewOf(camera, kWidth, kHeight);
    Scene scene = wallScene();
    addBox(scene, {1.2f, 0.6f, 0.3f}, {0.8f, 1.2f, 0.7f});
    for (const std::string quality : {"article", "high"}) {
        std::map<std::string, double> off;
        const FloatMap best = mapOf(quality, scene, view);
        EXPECT_LT(best.min(), 0.7f);
        for (const std::string normals : {"low", "medium", "high"})
            off[normals] = meanDifference(best, mapOf(quality, scene, view, {}, {{"normals", normals}}));
        RecordProperty(quality, std::to_string(off["low"]) + " " + std::to_string(off["medium"]) + " " +
                                    std::to_string(off["high"]));
        EXPECT_LT(off["low"], 0.02) << quality;
        EXPECT_LT(off["medium"], 0.02) << quality;
        EXPECT_GT(off["high"], 0) << quality;
        EXPECT_LT(off["high"], 0.6 * std::min(off["low"], off["medium"])) << quality;
    }
}

TEST_F(AoUrp, EveryOptionOfTheArticleChangesTheMap) {
    const Scene scene = plateScene(0.4f);
    const View view = viewOf(frontCamera(), 48, 36);
    loadForm("article");
    renderer_->setScene(scene);
    const FloatMap article = map(view, "cc_ssaoBlurMap");
    EXPECT_LT(article.min(), 0.9f);
    const Options changes[] = {{{"samples", "4"}},   {{"samples", "12"}}, {{"noise", "blue"}},
                               {{"blur", "medium"}}, {{"blur", "low"}},   {{"seed", "2"}}};
    for (const Options& change : changes) {
        loadForm("article", {}, change);
        renderer_->setScene(scene);
        EXPECT_GT(meanDifference(article, map(view, "cc_ssaoBlurMap")), 1e-3) << change.begin()->second;
    }
    for (const StageSet& set : Sets{{"AoArticle.material.strength", "1"},
                                    {"AoArticle.material.contrast", "1"},
                                    {"AoArticle.material.falloff", "8"},
                                    {"AoArticle.material.beta", "0.03"},
                                    {"AoArticle.material.epsilon", "0.3"}})
        EXPECT_GT(meanDifference(mapOf("article", scene, view), mapOf("article", scene, view, {set})), 1e-3)
            << set.path;
}

TEST_F(AoUrp, EveryOptionOfTheDefaultFormChangesTheMap) {
    const Scene scene = plateScene(0.4f);
    const View view = viewOf(frontCamera(), 48, 36);
    const FloatMap before = mapOf("high", scene, view);
    for (const Options& change : {Options{{"radial", "sqrt"}}, Options{{"radial", "cbrt"}},
                                  Options{{"radial", "quadratic"}}, Options{{"seed", "2"}}})
        EXPECT_GT(meanDifference(before, mapOf("high", scene, view, {}, change)), 1e-3) << change.begin()->second;
    for (const StageSet& set :
         Sets{{"AoMain.material.strength", "0.5"}, {"AoMain.material.beta", "100"}, {"AoMain.material.epsilon", "0.3"}})
        EXPECT_GT(meanDifference(before, mapOf("high", scene, view, {set})), 1e-3) << set.path;
}

TEST_F(AoUrp, FramesTakeNoiseAway) {
    // Rows along a step differ by noise alone.
    const View view = viewOf(wallCamera(3), 96, 90);
    double variance[2];
    for (int many : {0, 1}) {
        const FloatMap ao = mapOf("fast", wallScene(), view, {}, {{"temporalFrames", many ? "16" : "1"}});
        variance[many] = ao.rowVariance(ao.height * 5 / 8);
    }
    EXPECT_GT(variance[0], 1e-4);
    EXPECT_LT(variance[1], variance[0] / 8);
}

TEST_F(AoUrp, BlueNoiseHasNoLowFrequencies) {
    // Means of 8 x 8 windows of the tile differ less than those of independent numbers would: .29 / 8.
    loadForm("article", {}, {{"noise", "blue"}});
    renderer_->setScene(plateScene(0.4f));
    const FloatMap tile = map(frontView(), "urpBlueNoise");
    ASSERT_EQ(tile.width, 32u);
    EXPECT_NEAR(tile.mean(), 0.5, 0.01);
    double squares = 0;
    for (std::uint32_t y = 0; y < 32; y += 8)
        for (std::uint32_t x = 0; x < 32; x += 8) {
            double sum = 0;
            for (std::uint32_t i = 0; i < 64; ++i) sum += tile.at(x + i % 8, y + i / 8);
            squares += (sum / 64 - 0.5) * (sum / 64 - 0.5) / 16;
        }
    RecordProperty("deviation", std::to_string(std::sqrt(squares)));
    EXPECT_LT(std::sqrt(squares), 0.012);
}

}  // namespace
}  // namespace crevice
