// How deep things are: BackFaceStage finds the next back surface, and vbao takes it where there is one.
#include "AoHorizonFixture.h"

namespace crevice {
namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 72;
constexpr float kWall = 6;     // distance of the wall along the camera's axis
constexpr float kNone = 1e8f;  // cleared values lie above

Camera straightAhead(bool orthographic = true) {
    Camera camera;
    camera.orthographic = orthographic;
    camera.orthoHeight = 3;
    camera.fovY = 0.5f;
    camera.near = 0.1f;
    camera.far = 50;
    return camera;
}

class AoBackFaces : public AoHorizonTest {
protected:
    void loadBackFaces(float radius = 1, Options more = {}) {
        more["backFaces"] = "true";
        loadSlices("vbao", radius, more);
    }
    /// The white material of emptyScene(), one-sided.
    static Scene oneSidedScene() {
        Scene scene = emptyScene();
        scene.materials[0].doubleSided = false;
        return scene;
    }
    static float centre(const Image& image) { return image.at(kWidth / 2, kHeight / 2).x; }
    float backDepthInTheMiddle(Scene scene, bool orthographic = true) {
        renderer_->setScene(std::move(scene));
        return centre(targets(viewOf(straightAhead(orthographic), kWidth, kHeight), {"backDepth"})[0]);
    }
};

TEST_F(AoBackFaces, NextBackSurfaceBehindWhatIsSeen) {
    loadBackFaces();
    for (bool orthographic : {true, false}) {
        Scene scene = oneSidedScene();
        addBox(scene, {0, 0, -3}, {1, 1, 0.4f});
        addBox(scene, {0, 0, -5}, {1, 1, 1});  // its back is farther
        addSquare(scene, {0, 0, -kWall}, {0, 0, 1}, 20);
        renderer_->setScene(std::move(scene));
        const std::vector<Image> images =
            targets(viewOf(straightAhead(orthographic), kWidth, kHeight), {"viewDepth", "backDepth"});
        EXPECT_NEAR(centre(images[0]), 2.8f, 1e-3f);
        EXPECT_NEAR(centre(images[1]), 3.2f, 1e-3f);
        // Beside the boxes the wall is seen, which has no back.
        EXPECT_NEAR(images[0].at(2, 2).x, kWall, 1e-3f);
        EXPECT_GT(images[1].at(2, 2).x, kNone);
    }
}

TEST_F(AoBackFaces, BacksThatAreInFrontOfWhatIsSeenDoNotCount) {
    loadBackFaces();
    // An open back face before the box: culled from the picture, so the box is what is seen.
    Scene scene = oneSidedScene();
    addSquare(scene, {0, 0, -2}, {0, 0, -1}, 2);
    addBox(scene, {0, 0, -3}, {1, 1, 0.4f});
    EXPECT_NEAR(backDepthInTheMiddle(std::move(scene)), 3.2f, 1e-3f);
}

TEST_F(AoBackFaces, TwoSidedSheetsAreNoBacksOfThemselves) {
    loadBackFaces();
    for (float side : {1.0f, -1.0f}) {
        Scene scene = emptyScene();
        addSquare(scene, {0, 0, -3}, {0, 0, side}, 2);
        EXPECT_GT(backDepthInTheMiddle(std::move(scene)), kNone) << side;
    }
    // The front of a second sheet does not close a body either.
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, -3}, {0, 0, 1}, 2);
    addSquare(scene, {0, 0, -4}, {0, 0, 1}, 2);
    EXPECT_GT(backDepthInTheMiddle(std::move(scene)), kNone);
}

TEST_F(AoBackFaces, HolesOfCutOutMaterialsAreOpen) {
    loadBackFaces();
    for (float alpha : {0.2f, 0.8f}) {
        Scene scene = oneSidedScene();
        SceneMaterial cutOut = scene.materials[0];
        cutOut.alphaMode = AlphaMode::Mask;
        cutOut.baseColor.a = alpha;
        scene.materials.push_back(cutOut);
        addSquare(scene, {0, 0, -3}, {0, 0, 1}, 2);
        addSquare(scene, {0, 0, -3.5f}, {0, 0, -1}, 2, 1);
        const float back = backDepthInTheMiddle(std::move(scene));
        if (alpha < 0.5f)
            EXPECT_GT(back, kNone);
        else
            EXPECT_NEAR(back, 3.5f, 1e-3f);
    }
}

TEST_F(AoBackFaces, ThinBoxDarkensTheWallBehindLessAndThickOneAsMuch) {
    // A bar before a wall: its true depth is far from the constant thickness, to either side.
    const auto darkness = [&](float depth, bool backFaces) {
        // A constant between the two depths.
        Options options{{"quality", "ultra"}, {"thickness", "0.25"}};
        if (backFaces)
            loadBackFaces(1, options);
        else
            loadSlices("vbao", 1, options);
        Scene scene = oneSidedScene();
        constexpr float kFront = kWall - 0.8f;
        addBox(scene, {0, 0, -(kFront + depth / 2)}, {0.3f, 20, depth});
        addSquare(scene, {0, 0, -kWall}, {0, 0, 1}, 20);
        renderer_->setScene(std::move(scene));
        const std::vector<Image> images =
            targets(viewOf(straightAhead(), kWidth, kHeight), {"cc_ssaoMap", "viewDepth"});
        double sum = 0, count = 0;
        for (std::uint32_t y = 0; y < kHeight; ++y)
            for (std::uint32_t x = 0; x < kWidth; ++x) {
                if (images[1].at(x, y).x < kWall - 0.01f) continue;
                sum += 1 - images[0].at(x, y).x;
                ++count;
            }
        return sum / count;
    };
    const double thin = darkness(0.05f, true), constant = darkness(0.05f, false), thick = darkness(0.8f, true);
    EXPECT_GT(constant, 0.02);
    EXPECT_LT(thin, 0.6 * constant);
    EXPECT_GT(thick, 1.1 * constant);
}

TEST_F(AoBackFaces, KnownBacksLeaveNothingToTheConstantThickness) {
    // How deep things of unknown depth are, and how many of them have no back, is nothing to a bar of known depth.
    std::vector<double> darkness;
    for (const char* thickness : {"0.25", "0.5"}) {
        loadBackFaces(1, {{"quality", "ultra"}, {"thickness", thickness}});
        Scene scene = oneSidedScene();
        addBox(scene, {0, 0, -(kWall - 0.4f)}, {0.3f, 20, 0.8f});
        addSquare(scene, {0, 0, -kWall}, {0, 0, 1}, 20);
        renderer_->setScene(std::move(scene));
        darkness.push_back(1 - map(viewOf(straightAhead(), kWidth, kHeight)).mean());
    }
    EXPECT_GT(darkness[0], 0.02);
    EXPECT_NEAR(darkness[1], darkness[0], 0.05 * darkness[0]);
}

TEST_F(AoBackFaces, WithoutBacksTheConstantThicknessStands) {
    // Two-sided planes only: no back anywhere, so both maps are the same.
    std::vector<FloatMap> maps;
    for (const char* backFaces : {"false", "true"}) {
        loadSlices("vbao", 1, {{"backFaces", backFaces}});
        renderer_->setScene(wallScene());
        maps.push_back(map(viewOf(wallCamera(3), kWidth, kHeight)));
    }
    EXPECT_LT(maps[0].min(), 0.7f);
    EXPECT_EQ(maps[0].values, maps[1].values);
}

}  // namespace
}  // namespace crevice
