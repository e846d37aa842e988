// The sky of pipelines with a Cocos profile: shown where nothing was drawn, exposed and encoded as lit surfaces are,
// and turned as our own pipelines show it.
#include "CocosFixture.h"

#include <array>
#include <cmath>

#include "EnvironmentFixture.h"

namespace crevice {
namespace {

class CocosSky : public CocosTest {
protected:
    /// An exposure of 1.
    static Scene exposedScene() {
        Scene scene = darkScene();
        scene.exposureEv = std::log2(1 / 1.2f);
        return scene;
    }
    struct Environments : EnvironmentFrames {
        using EnvironmentFrames::axes;
        using EnvironmentFrames::uniform;
        void TestBody() override {}
    };
    static Image shown(Renderer& renderer, const Scene& scene, std::uint32_t width, std::uint32_t height) {
        renderer.setScene(scene);
        View view{.width = width, .height = height};
        view.camera = Camera::lookAt({0, 0, 0}, {0.4f, 0.2f, -1});
        return renderer.render(view);
    }
};

TEST_F(CocosSky, IsExposedAndEncodedOnce) {
    Scene scene = exposedScene();
    scene.environment = Environments::uniform({0.5f, 0.25f, 1});
    // sqrt of x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), by hand.
    const glm::vec3 expected(0.7851f, 0.6117f, 0.8965f);
    for (const char* article : kBoth) {
        renderer_ = makeRenderer();
        loadArticle(article);
        const glm::vec4 pixel = shown(*renderer_, scene, 16, 8).at(3, 2);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], expected[c], 1.5f / 255) << article << ' ' << c;
        EXPECT_EQ(pixel.w, 1.0f);
        Scene hidden = scene;
        hidden.environment->visible = false;
        EXPECT_LT(shown(*renderer_, hidden, 16, 8).at(3, 2).x, 0.2f) << article;
        takeWarnings();
    }
}

TEST_F(CocosSky, OneThatLightsNothingIsShownAllTheSame) {
    Scene scene = exposedScene();
    addWall(scene, 1, {0, 0, -3});
    scene.materials[0].baseColor = {1, 1, 1, 1};
    scene.environment = Environments::uniform({0.5f, 0.5f, 0.5f});
    scene.environment->lights = false;
    scene.ambient = Ambient{.sky = {0, 0.5f, 0}, .ground = {0, 0.5f, 0}};
    loadArticle("article-v36");
    renderer_->setScene(withEffects(scene));
    View view{.width = 16, .height = 16};
    view.camera = Camera::lookAt({0, 0, 0}, {0, 0, -1});
    const Image image = renderer_->render(view);
    EXPECT_NEAR(image.at(0, 0).x, 0.7851f, 1.5f / 255);  // beside the wall
    EXPECT_LT(image.at(8, 8).x, 0.1f);                   // the wall has the ambient light's green alone
    EXPECT_GT(image.at(8, 8).y, 0.3f);
    takeWarnings();
}

TEST_F(CocosSky, GradientsOfOurOwnScenesAreShown) {
    Scene scene = exposedScene();
    scene.sky = {.enabled = true, .zenith = glm::vec3(0.5f), .horizon = glm::vec3(0.5f), .nadir = glm::vec3(0.5f)};
    loadArticle("article-v33");
    EXPECT_NEAR(shown(*renderer_, scene, 16, 8).at(3, 2).y, 0.7851f, 1.5f / 255);
    takeWarnings();
}

TEST_F(CocosSky, LooksTheWayOurOwnPipelinesShowIt) {
    Scene scene = exposedScene();
    scene.environment = Environments::axes();
    scene.environment->rotation = 0.7f;
    load("deferred", {{"shadows", "false"}, {"fxaa", "false"}});
    const Image own = shown(*renderer_, scene, 64, 32);
    const auto colorAt = [](const Image& image, std::uint32_t x, std::uint32_t y) {
        const glm::vec4 texel = image.at(x, y);
        return std::array<bool, 3>{texel.x > 0.4f, texel.y > 0.4f, texel.z > 0.4f};
    };
    for (const char* article : kBoth) {
        renderer_ = makeRenderer();
        loadArticle(article);
        const Image here = shown(*renderer_, scene, 64, 32);
        int other = 0;
        std::set<std::array<bool, 3>> seen;
        for (std::uint32_t y = 0; y < 32; ++y) {
            for (std::uint32_t x = 0; x < 64; ++x) {
                other += colorAt(own, x, y) != colorAt(here, x, y) ? 1 : 0;
                seen.insert(colorAt(here, x, y));
            }
        }
        EXPECT_LT(other, 64 * 32 / 25) << article;  // where two sides meet they are blurred
        EXPECT_GE(seen.size(), 2u) << article;
        takeWarnings();
    }
}

}  // namespace
}  // namespace crevice
