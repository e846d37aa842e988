// SsaoStage as a whole: constants in the shader or a block, seeds, and what each property does.
#include "AoFixture.h"

namespace crevice {
namespace {

Scene boxesScene() {
    Scene scene = wallScene();
    addBox(scene, {0.7f, 0.4f, 0.4f}, {0.8f, 0.8f, 0.8f});
    addBox(scene, {1.6f, 0.3f, -0.7f}, {0.6f, 0.6f, 0.6f});
    return scene;
}

class AoStage : public AoTest {
protected:
    void SetUp() override {
        AoTest::SetUp();
        Camera camera = Camera::lookAt({4, 3, 2}, {0.5f, 0.2f, 0});
        camera.near = 0.1f;
        camera.far = 100;
        view_ = viewOf(camera, 80, 60);
    }
    Image rendered(const std::string& form, std::vector<StageSet> sets) {
        loadMap(form, std::move(sets));
        renderer_->setScene(boxesScene());
        return target(view_, "cc_ssaoMap");
    }
    /// The default form with radius 1 and exponent 1, and one more property.
    FloatMap withProperty(const std::string& name, const std::string& value) {
        return FloatMap(rendered("default", {{"SsaoStage.material.radius", "1"},
                                             {"SsaoStage.material.power", "1"},
                                             {"SsaoStage.material." + name, value}}));
    }
    std::string bakedFor(const RunInfo& run, const std::string& samples, const std::string& bake = "auto") {
        loadMap("default", {{"SsaoStage.params.bake", bake}, {"SsaoStage.params.samples", samples}}, run);
        return stage("SsaoStage").declaration.draws.at(0).defines.at("SSAO_BAKED");
    }
    View view_;
};

TEST_F(AoStage, BakedKernelGivesTheSameBytes) {
    for (const char* form : {"default", "article"}) {
        for (const char* kernel : {"stratified", "article"}) {
            std::vector<Image> images;
            for (const char* bake : {"on", "off"})
                images.push_back(rendered(form, {{"SsaoStage.params.bake", bake},
                                                 {"SsaoStage.params.kernel", kernel},
                                                 {"SsaoStage.material.radius", "1"}}));
            EXPECT_LT(FloatMap(images[0]).min(), 0.9f);
            EXPECT_EQ(images[0], images[1]) << form << " " << kernel;
        }
    }
}

TEST_F(AoStage, BakesWhereTheRunIsLongEnough) {
    EXPECT_EQ(bakedFor({.width = 1280, .height = 720, .frames = 1}, "64"), "1");
    EXPECT_EQ(bakedFor({.width = 1280, .height = 720, .frames = 1}, "8"), "0");
    EXPECT_EQ(bakedFor({.width = 1280, .height = 720, .frames = 10}, "8"), "1");
    EXPECT_EQ(bakedFor({.width = 160, .height = 90, .frames = 1}, "64"), "0");
    EXPECT_EQ(bakedFor({.width = 1280, .height = 720, .frames = 10}, "8", "off"), "0");
    EXPECT_EQ(bakedFor({.width = 1, .height = 1, .frames = 1}, "8", "on"), "1");
}

TEST_F(AoStage, PropertiesAreNeverCompiledIn) {
    rendered("default", {{"SsaoStage.params.bake", "on"}});
    const EffectLibrary::Counters before = renderer_->effects().counters();
    rendered("default", {{"SsaoStage.params.bake", "on"},
                         {"SsaoStage.material.radius", "0.7"},
                         {"SsaoStage.material.bias", "2"},
                         {"SsaoStage.material.power", "3"},
                         {"SsaoStage.material.intensity", "0.5"}});
    const EffectLibrary::Counters after = renderer_->effects().counters();
    EXPECT_EQ(after.compiled, before.compiled);
    EXPECT_EQ(after.fromDisk, before.fromDisk);
    EXPECT_GT(after.fromMemory, before.fromMemory);
}

TEST_F(AoStage, SameSeedSameBytesInAnotherRun) {
    std::vector<Image> images;
    for (const char* seed : {"3", "3", "4"}) {
        images.push_back(rendered("default", {{"SsaoStage.params.seed", seed}, {"SsaoStage.material.radius", "1"}}));
        renderer_->device().waitIdle();
        EXPECT_EQ(renderer_->device().validationMessageCount(), 0u);
        renderer_ = makeRenderer();
    }
    EXPECT_EQ(images[0], images[1]);
    EXPECT_NE(images[0], images[2]);
}

TEST_F(AoStage, IntensityScalesAndPowerBends) {
    EXPECT_EQ(withProperty("intensity", "0").min(), 1);
    const FloatMap plain = withProperty("intensity", "1");
    const FloatMap half = withProperty("intensity", "0.5");
    const FloatMap squared = withProperty("power", "2");
    ASSERT_LT(plain.min(), 0.8f);
    for (std::size_t i = 0; i < plain.values.size(); ++i) {
        ASSERT_NEAR(1 - half.values[i], 0.5f * (1 - plain.values[i]), 1e-5f);
        ASSERT_NEAR(squared.values[i], plain.values[i] * plain.values[i], 1e-5f);
    }
}

TEST_F(AoStage, TinyRadiusFadesToWhite) {
    // The frame is 60 pixels high and about 4 world units: a radius of .01 is a sixth of a pixel.
    EXPECT_EQ(withProperty("radius", "0.01").min(), 1);
    EXPECT_LT(withProperty("radius", "0.5").min(), 0.8f);
    // In between it fades: darker with every step of the radius.
    double before = 1;
    for (const char* radius : {"0.1", "0.15", "0.2", "0.3"}) {
        const double mean = withProperty("radius", radius).mean();
        EXPECT_LE(mean, before) << radius;
        before = mean;
    }
    EXPECT_LT(before, 0.999);
}

TEST_F(AoStage, HugeRadiusIsClamped) {
    // Half the frame's height, or nine tenths of the way to the near plane: beyond that nothing grows, least of all the
    // work.
    const FloatMap large = withProperty("radius", "1000");
    const FloatMap larger = withProperty("radius", "1000000");
    EXPECT_EQ(large.values, larger.values);
    EXPECT_LT(large.min(), 0.8f);

    // In a parallel view of 2 units' height the longest radius is 1, though depth would allow more.
    view_.camera->orthographic = true;
    view_.camera->orthoHeight = 2;
    EXPECT_LE(meanDifference(withProperty("radius", "1"), withProperty("radius", "1000")), 0.1 * kByteStep);
    EXPECT_GT(meanDifference(withProperty("radius", "1"), withProperty("radius", "0.5")), kByteStep);
}

TEST_F(AoStage, SkyIsWhiteAndEdgesBeforeSkyAreToo) {
    loadMap("default", {{"SsaoStage.material.radius", "1"}});
    Scene scene = emptyScene();
    addBox(scene, {0, 0, 0}, {1, 1, 1});
    renderer_->setScene(scene);
    const FloatMap depth = map(view_, "viewDepth");
    ASSERT_GT(depth.max(), 1e8f);
    ASSERT_LT(depth.min(), 10.0f);
    // A convex body alone: everything is open, sky, faces and silhouettes.
    EXPECT_EQ(map(view_).min(), 1);
}

TEST_F(AoStage, HalfSizeMapIsTheSamePicture) {
    const FloatMap full(rendered("default", {{"SsaoStage.material.radius", "1"}}));
    const FloatMap half(rendered("default", {{"SsaoStage.material.radius", "1"}, {"cc_ssaoMap.scale", "0.5"}}));
    ASSERT_EQ(half.width, full.width / 2);
    EXPECT_NEAR(half.mean(), full.mean(), 0.01);
}

TEST_F(AoStage, NoNormalMakesNan) {
    // Squares that face every direction of a coarse grid, axes included.
    loadMap("default", {{"SsaoStage.material.radius", "1"}});
    Scene scene = emptyScene();
    for (int i = 0; i < 27; ++i) {
        const glm::vec3 normal(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (normal == glm::vec3(0)) continue;
        addSquare(scene, normal * 0.8f, normal, 0.7f);
    }
    renderer_->setScene(scene);
    for (const glm::vec3& eye :
         {glm::vec3(4, 0, 0), glm::vec3(0, 4, 0), glm::vec3(0, 0, 4), glm::vec3(0, 0, -4), glm::vec3(2, 3, 4)}) {
        Camera camera = Camera::lookAt(eye, {0, 0, 0});
        camera.near = 0.1f;
        camera.far = 50;
        for (float v : map(viewOf(camera, 60, 60)).values) ASSERT_TRUE(v >= 0 && v <= 1) << v;
    }
}

}  // namespace
}  // namespace crevice
