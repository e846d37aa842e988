// Many objects and many lights: instancing, kept draw lists and the grid of lights change the cost, never the picture.
#include <algorithm>

#include "FrameFixture.h"

namespace crevice {
namespace {

class Scale : public FrameTest {
protected:
    /// Our own numbers from 0 to 1.
    float next() {
        state_ = state_ * 1664525u + 1013904223u;
        return static_cast<float>(state_ >> 8) / 16777216.0f;
    }
    /// Ten meshes in a square of side × side, lit by one directional light.
    static Scene field(int side) {
        Scene scene = darkScene();
        for (int i = 0; i < 10; ++i) scene.meshes.push_back(makeBox({0.3f, 0.2f + 0.05f * float(i), 0.3f}));
        for (int i = 0; i < side * side; ++i) {
            Instance instance;
            instance.mesh = i % 10;
            instance.world =
                glm::translate(glm::mat4(1), {0.5f * float(i % side - side / 2), 0, 0.5f * float(i / side - side / 2)});
            scene.instances.push_back(instance);
        }
        Light sun;
        sun.direction = glm::normalize(glm::vec3(1, -2, -1));
        sun.intensity = 3;
        scene.lights.push_back(sun);
        return scene;
    }
    static View viewFrom(const glm::vec3& eye) {
        View view{.width = 96, .height = 54};
        view.camera = Camera::lookAt(eye, {0, 0, 0});
        return view;
    }
    static std::size_t differingPixels(const Image& a, const Image& b) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < a.pixels.size(); i += 4)
            if (std::abs(std::to_integer<int>(a.pixels[i]) - std::to_integer<int>(b.pixels[i])) > 1) ++count;
        return count;
    }
    static double mean(const Image& image) {
        double sum = 0;
        for (const std::byte b : image.pixels) sum += std::to_integer<int>(b);
        return sum / double(image.pixels.size());
    }

    std::uint32_t state_ = 3;
};

// Each queue (the shadow's and the picture's) draws each of the ten meshes once; post-process is one draw more.
TEST_F(Scale, InstancesOfAMeshAreOneDrawCall) {
    load("forward");
    renderer_->setScene(field(40));
    renderer_->render(viewFrom({0, 30, 1}));
    const std::uint64_t draws = renderer_->pipeline().drawCount();
    EXPECT_GE(draws, 20u);
    EXPECT_LE(draws, 24u);
}

TEST_F(Scale, InstancingDrawsWhatSingleObjectsDraw) {
    load("forward");
    const View view = viewFrom({3, 2, 4});
    Scene shared = field(12);
    renderer_->setScene(shared);
    const Image together = renderer_->render(view);
    Scene apart = shared;
    apart.meshes.clear();
    for (Instance& instance : apart.instances) {
        apart.meshes.push_back(shared.meshes[std::size_t(instance.mesh)]);
        instance.mesh = int(apart.meshes.size()) - 1;
    }
    renderer_->setScene(apart);
    const Image single = renderer_->render(view);
    EXPECT_GT(renderer_->pipeline().drawCount(), 144u);
    EXPECT_EQ(together, single);
    EXPECT_GT(mean(together), 70);
}

// Indices of 32 bits (90,601 vertices) and of 16 in one scene: a fine plane looks like a coarse one.
TEST_F(Scale, BigAndSmallMeshesStandSideBySide) {
    load("forward");
    const View view = viewFrom({3, 2, 4});
    const auto draw = [&](std::uint32_t segments) {
        Scene scene = field(3);
        addObject(scene, makePlane({6, 6}, segments), glm::translate(glm::mat4(1), {0, -0.3f, 0}));
        renderer_->setScene(scene);
        return renderer_->render(view);
    };
    const Image fine = draw(300), coarse = draw(3);
    EXPECT_LE(differingPixels(fine, coarse), 10u) << "more than a few pixels of the rim";
    EXPECT_GT(mean(fine), 80);
}

TEST_F(Scale, DrawListsAreKeptForAViewAndMadeAnewForAnother) {
    load("forward");
    renderer_->setScene(field(12));
    const View near = viewFrom({1, 0.5f, 1}), wide = viewFrom({0, 12, 1});
    const Image first = renderer_->render(near);
    EXPECT_EQ(renderer_->render(near), first);
    const Image other = renderer_->render(wide);  // sees more: its rows need a larger buffer
    EXPECT_NE(other, first);
    EXPECT_EQ(renderer_->render(near), first);
    EXPECT_EQ(renderer_->render(wide), other);
}

