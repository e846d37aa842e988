// A flat surface has no occlusion: any tilt, distance, projection, lens and unit of length, up to the borders of the
// frame.
#include "AoFixture.h"

namespace crevice {
namespace {

constexpr std::uint32_t kWidth = 72, kHeight = 54;
constexpr float kDistance = 5;  // of the plane along the axis; the radius is 1
constexpr float kPi = 3.14159265f;

struct Lens {
    const char* name;
    bool orthographic = false;
    glm::vec2 shift{0};
};
constexpr Lens kLenses[] = {{"perspective"}, {"orthographic", true}, {"shifted", false, {0.4f, -0.3f}}};

Camera planeCamera(const Lens& lens, float degrees, float zPerNear, float far, float scale = 1) {
    Camera camera;
    camera.orthographic = lens.orthographic;
    camera.lensShift = lens.shift;
    // Narrow for steep tilts: all of the frame must see the plane.
    camera.fovY = (degrees > 70 ? 9.0f : 26.0f) * kPi / 180;
    camera.orthoHeight = (degrees > 70 ? 0.8f : 2.5f) * scale;
    camera.near = kDistance / zPerNear * scale;
    camera.far = far * scale;
    return camera;
}

class AoPlane : public AoTest {
protected:
    void expectOpen(const Camera& camera, const std::string& what) {
        const FloatMap ao = map(viewOf(camera, kWidth, kHeight));
        ASSERT_LT(map(viewOf(camera, kWidth, kHeight), "viewDepth").max(), 1e8f) << what << ": sky in the frame";
        EXPECT_GE(ao.min(), 1 - kByteStep) << what;
        EXPECT_LE(ao.max(), 1) << what;
    }
};

TEST_F(AoPlane, IsOpenAtEveryTiltThroughEveryLens) {
    for (const char* radius : {"0.1", "1", "10"}) {
        loadMap("default", {{"SsaoStage.material.radius", radius}});
        for (float degrees : {0.0f, 30.0f, 60.0f, 80.0f}) {
            renderer_->setScene(tiltedPlane(degrees, kDistance));
            for (const Lens& lens : kLenses) {
                expectOpen(planeCamera(lens, degrees, 50, 5000),
                           lens.name + std::string(", radius ") + radius + ", degrees " + std::to_string(degrees));
            }
        }
    }
}

TEST_F(AoPlane, IsOpenFromNearToFar) {
    loadMap("default", {{"SsaoStage.material.radius", "1"}});
    renderer_->setScene(tiltedPlane(60, kDistance));
    for (float zPerNear : {10.0f, 100.0f, 1000.0f, 5000.0f})
        expectOpen(planeCamera(kLenses[0], 60, zPerNear, 1000), "z / near " + std::to_string(zPerNear));
}

TEST_F(AoPlane, IsOpenInOtherUnitsOfLength) {
    for (float scale : {0.01f, 100.0f}) {
        loadMap("default", {{"SsaoStage.material.radius", std::to_string(scale)}});
        renderer_->setScene(tiltedPlane(60, kDistance * scale));
        for (const Lens& lens : kLenses) expectOpen(planeCamera(lens, 60, 50, 1000, scale), lens.name);
    }
}

TEST_F(AoPlane, IsOpenHoweverItLies) {
    // Planes, lenses and places in the world by a fixed sequence: normals that no half float holds, wide and shifted
    // lenses.
    loadMap("default", {{"SsaoStage.material.radius", "2"}});
    std::uint32_t state = 1;
    const auto random = [&](float from, float to) {
        state = state * 1664525u + 1013904223u;
        return from + (to - from) * static_cast<float>(state >> 8u) * 0x1p-24f;
    };
    for (int i = 0; i < 60; ++i) {
        const float tilt = glm::radians(random(0, 80));
        const float around = random(0, 2 * kPi);
        const glm::vec3 normal(std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), std::cos(tilt));
        const glm::mat4 placed =
            glm::rotate(translated({random(-50, 50), random(-50, 50), random(-50, 50)}), random(0, 6),
                        glm::normalize(glm::vec3(random(0, 1), random(0.1f, 1), random(0, 1))));
        Scene scene = emptyScene();
        addSquare(scene, {0, 0, -kDistance}, normal, 60 * kDistance);
        scene.instances[0].world = placed * scene.instances[0].world;
        renderer_->setScene(std::move(scene));
        Camera camera;
        camera.view = glm::inverse(placed);
        camera.fovY = glm::radians(random(5, 70));
        camera.lensShift = {random(-0.6f, 0.6f), random(-0.6f, 0.6f)};
        camera.near = 0.1f;
        camera.far = 2000;
        const FloatMap ao = map(viewOf(camera, kWidth, kHeight));
        // Beyond the horizon is sky, which is open as well.
        EXPECT_GE(ao.min(), 1 - kByteStep) << i << ": degrees " << glm::degrees(tilt);
    }
}

TEST_F(AoPlane, OccludesItselfWithoutBias) {
    loadMap("default", {{"SsaoStage.material.radius", "0.2"}, {"SsaoStage.material.bias", "0"}});
    renderer_->setScene(tiltedPlane(60, kDistance));
    EXPECT_LT(map(viewOf(planeCamera(kLenses[0], 60, 50, 5000), kWidth, kHeight)).min(), 0.99f);
}

TEST_F(AoPlane, FarPlaneChangesNothing) {
    loadMap("default", {{"SsaoStage.material.radius", "1"}});
    Scene scene = tiltedPlane(30, kDistance);
    addBox(scene, {0, 0, -kDistance}, {1, 1, 1});
    renderer_->setScene(std::move(scene));
    const FloatMap nearby = map(viewOf(planeCamera(kLenses[0], 30, 50, 50), kWidth, kHeight));
    const FloatMap distant = map(viewOf(planeCamera(kLenses[0], 30, 50, 5000), kWidth, kHeight));
    EXPECT_LT(nearby.min(), 0.8f);
    EXPECT_LE(maxDifference(nearby, distant), kByteStep);
}

TEST_F(AoPlane, ScaleOfTheWorldChangesNothing) {
    std::vector<FloatMap> maps;
    for (float scale : {1.0f, 100.0f}) {
        loadMap("default", {{"SsaoStage.material.radius", std::to_string(scale)}});
        Scene scene = tiltedPlane(30, kDistance * scale);
        addBox(scene, glm::vec3(0, 0, -kDistance) * scale, glm::vec3(1.1f, 0.9f, 1) * scale);
        renderer_->setScene(std::move(scene));
        maps.push_back(map(viewOf(planeCamera(kLenses[0], 30, 50, 1000, scale), kWidth, kHeight)));
    }
    EXPECT_LT(maps[0].min(), 0.8f);
    EXPECT_LE(meanDifference(maps[0], maps[1]), 0.1 * kByteStep);
}

}  // namespace
}  // namespace crevice
