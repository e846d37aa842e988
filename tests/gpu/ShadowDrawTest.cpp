// Shadows stand where geometry puts them: a box over a floor under a slanted sun and under a spot light.
#include "FrameFixture.h"
#include "flow/ShadowView.h"

namespace crevice {
namespace {

class ShadowDraw : public FrameTest {
protected:
    /// A floor at y = 0 and a box that hovers over it: |x|, |z| <= 0.5, 1 <= y <= 1.5.
    static Scene hoveringBox() {
        Scene scene = darkScene();
        addFloor(scene, 12);
        addBlock(scene, {0, 1.25f, 0}, {1, 0.5f, 1});
        return scene;
    }
    static Camera topCamera(float height = 8, const glm::vec3& target = glm::vec3(0)) {
        Camera camera = Camera::lookAt(target + glm::vec3(0, 6, 0), target, {0, 0, -1});
        camera.orthographic = true;
        camera.orthoHeight = height;
        camera.near = 0.5f;
        camera.far = 10;
        return camera;
    }
    static Light sun() {
        Light light = directional({1, -1, 0}, 1);  // the shadow of a point (x, y, z) falls to (x + y, 0, z)
        light.castsShadow = true;
        return light;
    }
    /// How far one goes along x on the floor until the map's column has changed by one.
    static float texelOnFloor(const ShadowView& shadow) {
        const glm::mat4 toClip = shadow.projection * shadow.view;
        const glm::vec2 step(toClip[0]);  // of clip space, per unit along x; the map is 2 wide and has 1024 texels
        return 2.0f / 1024 / std::max(std::abs(step.x), std::abs(step.y));
    }
    static Light lamp() {
        Light light = spotLight({0, 4, 0}, {0, 0, 0}, 16, 0.6f, 0.7f);
        light.castsShadow = true;
        return light;
    }
};

TEST_F(ShadowDraw, TheSunsShadowIsTheProjectedBox) {
    Scene scene = hoveringBox();
    scene.lights = {sun()};
    const View view = viewOf(topCamera(), 160, 160);
    for (const char* pipeline : {"deferred", "forward", "ssao-deferred"}) {
        renderer_->setScene(scene);
        load(pipeline, {{"shadows", "false"}});
        const Image open = radiance(view);
        load(pipeline);
        const Image image = radiance(view);
        const float lit = at(open, view, {-2, 0, -2}).x;
        EXPECT_GT(lit, 0.2f);
        // Corners of the box project to x = 0.5 … 2; the part above x = 0.5 is what the camera sees of it.
        const float margin = 0.06f;  // a texel of the map is 0.01 units, the filter 3 of them, the normal bias 1.5
        for (float x = -3.5f; x < 3.6f; x += 0.05f) {
            for (const float z : {-0.45f + margin, 0.0f, 0.45f - margin, 0.56f + margin, -2.0f, 3.0f}) {
                if (std::abs(x) < 0.55f && std::abs(z) < 0.55f) continue;  // the box itself
                const float value = at(image, view, {x, 0, z}).x;
                const bool inside = std::abs(z) < 0.5f && x > 0.5f + margin && x < 2 - margin;
                const bool outside = std::abs(z) > 0.5f || x < 0.5f - margin || x > 2 + margin;
                if (inside) {
                    EXPECT_EQ(value, 0) << pipeline << ' ' << x << ' ' << z;
                }
                if (outside) {
                    EXPECT_EQ(value, at(open, view, {x, 0, z}).x) << pipeline << ' ' << x << ' ' << z;
                }
            }
        }
        EXPECT_EQ(at(open, view, {1.2f, 0, 0}).x, lit) << "shadows=false";
    }
}

TEST_F(ShadowDraw, TheSpotLightsShadowWidensWithDistance) {
    Scene scene = hoveringBox();
    scene.lights = {lamp()};
    // From the front above: the floor around the box is seen under it.
    Camera camera = Camera::lookAt({0, 5, 5}, {0, 0, 0});
    camera.orthographic = true;
    camera.orthoHeight = 8;
    camera.near = 0.5f;
    camera.far = 20;
    const View view = viewOf(camera, 160, 160);
    for (const char* pipeline : {"deferred", "forward"}) {
        renderer_->setScene(scene);
        load(pipeline, {{"shadows", "false"}});
        const Image open = radiance(view);
        load(pipeline);
        const Image image = radiance(view);
        // The top edge, 2.5 below the lamp, casts the widest shadow: 0.5 · 4 / 2.5 = 0.8 on the floor.
        for (float x = -1.6f; x < 1.61f; x += 0.05f) {
            for (const float z : {0.6f, 0.7f, 0.9f, 1.2f}) {
                const float reach = std::max(std::abs(x), z);
                const float value = at(image, view, {x, 0, z}).x;
                const float unshadowed = at(open, view, {x, 0, z}).x;
                EXPECT_GT(unshadowed, 0.05f);
                if (reach < 0.75f) {
                    EXPECT_EQ(value, 0) << pipeline << ' ' << x << ' ' << z;
                }
                if (reach > 0.87f) {
                    EXPECT_EQ(value, unshadowed) << pipeline << ' ' << x << ' ' << z;
                }
            }
        }
    }
}

TEST_F(ShadowDraw, OnlyTheLightsOwnPartIsShadowed) {
    Scene scene = hoveringBox();
    const View view = viewOf(topCamera(), 80, 80);
    load("deferred");
    Light fill = pointLight({3, 3, 3}, 4);
    scene.lights = {fill};
    renderer_->setScene(scene);
    const float filled = at(radiance(view), view, {1.2f, 0, 0}).x;
    scene.lights = {fill, sun()};
    renderer_->setScene(scene);
    EXPECT_EQ(at(radiance(view), view, {1.2f, 0, 0}).x, filled);
    EXPECT_GT(at(radiance(view), view, {-1.2f, 0, 0}).x, filled);
    // castsShadow off: nothing is shadowed.
    scene.lights[1].castsShadow = false;
    renderer_->setScene(scene);
    EXPECT_GT(at(radiance(view), view, {1.2f, 0, 0}).x, filled + 0.2f);
}

TEST_F(ShadowDraw, WallsAndFloorsDoNotShadowThemselves) {
    Scene scene = darkScene();
    addFloor(scene, 12);
    addBlock(scene, {0, 1, 0}, {2, 2, 2});
    scene.lights = {directional({0.9f, -0.3f, -0.4f}, 1)};
    Camera camera = Camera::lookAt({-4, 4, 5}, {-0.5f, 0.5f, 0.5f});
    camera.fovY = 1.2f;
    const View view = viewOf(camera, 96, 96);
    renderer_->setScene(scene);
    load("deferred");
    const Image open = radiance(view);
    scene.lights[0].castsShadow = true;
    renderer_->setScene(scene);
    const Image image = radiance(view);
    // The sun comes from the left front: the box shows its lit sides, and the floor left of the box is open.
    for (const glm::vec3 point :
         {glm::vec3(-1, 1, 0.3f), glm::vec3(-1, 1.7f, -0.6f), glm::vec3(0.2f, 1, 1), glm::vec3(-0.7f, 0.4f, 1),
          glm::vec3(0, 2, 0), glm::vec3(0.7f, 2, 0.7f), glm::vec3(-3, 0, 0), glm::vec3(-2, 0, 3)}) {
        EXPECT_GT(at(open, view, point).x, 0.05f) << point.x << ' ' << point.y << ' ' << point.z;
        EXPECT_EQ(at(image, view, point).x, at(open, view, point).x) << point.x << ' ' << point.y << ' ' << point.z;
    }
}

TEST_F(ShadowDraw, AFloorUnderALowSunHasNoSpeckles) {
    for (const float height : {-0.15f, -0.5f, -1.0f}) {
        Scene scene = darkScene();
        addFloor(scene, 10);
        addBlock(scene, {4.5f, 1, 0}, {0.5f, 2, 0.5f});  // gives the light's volume a depth; its shadow falls outside
        scene.lights = {directional({0.9f, height, 0.3f}, 1)};
        const View view = viewOf(topCamera(7, {-1, 0, 0}), 160, 160);
        renderer_->setScene(scene);
        load("deferred");
        const Image open = radiance(view);
        scene.lights[0].castsShadow = true;
        renderer_->setScene(scene);
        EXPECT_EQ(radiance(view), open) << height;
    }
}

TEST_F(ShadowDraw, AShadowBeginsAtTheFootOfWhatCastsIt) {
    Scene scene = darkScene();
    addFloor(scene, 12);
    addBlock(scene, {0, 0.25f, 0}, {1, 0.5f, 1});
    scene.lights = {sun()};
    const View view = viewOf(topCamera(3, {1, 0, 0}), 300, 300);
    renderer_->setScene(scene);
    load("deferred");
    const Image image = radiance(view);
    // Biases let light in at the foot: 1.5 texels along the normal, and 0.0008 of the depth range.
    for (float x = 0.54f; x < 0.95f; x += 0.02f) EXPECT_EQ(at(image, view, {x, 0, 0}).x, 0) << x;
    EXPECT_GT(at(image, view, {1.1f, 0, 0}).x, 0.2f);
    // A bias of a tenth of the light's depth range, 0.88 units, frees what is 0.71 below the top.
    load("deferred", {}, {{.path = "ShadowStage.params.bias", .value = "0.1"}});
    EXPECT_GT(at(radiance(view), view, {0.75f, 0, 0}).x, 0.2f);
}

TEST_F(ShadowDraw, TheFilterIsAsWideAsItsName) {
    Scene scene = hoveringBox();
    scene.lights = {sun()};
    renderer_->setScene(scene);
    // Close up on the shadow's far edge, x = 2: 0.4 units in 400 pixels.
    const View view = viewOf(topCamera(0.001f, {2, 0, 0}), 400, 1);
    for (int radius = 0; radius < 3; ++radius) {
        const char* names[] = {"1x1", "3x3", "5x5"};
        load("deferred", {}, {{.path = "ShadowStage.params.pcf", .value = names[radius]}});
        const std::optional<ShadowView> shadow = directionalShadowView(scene, scene.bounds());
        ASSERT_TRUE(shadow);
        const Image image = radiance(view);
        const float lit = image.at(399, 0).x;
        int partly = 0;
        float last = 0;
        for (std::uint32_t x = 0; x < 400; ++x) {
            const float value = image.at(x, 0).x;
            partly += value > 0 && value < lit;
            EXPECT_GE(value, last);  // the penumbra is monotonous
            last = value;
        }
        EXPECT_EQ(image.at(0, 0).x, 0);
        EXPECT_GT(lit, 0.2f);
        // A texel's width on the floor along x, seen along the light at 45 degrees.
        const float texel = texelOnFloor(*shadow);
        const float pixels = texel * float(2 * radius + 1) / 0.4f * 400;
        EXPECT_NEAR(float(partly), pixels, 2.5f) << names[radius];
    }
}

}  // namespace
}  // namespace crevice
