// What every ambient occlusion technique of ao-deferred has to obey, at both resolutions and for both projections:
// planes are open up to the border, what is out of reach does not occlude, the sky is white, and units, far plane, roll
// and resolution do not matter. The techniques are those of the pipeline's own option.
#include "AoFixture.h"
#include "core/Files.h"
#include "plan/PipelineAsset.h"

namespace crevice {
namespace {

constexpr float kPi = 3.14159265f;
constexpr std::uint32_t kWidth = 96, kHeight = 72;

std::vector<std::string> techniques() {
    const std::filesystem::path file =
        std::filesystem::path(CREVICE_TEST_SOURCE_DIR) / "assets/pipelines/ao-deferred.pipeline.json";
    const Value document = parseJson(readText(file), file.string());
    std::vector<std::string> names;
    for (const Value& choice : document.find("options")->find("ao")->find("choices")->items())
        if (choice.string() != "off") names.push_back(choice.string());
    return names;
}

struct Case {
    std::string technique, resolution;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.technique << ' ' << c.resolution; }

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const std::string& technique : techniques())
        for (const char* resolution : {"full", "half"}) all.push_back({technique, resolution});
    return all;
}

class AoFamilies : public AoTest, public testing::WithParamInterface<Case> {
protected:
    /// The technique without what comes after it: no light, no picture.
    void loadCase(float radius, Options more = {}, Sets sets = {}) {
        Options options{
            {"ao", GetParam().technique}, {"resolution", GetParam().resolution}, {"radius", std::to_string(radius)}};
        options.merge(more);
        loadDocument(R"({ "extends": "ao-deferred", "output": "cc_ssaoBlurMap", "edits": [
            { "remove": "ShadowFlow" }, { "remove": "LightingStage" }, { "remove": "SkyboxStage" },
            { "remove": "TransparentStage" }, { "remove": "PostProcessStage" }, { "remove": "Fxaa" } ] })",
                     std::move(sets), std::move(options));
    }
    FloatMap final(const View& view) { return map(view, "cc_ssaoBlurMap"); }

    /// Dividing each slice by what an open surface has makes one slice exact; the others have a bias.
    bool isSelfNormalised() const { return GetParam().technique == "gtao" || GetParam().technique == "vbao"; }
};

/// Sees nothing but a plane of that tilt: narrow where it is steep.
Camera planeCamera(bool orthographic, float degrees, float distance) {
    Camera camera;
    camera.orthographic = orthographic;
    camera.fovY = (degrees > 70 ? 9.0f : 40.0f) * kPi / 180;
    camera.orthoHeight = (degrees > 70 ? 0.16f : 0.5f) * distance;
    camera.near = 0.02f * distance;
    camera.far = 100 * distance;
    return camera;
}

TEST_P(AoFamilies, PlanesAreOpenUpToTheBorder) {
    loadCase(0.5f, {}, {{.path = "cc_ssaoMap.format", .value = "R32F"}});
    for (float distance : {1.0f, 10.0f, 50.0f})
        for (float degrees : {0.0f, 30.0f, 60.0f, 80.0f}) {
            renderer_->setScene(tiltedPlane(degrees, distance));
            for (bool orthographic : {false, true}) {
                const View view = viewOf(planeCamera(orthographic, degrees, distance), kWidth, kHeight);
                const std::string what = std::string(orthographic ? "orthographic, " : "perspective, ") +
                                         std::to_string(degrees) + " degrees, distance " + std::to_string(distance);
                EXPECT_GE(final(view).min(), 0.99f) << what;
                EXPECT_GE(map(view).min(), isSelfNormalised() ? 0.999f : 0.99f) << what;
            }
        }
}

TEST_P(AoFamilies, WhatIsFartherThanTheRadiusHidesNothing) {
    loadCase(1);
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, -20}, {0, 0, 1}, 200);
    addSquare(scene, {0.3f, -0.2f, -10}, {0, 0, 1}, 2.5f);
    renderer_->setScene(std::move(scene));
    for (bool orthographic : {false, true}) {
        const FloatMap open = final(viewOf(planeCamera(orthographic, 0, 12), kWidth, kHeight));
        EXPECT_GE(open.min(), 0.99f) << (orthographic ? "orthographic" : "perspective");
    }
}

