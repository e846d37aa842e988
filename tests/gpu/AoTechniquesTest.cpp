// The techniques of ao-deferred against what geometry says: planes are open, a wall hides what it hides, thin things
// little, units and far plane do not matter, and `off` is `deferred`.
#include "AoFixture.h"

namespace crevice {
namespace {

constexpr float kPi = 3.14159265f;
constexpr const char* kTechniques[] = {"cocos", "hbao", "gtao", "vbao"};
constexpr std::uint32_t kWidth = 72, kHeight = 54;
constexpr float kDistance = 5;  // of planes along the axis; the radius is 1

class AoTechniques : public AoTest {
protected:
    /// A technique with its raw map as full floats, radius in world units.
    void loadTechnique(const std::string& ao, float radius = 1, const std::string& quality = "high", Sets sets = {}) {
        sets.insert(sets.begin(), {.path = "cc_ssaoMap.format", .value = "R32F"});
        load("ao-deferred", {{"ao", ao}, {"radius", std::to_string(radius)}, {"quality", quality}}, std::move(sets));
    }
};

Camera planeCamera(bool orthographic, float degrees, float far = 500, float scale = 1) {
    Camera camera;
    camera.orthographic = orthographic;
    // Narrow for steep tilts: all of the frame must see the plane.
    camera.fovY = (degrees > 70 ? 9.0f : 40.0f) * kPi / 180;
    camera.orthoHeight = (degrees > 70 ? 0.8f : 2.5f) * scale;
    camera.near = 0.1f * scale;
    camera.far = far * scale;
    return camera;
}

/// A box that stands out of a tilted plane.
Scene boxScene(float scale = 1) {
    Scene scene = tiltedPlane(30, kDistance * scale);
    addBox(scene, glm::vec3(0, 0, -kDistance) * scale, glm::vec3(1.1f, 0.9f, 1) * scale);
    return scene;
}

View smallView(const Camera& camera) { return viewOf(camera, kWidth, kHeight); }

TEST_F(AoTechniques, PlaneIsOpen) {
    for (const std::string ao : kTechniques) {
        loadTechnique(ao);
        // Shares of the hemisphere are divided by what an open plane has: one slice is exact.
        const float tolerance = ao == "gtao" || ao == "vbao" ? 1e-3f : kByteStep;
        for (float degrees : {0.0f, 30.0f, 60.0f, 80.0f}) {
            renderer_->setScene(tiltedPlane(degrees, kDistance));
            for (bool orthographic : {false, true}) {
                const FloatMap open = map(smallView(planeCamera(orthographic, degrees)));
                const std::string what =
                    ao + (orthographic ? ", orthographic, " : ", perspective, ") + std::to_string(degrees) + " degrees";
                EXPECT_GE(open.min(), 1 - tolerance) << what;
                EXPECT_LE(open.max(), 1) << what;
            }
        }
    }
}

TEST_F(AoTechniques, ReferenceMeetsTheFormulaOfAWall) {
    constexpr std::uint32_t kColumns = 160, kRows = 150;
    constexpr float kSeen = 3;  // world units; everything within the radius of the rows below is in the frame
    for (const std::string ao : {"gtao", "vbao"}) {
        // Thick things: the bitmask is the same integral.
        Sets sets;
        if (ao == "vbao") sets = {{"AoMain.material.thickness", "2"}};
        loadTechnique(ao, 1, "reference", sets);
        renderer_->setScene(wallScene());
        const FloatMap ao1 = map(viewOf(wallCamera(kSeen), kColumns, kRows));
        for (float k : {0.2f, 0.5f}) {
            const auto row = static_cast<std::uint32_t>((k / 1.41421356f / kSeen + 0.5f) * kRows);
            const double exact = exactWall(floorDistance(row, kRows, kSeen));
            EXPECT_NEAR(ao1.rowMean(row, 60, 100), exact, 0.01) << ao << " at " << k;
            RecordProperty(ao + std::to_string(k), std::to_string(ao1.rowMean(row, 60, 100) - exact));
        }
    }
}

TEST_F(AoTechniques, SameTwiceInRangeAndWhiteSky) {
    for (const std::string ao : kTechniques) {
        loadTechnique(ao);
        Scene scene = emptyScene();
        addBox(scene, {0, 0, -kDistance}, {1.5f, 1, 1});
        addBox(scene, {0.4f, 0.6f, -kDistance + 0.2f}, {0.8f, 0.8f, 0.8f});
        renderer_->setScene(std::move(scene));
        const View view = smallView(planeCamera(false, 30));
        const FloatMap once = map(view);
        const FloatMap depth = map(view, "viewDepth");
        EXPECT_EQ(once.values, map(view).values) << ao;
        EXPECT_GE(once.min(), 0) << ao;
        EXPECT_LT(once.min(), 0.9f) << ao << ": something is occluded";
        std::size_t sky = 0, grey = 0;
        for (std::size_t i = 0; i < once.values.size(); ++i) {
            EXPECT_FALSE(std::isnan(once.values[i])) << ao;
            if (depth.values[i] < 1e8f) continue;
            ++sky;
            if (once.values[i] != 1) ++grey;
        }
        EXPECT_GT(sky, 100u);
        EXPECT_EQ(grey, 0u) << ao << ": pixels of the sky that are not white";
    }
}

TEST_F(AoTechniques, UnitOfLengthAndFarPlaneChangeNothing) {
    for (const std::string ao : kTechniques) {
        loadTechnique(ao);
        renderer_->setScene(boxScene());
        const FloatMap near = map(smallView(planeCamera(false, 30, 50)));
        const FloatMap far = map(smallView(planeCamera(false, 30, 5000)));
        EXPECT_LT(near.min(), 0.9f) << ao;
        EXPECT_LE(meanDifference(near, far), 0.1 * kByteStep) << ao;
        loadTechnique(ao, 100);
        renderer_->setScene(boxScene(100));
        EXPECT_LE(meanDifference(near, map(smallView(planeCamera(false, 30, 50, 100)))), 0.25 * kByteStep) << ao;
    }
}

TEST_F(AoTechniques, ThinBarsDarkenLessWithTheBitmask) {
    std::map<std::string, double> behind;
    for (const std::string ao : {"gtao", "vbao"}) {
        Sets sets;
        if (ao == "vbao") sets = {{"AoMain.material.thickness", "0.1"}};
        loadTechnique(ao, 1, "ultra", sets);
        Scene scene = tiltedPlane(0, kDistance);
        addBox(scene, {0, 0, -kDistance + 0.5f}, {0.15f, 20, 0.1f});
        renderer_->setScene(std::move(scene));
        const View view = smallView(planeCamera(false, 30));
        const FloatMap open = map(view), depth = map(view, "viewDepth");
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < open.values.size(); ++i) {
            if (depth.values[i] < kDistance - 0.1f) continue;
            sum += 1 - open.values[i];
            ++count;
        }
        behind[ao] = sum / count;
    }
    // The wall beside the bar sees most of what the bar covers on the screen.
    EXPECT_GT(behind["gtao"], 0.02);
    EXPECT_LT(behind["vbao"], 0.7 * behind["gtao"]);
}

TEST_F(AoTechniques, OffIsDeferred) {
    const View view = smallView(planeCamera(false, 30));
    load("deferred");
    renderer_->setScene(boxScene());
    const Image without = target(view, "finalColor");
    for (const char* applyTo : {"albedo", "ambient"}) {
        load("ao-deferred", {{"ao", "off"}, {"applyTo", applyTo}});
        renderer_->setScene(boxScene());
        EXPECT_TRUE(target(view, "finalColor") == without) << applyTo;
        EXPECT_EQ(map(view, "cc_ssaoBlurMap").min(), 1);
    }
    load("ao-deferred", {{"ao", "vbao"}});
    renderer_->setScene(boxScene());
    EXPECT_FALSE(target(view, "finalColor") == without);
}

TEST(AoTechniqueFiles, EveryTechniqueHasEveryQuality) {
    const PipelineDesc desc =
        loadPipeline(AssetRoots::standard(), {.nameOrPath = "ao-deferred", .options = {}, .sets = {}});
    std::size_t seen = 0;
    for (const OptionDesc& option : desc.options) {
        if (option.name != "ao") continue;
        for (const std::string& ao : option.choices)
            for (const char* quality : {"fast", "medium", "high", "ultra", "reference"}) {
                EXPECT_NO_THROW(loadPipeline(
                    AssetRoots::standard(),
                    {.nameOrPath = "ao-deferred", .options = {{"ao", ao}, {"quality", quality}}, .sets = {}}))
                    << ao << ' ' << quality;
                ++seen;
            }
    }
    EXPECT_GE(seen, 45u);
}

}  // namespace
}  // namespace crevice
