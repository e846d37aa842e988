// How occlusion enters the light: on ambient alone, or on the base colour; never on emission, never on sky.
#include "AoFixture.h"

namespace crevice {
namespace {

enum LitBy { kDirect, kAmbient, kEmission };

/// The corner with boxes, lit in one way only.
Scene litScene(LitBy light) {
    Scene scene = cornerScene();
    addBox(scene, {1, 0.5f, 1}, {0.8f, 1, 0.8f});
    scene.ambient = Ambient{};
    if (light == kAmbient) scene.ambient = Ambient{glm::vec3(0.8f), glm::vec3(0.6f)};
    if (light == kEmission) scene.materials[0].emissive = {0.5f, 0.25f, 0.1f};
    if (light == kDirect) {
        Light sun;
        sun.direction = glm::normalize(glm::vec3(-0.6f, -1, -0.5f));
        sun.intensity = 2;
        Light lamp;
        lamp.type = LightType::Point;
        lamp.position = {2, 2, 1};
        lamp.intensity = 3;
        scene.lights = {sun, lamp};
    }
    return scene;
}

class AoLighting : public AoTest {
protected:
    void SetUp() override {
        AoTest::SetUp();
        Camera camera = Camera::lookAt({4, 4, 3}, {0.4f, 0.4f, 0.4f});
        camera.near = 0.1f;
        camera.far = 60;
        view_ = viewOf(camera, 96, 64);
    }
    Image lit(Scene scene, const Options& options) {
        load("ssao-deferred", options,
             {{"SsaoStage.material.radius", "1"}, {"cc_lighting_resultMap.format", "RGBA32F"}});
        renderer_->setScene(std::move(scene));
        return target(view_, "cc_lighting_resultMap");
    }
    Image lit(LitBy light, const Options& options) { return lit(litScene(light), options); }
    View view_;
};

double meanOf(const Image& image) { return FloatMap(image).mean(); }

TEST_F(AoLighting, OnAmbientLeavesDirectLightAlone) {
    const Image without = lit(kDirect, {{"ssao", "false"}});
    EXPECT_GT(meanOf(without), 0.05);
    EXPECT_EQ(lit(kDirect, {{"applyTo", "ambient"}}), without);
}

TEST_F(AoLighting, OnAmbientDarkensAmbientLight) {
    const double without = meanOf(lit(kAmbient, {{"ssao", "false"}}));
    const double with = meanOf(lit(kAmbient, {{"applyTo", "ambient"}}));
    EXPECT_LT(with, 0.97 * without);
    EXPECT_GT(with, 0.5 * without);
}

TEST_F(AoLighting, OnAlbedoDarkensDirectLightToo) {
    const double without = meanOf(lit(kDirect, {{"ssao", "false"}}));
    EXPECT_LT(meanOf(lit(kDirect, {{"applyTo", "albedo"}})), 0.98 * without);
}

TEST_F(AoLighting, EmissionIsNeverDarkened) {
    const Image without = lit(kEmission, {{"ssao", "false"}});
    EXPECT_NEAR(FloatMap(without).max(), 0.5f, 1e-3f);
    for (const char* applyTo : {"ambient", "albedo"})
        EXPECT_EQ(lit(kEmission, {{"applyTo", applyTo}}), without) << applyTo;
    EXPECT_EQ(lit(kEmission, {{"form", "article"}}), without);
}

TEST_F(AoLighting, NothingIsNanOrNegative) {
    for (const Options& options :
         {Options{{"applyTo", "ambient"}}, Options{{"applyTo", "albedo"}}, Options{{"form", "article"}}}) {
        Scene scene = litScene(kDirect);
        scene.ambient = Ambient{glm::vec3(0.8f), glm::vec3(0.6f)};
        // No back wall: sky is in the frame.
        scene.instances.erase(scene.instances.begin() + 1, scene.instances.begin() + 3);
        const Image image = lit(std::move(scene), options);
        for (std::uint32_t y = 0; y < image.height; ++y) {
            for (std::uint32_t x = 0; x < image.width; ++x) {
                const glm::vec4 v = image.at(x, y);
                for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(v[c]) && v[c] >= 0) << x << " " << y;
            }
        }
    }
}

TEST_F(AoLighting, WithoutSsaoItIsThePlainDeferredPipeline) {
    const Image off = lit(kAmbient, {{"ssao", "false"}});
    load("deferred", {}, {{"cc_lighting_resultMap.format", "RGBA32F"}});
    renderer_->setScene(litScene(kAmbient));
    EXPECT_EQ(target(view_, "cc_lighting_resultMap"), off);
}

}  // namespace
}  // namespace crevice