/// Two boxes, one on the other, with nothing behind them or with a wall far away.
Scene boxesScene(float wallDistance) {
    Scene scene = emptyScene();
    addBox(scene, {0, -0.4f, -6}, {2.2f, 0.8f, 1.5f});
    addBox(scene, {0.2f, 0.5f, -6.1f}, {0.9f, 1.0f, 0.9f});
    if (wallDistance > 0) addSquare(scene, {0, 0, -wallDistance}, {0, 0, 1}, 10 * wallDistance);
    return scene;
}

TEST_P(AoFamilies, SkyIsWhiteAndLikeAFarWall) {
    loadCase(0.7f);
    for (bool orthographic : {false, true}) {
        const std::string what = orthographic ? "orthographic" : "perspective";
        Camera camera = planeCamera(orthographic, 0, 6);
        camera.far = 20000;
        const View view = viewOf(camera, kWidth, kHeight);
        renderer_->setScene(boxesScene(0));
        const FloatMap open = final(view);
        const FloatMap depth = map(view, "viewDepth");
        renderer_->setScene(boxesScene(7000));
        const FloatMap before = final(view);
        EXPECT_LT(open.min(), 0.85f) << what << ": something is occluded";
        std::size_t sky = 0;
        for (std::size_t i = 0; i < open.values.size(); ++i) {
            ASSERT_FALSE(std::isnan(open.values[i])) << what;
            if (depth.values[i] > 1e8f) {
                ++sky;
                EXPECT_EQ(open.values[i], 1) << what << ", sky pixel " << i;
            } else {
                EXPECT_NEAR(open.values[i], before.values[i], 0.01) << what << ", pixel " << i;
            }
        }
        EXPECT_GT(sky, 100u);
    }
}

/// Asymmetric in every way: a crease, a step and a tilted block, scaled as a whole.
Scene crookedScene(float scale, const glm::mat4& turn = glm::mat4(1)) {
    Scene scene = emptyScene();
    addSquare(scene, glm::vec3(0, -1, -6) * scale, {0.1f, 1, 0.3f}, 60 * scale);
    addSquare(scene, glm::vec3(-2, 0, -8) * scale, {1, 0, 0.4f}, 60 * scale);
    addBox(scene, glm::vec3(0.8f, -0.7f, -6) * scale, glm::vec3(0.9f, 1.2f, 0.8f) * scale);
    for (Instance& instance : scene.instances) {
        instance.world = turn * instance.world;
        instance.flipped = glm::determinant(glm::mat3(instance.world)) < 0;
    }
    return scene;
}

Camera crookedCamera(bool orthographic, float scale, float far) {
    Camera camera;
    camera.orthographic = orthographic;
    camera.fovY = 45 * kPi / 180;
    camera.orthoHeight = 4 * scale;
    camera.near = 0.1f * scale;
    camera.far = far * scale;
    return camera;
}

TEST_P(AoFamilies, UnitsAndFarPlaneChangeNothing) {
    for (bool orthographic : {false, true}) {
        const std::string what = orthographic ? "orthographic" : "perspective";
        loadCase(0.8f);
        renderer_->setScene(crookedScene(1));
        const FloatMap near = final(viewOf(crookedCamera(orthographic, 1, 50), kWidth, kHeight));
        const FloatMap far = final(viewOf(crookedCamera(orthographic, 1, 5000), kWidth, kHeight));
        EXPECT_LT(near.min(), 0.8f) << what;
        EXPECT_LE(meanDifference(near, far), 0.1 * kByteStep) << what;
        loadCase(80);
        renderer_->setScene(crookedScene(100));
        const FloatMap large = final(viewOf(crookedCamera(orthographic, 100, 50), kWidth, kHeight));
        EXPECT_LE(meanDifference(near, large), kByteStep) << what;
    }
}

/// Means of blocks of `side` pixels: what is left when noise is averaged.
FloatMap blockMeans(const FloatMap& full, std::uint32_t side) {
    FloatMap blocks = full;
    blocks.width = full.width / side;
    blocks.height = full.height / side;
    blocks.values.assign(std::size_t(blocks.width) * blocks.height, 0.0f);
    for (std::uint32_t y = 0; y < blocks.height * side; ++y)
        for (std::uint32_t x = 0; x < blocks.width * side; ++x)
            blocks.values[std::size_t(y / side) * blocks.width + x / side] +=
                full.at(x, y) / static_cast<float>(side * side);
    return blocks;
}

