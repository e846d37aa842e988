// From radiance to the picture: sky, background, exposure, sRGB encoding, anti-aliasing; and cameras of every kind.
#include "FrameFixture.h"

namespace crevice {
namespace {

constexpr float kHalfUnit = 1.0f / 1024;  // stores into half floats may round down by one unit of 11 bits

class FramePicture : public FrameTest {
protected:
    /// Nothing but sky: a speck behind the camera gives the scene a size.
    static Scene skyScene() {
        Scene scene = darkScene();
        addWall(scene, 0.001f, {0, 0, 60});
        scene.sky = {.enabled = true, .zenith = {0.125f, 0.5f, 1}, .horizon = {1, 0.75f, 0.5f}, .nadir = {0, 0.25f, 0}};
        return scene;
    }
    static Scene glowingWall(float size) {
        Scene scene = darkScene();
        scene.materials[0].baseColor = {0, 0, 0, 1};
        scene.materials[0].metallic = 1;
        scene.materials[0].emissive = {0.25f, 0.5f, 0.125f};
        addWall(scene, size);
        return scene;
    }
    /// IEC 61966-2-1.
    static double encodeSrgb(double linear) {
        const double x = std::clamp(linear, 0.0, 1.0);
        return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    }
    static int byteAt(const Image& image, std::uint32_t x, std::uint32_t y, int channel) {
        return static_cast<int>(image.pixel(x, y)[channel]);
    }
};

TEST_F(FramePicture, SkyIsAGradientByTheHeightOfTheRay) {
    const Scene scene = skyScene();
    renderer_->setScene(scene);
    View view = viewOf(Camera::lookAt({0, 0, 0}, {0, 0.25f, -1}), 9, 32);
    view.camera->fovY = 2;
    for (const char* pipeline : {"deferred", "forward"}) {
        load(pipeline);
        const Image image = radiance(view);
        const glm::mat4 toWorld = glm::inverse(view.camera->view);
        for (std::uint32_t y = 0; y < 32; ++y) {
            for (std::uint32_t x = 0; x < 9; ++x) {
                const glm::vec2 ndc((float(x) + 0.5f) / 9 * 2 - 1, 1 - (float(y) + 0.5f) / 32 * 2);
                const float half = std::tan(1.0f);
                const glm::vec3 ray =
                    glm::normalize(glm::mat3(toWorld) * glm::vec3(ndc.x * half * 9 / 32, ndc.y * half, -1));
                const float share = std::sqrt(std::abs(ray.y));
                const glm::vec3 expected =
                    glm::mix(scene.sky.horizon, ray.y > 0 ? scene.sky.zenith : scene.sky.nadir, share);
                // Near the horizon the square root is steep: 12 bits of a unit vector are not much there.
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(image.at(x, y)[c], expected[c], 0.003f) << pipeline << ' ' << x << ',' << y;
                }
                EXPECT_EQ(image.at(x, y).w, 1);
            }
        }
    }
}

TEST_F(FramePicture, SkyStandsBehindEverythingElse) {
    Scene scene = skyScene();
    scene.materials[0].emissive = {3, 3, 3};
    scene.materials[0].baseColor = {0, 0, 0, 1};
    scene.materials[0].metallic = 1;
    addWall(scene, 2, {0, 0, 0});
    renderer_->setScene(scene);
    for (const char* pipeline : {"deferred", "forward"}) {
        load(pipeline);
        const View view = viewOf(frontCamera(), 16, 16);
        const Image image = radiance(view);
        EXPECT_EQ(image.at(8, 8), glm::vec4(3, 3, 3, 1)) << pipeline;
        EXPECT_NEAR(image.at(1, 1).x, 1, kHalfUnit) << pipeline;  // an orthographic camera sees the horizon everywhere
    }
}

TEST_F(FramePicture, BackgroundShowsWhereNothingIs) {
    renderer_->setScene(glowingWall(2));
    for (const char* pipeline : {"deferred", "forward"}) {
        load(pipeline);
        View view = viewOf(frontCamera(), 16, 16);
        view.background = {0.2f, 0.4f, 0.6f, 1};
        const Image solid = renderer_->render(view);
        EXPECT_EQ(solid.at(0, 0), glm::vec4(51, 102, 153, 255) / 255.0f) << pipeline;
        EXPECT_EQ(solid.at(8, 8).w, 1) << pipeline;
        view.background = {0, 0, 0, 0};
        const Image open = renderer_->render(view);
        EXPECT_EQ(open.at(0, 0), glm::vec4(0)) << pipeline;
        EXPECT_EQ(open.at(8, 8), solid.at(8, 8)) << pipeline;
        view.background = {1, 0, 0, 0.4f};
        EXPECT_EQ(renderer_->render(view).at(0, 0), glm::vec4(255, 0, 0, 102) / 255.0f) << pipeline;
    }
}

TEST_F(FramePicture, EncodingAndExposureAreExact) {
    const View view = [] {
        View v = viewOf(Camera::lookAt({0, 0, 0}, {0, 0.3f, -1}), 16, 64);
        v.camera->fovY = 2;
        v.keep = {"cc_lighting_resultMap"};
        return v;
    }();
    for (const float stops : {0.0f, 1.0f, -1.0f}) {
        Scene scene = skyScene();
        scene.exposureEv = std::log2(1.0f / 1.2f) + stops;  // factor 1, 1/2, 2
        renderer_->setScene(scene);
        load("deferred", {{"fxaa", "false"}}, {{.path = "PostProcessStage.defines.TONEMAP", .value = "none"}});
        const Image picture = renderer_->render(view);
        const Image radiance = renderer_->target("cc_lighting_resultMap");
        const double factor = std::exp2(-double(stops));
        for (std::uint32_t y = 0; y < 64; ++y) {
            for (int c = 0; c < 3; ++c) {
                const double expected = 255 * encodeSrgb(double(radiance.at(5, y)[c]) * factor);
                // Half a step of rounding; the rest is the driver's pow.
                EXPECT_NEAR(byteAt(picture, 5, y, c), expected, 0.53) << stops << ' ' << y << ' ' << c;
            }
        }
    }
}

TEST_F(FramePicture, ToneCurvesKeepBlackAndStayInRange) {
    Scene scene = glowingWall(2);
    scene.materials[0].emissive = {100, 100, 100};
    renderer_->setScene(scene);
    for (const char* curve : {"neutral", "aces", "reinhard", "agx", "none"}) {
        load("deferred", {{"fxaa", "false"}}, {{.path = "PostProcessStage.defines.TONEMAP", .value = curve}});
        const Image picture = renderer_->render(viewOf(frontCamera(), 8, 8));
        EXPECT_GE(byteAt(picture, 4, 4, 0), 240) << curve;
        EXPECT_EQ(byteAt(picture, 0, 0, 0), 0) << curve;
    }
    // Below 0.8 - 0.04 the neutral curve only takes the dielectric's 4 % of reflection away.
    scene.materials[0].emissive = {0.5f, 0.5f, 0.5f};
    renderer_->setScene(scene);
    load("deferred", {{"fxaa", "false"}});
    EXPECT_NEAR(byteAt(renderer_->render(viewOf(frontCamera(), 8, 8)), 4, 4, 1), 255 * encodeSrgb(0.46), 0.53);
}

TEST_F(FramePicture, AntiAliasingTouchesEdgesOnly) {
    renderer_->setScene(glowingWall(20));
    const View wall = viewOf(frontCamera(), 16, 16);
    load("deferred", {{"fxaa", "false"}});
    const Image plain = renderer_->render(wall);
    load("deferred");
    EXPECT_EQ(renderer_->render(wall), plain);

    renderer_->setScene(shippedScene("crease"));
    View view = sized(160, 90);
    view.keep = {"toneMapped"};
    const Image smooth = renderer_->render(view);
    const Image before = renderer_->target("toneMapped");
    const auto luma = [&](int x, int y) {
        const glm::vec4 c = before.at(std::uint32_t(std::clamp(x, 0, 159)), std::uint32_t(std::clamp(y, 0, 89)));
        return glm::dot(glm::vec3(c), glm::vec3(0.299f, 0.587f, 0.114f));
    };
    int changed = 0;
    for (int y = 0; y < 90; ++y) {
        for (int x = 0; x < 160; ++x) {
            if (smooth.at(std::uint32_t(x), std::uint32_t(y)) == before.at(std::uint32_t(x), std::uint32_t(y)))
                continue;
            ++changed;
            const float around[] = {luma(x, y), luma(x - 1, y), luma(x + 1, y), luma(x, y - 1), luma(x, y + 1)};
            const float high = *std::max_element(around, around + 5);
            const float low = *std::min_element(around, around + 5);
            EXPECT_GE(high - low, std::max(0.0312f, high * 0.125f) - 1e-4f) << x << ',' << y;
        }
    }
    EXPECT_GT(changed, 200);
    EXPECT_LT(changed, 160 * 90 / 4);
}

TEST_F(FramePicture, ObjectsStandWhereTheCameraProjectsThem) {
    Scene scene = glowingWall(1);
    scene.instances[0].world[3] = glm::vec4(0.5f, 0.25f, -1, 1);
    renderer_->setScene(scene);
    std::vector<Camera> cameras(4, Camera::lookAt({0.2f, 0.1f, 5}, {0, 0, 0}));
    cameras[1].lensShift = {0.25f, -0.125f};
    cameras[2].orthographic = cameras[3].orthographic = true;
    cameras[2].orthoHeight = cameras[3].orthoHeight = 4;
    cameras[3].lensShift = {0.25f, -0.125f};
    for (const char* pipeline : {"deferred", "forward"}) {
        load(pipeline);
        std::vector<glm::vec2> centres;
        for (const Camera& camera : cameras) {
            const View view = viewOf(camera, 120, 80);
            const Image image = radiance(view);
            for (std::uint32_t y = 0; y < 80; ++y) {
                for (std::uint32_t x = 0; x < 120; ++x) {
                    // Inside when the corners' rectangle, a pixel smaller or larger, says so.
                    const glm::vec2 low = pixelOf(view, {0, 0.75f, -1});
                    const glm::vec2 high = pixelOf(view, {1, -0.25f, -1});
                    const glm::vec2 p(float(x) + 0.5f, float(y) + 0.5f);
                    const glm::vec2 in = glm::min(p - low, high - p);
                    const float depth = std::min(in.x, in.y);
                    if (depth > 2) {
                        EXPECT_EQ(image.at(x, y).w, 1) << pipeline << x << ',' << y;
                    } else if (depth < -2) {
                        EXPECT_EQ(image.at(x, y).w, 0) << pipeline << x << ',' << y;
                    }
                }
            }
            centres.push_back(pixelOf(view, {0.5f, 0.25f, -1}));
        }
        // A lens shift moves the picture, by NDC units: +x to the left, +y up.
        for (const int i : {0, 2}) {
            const glm::vec2 moved = centres[std::size_t(i) + 1] - centres[std::size_t(i)];
            EXPECT_NEAR(moved.x, -0.25f * 60, 1e-3f);
            EXPECT_NEAR(moved.y, 0.125f * 40, 1e-3f);
        }
    }
}

TEST_F(FramePicture, OffCentreAndParallelCamerasLightAlikeInBothPipelines) {
    Scene scene = shippedScene("crease");
    renderer_->setScene(scene);
    for (const bool orthographic : {false, true}) {
        View view = sized(96, 54);
        view.camera = scene.cameras.front();
        view.camera->orthographic = orthographic;
        view.camera->orthoHeight = 4;
        view.camera->lensShift = {0.3f, -0.2f};
        load("deferred", {{"fxaa", "false"}});
        const Image deferred = renderer_->render(view);
        load("forward");
        EXPECT_LE(largestDifference(renderer_->render(view), deferred), 2.01f / 255) << orthographic;
    }
}

}  // namespace
}  // namespace crevice