TEST_F(Scale, ManyLightsLookLikeBruteForce) {
    Scene scene = darkScene();
    addWall(scene, 10);
    addObject(scene, makeSphere(1.5f, 24), glm::translate(glm::mat4(1), {1, 0, 1}));
    scene.materials[0].roughness = 0.4f;
    for (int i = 0; i < 300; ++i) {
        Light light;
        light.type = i % 3 == 0 ? LightType::Spot : LightType::Point;
        const float x = next(), y = next(), z = next();
        light.position = {10 * x - 5, 10 * y - 5, 2.5f * z};
        light.direction = {0, 0, -1};
        light.range = 0.4f + next();
        light.intensity = 0.3f * light.range * light.range;
        light.color = {next(), next(), next()};
        light.castsShadow = false;
        scene.lights.push_back(light);
    }
    const View view = viewFrom({2, 3, 9});
    for (const auto& [pipeline, stage] :
         {std::pair("deferred", "LightingStage"), std::pair("forward", "ForwardStage")}) {
        load(pipeline);
        renderer_->setScene(scene);
        const Image culled = renderer_->render(view);
        load(pipeline, {}, {{std::string(stage) + ".defines.BRUTE_FORCE_LIGHTS", "true"}});
        const Image brute = renderer_->render(view);
        EXPECT_LE(largestByteDifference(culled, brute), 1) << pipeline;
        Scene dark = scene;
        dark.lights.clear();
        renderer_->setScene(dark);
        EXPECT_GT(mean(brute), mean(renderer_->render(view)) + 10) << pipeline;
    }
}

// Twenty lights without a range in a hall so long that each can be left out at its far end.
TEST_F(Scale, LightsWithoutARangeAreLeftOutOnlyWhereTheyCannotBeSeen) {
    Scene scene = darkScene();
    addObject(scene, makePlane({20, 400}), glm::mat4(1));
    for (int i = 0; i < 20; ++i) {
        Light light;
        light.type = LightType::Point;
        light.position = {0, 1, -195 + 20.0f * float(i)};
        light.intensity = 1;
        light.castsShadow = false;
        scene.lights.push_back(light);
    }
    View view = viewFrom({6, 6, 190});
    view.camera->view = Camera::lookAt({6, 6, 190}, {0, 0, 170}).view;
    load("deferred");
    renderer_->setScene(scene);
    const Image culled = renderer_->render(view);
    load("deferred", {}, {{"LightingStage.defines.BRUTE_FORCE_LIGHTS", "true"}});
    EXPECT_LE(largestByteDifference(culled, renderer_->render(view)), 1);
    EXPECT_GT(mean(culled), 64.2) << "63.75 is black, with alpha 255";
}

TEST_F(Scale, ASceneThatIsNotKeptLooksTheSame) {
    Scene scene = field(12);
    SceneTexture texture;
    texture.image = Image(2, 2, Format::RGBA8);
    for (std::size_t i = 0; i < texture.image.pixels.size(); ++i) texture.image.pixels[i] = std::byte(40 + 13 * i);
    texture.srgb = true;
    scene.textures.push_back(texture);
    scene.materials[0].baseColorMap.texture = 0;
    const View view = viewFrom({3, 2, 4});
    load("forward");
    renderer_->setScene(scene);
    const Image kept = renderer_->render(view);
    EXPECT_FALSE(renderer_->scene().meshes[0].vertices.empty());

    Renderer releasing({.keepScene = false, .defaultLight = false, .log = log_});
    load(releasing, "forward");
    releasing.setScene(scene);
    EXPECT_EQ(releasing.render(view), kept);
    EXPECT_EQ(releasing.render(view), kept);
    for (const Mesh& mesh : releasing.scene().meshes) EXPECT_EQ(mesh.vertices.capacity() + mesh.indices.capacity(), 0u);
    EXPECT_EQ(releasing.scene().textures[0].image.pixels.capacity(), 0u);
    releasing.setScene(field(3));  // the next scene
    EXPECT_NE(releasing.render(view), kept);
}

TEST_F(Scale, UploadsTellHowFarTheyAre) {
    Scene scene = darkScene();
    scene.meshes.push_back(makeSphere(1, 512));  // more vertices than are packed at once
    scene.instances.resize(1);
    scene.textures.resize(4, {.name = "white", .image = Image(256, 256, Format::RGBA8), .srgb = true, .sampler = {}});
    for (const bool keep : {true, false}) {
        std::vector<float> shares;
        Renderer renderer(
            RendererOptions{.validate = true, .keepScene = keep, .log = log_, .uploadProgress = [&](float share) {
                                shares.push_back(share);
                            }});
        load(renderer, "forward");
        EXPECT_TRUE(shares.empty());
        renderer.setScene(scene);
        EXPECT_GE(shares.size(), 6u) << "vertices twice or more, four pictures";
        EXPECT_LE(shares.size(), 101u);
        EXPECT_TRUE(std::ranges::is_sorted(shares));
        EXPECT_EQ(shares.back(), 1);
        expectSilence(renderer);
    }
}

}  // namespace
}  // namespace crevice