/// Turned by 180 degrees: the last value is the first.
FloatMap halfTurn(FloatMap map) {
    std::reverse(map.values.begin(), map.values.end());
    return map;
}

FloatMap mirrored(FloatMap map) {
    for (std::uint32_t y = 0; y < map.height; ++y)
        std::reverse(map.values.begin() + y * map.width, map.values.begin() + (y + 1) * map.width);
    return map;
}

/// What was drawn by a camera rolled by 90 degrees to its left, as an upright one sees it; square maps.
FloatMap quarterTurn(const FloatMap& rolled) {
    FloatMap upright = rolled;
    for (std::uint32_t y = 0; y < rolled.height; ++y)
        for (std::uint32_t x = 0; x < rolled.width; ++x)
            upright.values[std::size_t(rolled.width - 1 - x) * rolled.width + y] = rolled.at(x, y);
    return upright;
}

TEST_P(AoFamilies, RollMirrorAndResolutionOnlyMoveTheNoise) {
    loadCase(0.8f, {{"quality", "ultra"}});
    constexpr std::uint32_t kSide = 96, kBlock = 8;
    const glm::mat4 mirror = glm::scale(glm::mat4(1), {-1, 1, 1});
    for (bool orthographic : {false, true}) {
        const std::string what = orthographic ? "orthographic" : "perspective";
        const View view = viewOf(crookedCamera(orthographic, 1, 50), kSide, kSide);
        const auto turned = [&](const glm::mat4& turn) {
            renderer_->setScene(crookedScene(1, turn));
            return final(view);
        };
        const glm::vec3 axis(0, 0, 1);
        const FloatMap upright = turned(glm::mat4(1));
        const FloatMap blocks = blockMeans(upright, kBlock);
        const auto difference = [&](const FloatMap& other) {
            return meanDifference(blocks, blockMeans(other, kBlock));
        };
        EXPECT_LE(difference(halfTurn(turned(glm::rotate(glm::mat4(1), kPi, axis)))), 0.01) << what;
        EXPECT_LE(difference(quarterTurn(turned(glm::rotate(glm::mat4(1), -kPi / 2, axis)))), 0.01) << what;
        EXPECT_LE(difference(mirrored(turned(mirror))), 0.01) << what;
        renderer_->setScene(crookedScene(1));
        const FloatMap fine = final(viewOf(crookedCamera(orthographic, 1, 50), 2 * kSide, 2 * kSide));
        EXPECT_LE(meanDifference(blocks, blockMeans(fine, 2 * kBlock)), 0.01) << what << ", twice the resolution";
        // The whole test would pass on a map without any structure.
        EXPECT_GT(meanDifference(blocks, blockMeans(mirrored(upright), kBlock)), 0.02) << what;
    }
}

TEST_P(AoFamilies, OpennessFallsTowardsAWallAndTwiceIsTheSame) {
    constexpr std::uint32_t kRows = 160, kColumns = 64;
    constexpr float kSeen = 3;
    loadCase(1, {{"quality", "ultra"}});
    renderer_->setScene(wallScene());
    const View view = viewOf(wallCamera(kSeen), kColumns, kRows);
    const FloatMap open = final(view);
    EXPECT_EQ(open.values, final(view).values);
    const auto at = [&](float distance) {
        const auto row = static_cast<std::uint32_t>((distance / 1.41421356f / kSeen + 0.5f) * kRows);
        return open.rowMean(row, 16, 48);
    };
    for (float d : {0.1f, 0.2f, 0.3f, 0.5f, 0.7f}) EXPECT_LE(at(d), at(d + 0.2f) + 0.01) << "at " << d;
    EXPECT_LT(at(0.1f), 0.85);
    EXPECT_GE(at(1.3f), 0.98) << "beyond the radius";
}

INSTANTIATE_TEST_SUITE_P(, AoFamilies, testing::ValuesIn(cases()),
                         [](const auto& one) { return one.param.technique + "_" + one.param.resolution; });

}  // namespace
}  // namespace crevice
