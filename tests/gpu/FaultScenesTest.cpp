// Faults of the device while a scene brings more than meshes: an environment with its cube, lights in a grid, textures,
// and Cocos' own effects. As FaultTest: every one is an Error in words, and the same renderer works again.
#include <functional>

#include "CocosFixture.h"
#include "EnvironmentFixture.h"

namespace crevice {
namespace {

using testing::HasSubstr;

std::string errorOf(const std::function<Image()>& render) {
    try {
        render();
    } catch (const RenderError& error) {
        return formatError(error);
    }
    return "";
}

/// Lets allocations fail in turn (every `step`th), then submissions, and expects the picture to come out right again.
void expectRecovery(Renderer& renderer, const std::function<Image()>& render, int step, int leastAllocations) {
    const Image expected = render();
    int allocations = 0;
    for (;; allocations += step) {
        renderer.device().setFaults({.failAllocation = allocations});
        const std::string error = errorOf(render);
        if (error.empty()) break;
        SCOPED_TRACE(allocations);
        ASSERT_THAT(error, HasSubstr("out of GPU memory: '"));
    }
    EXPECT_GE(allocations, leastAllocations);
    int submissions = 0;
    for (;; ++submissions) {
        renderer.device().setFaults({.loseDevice = submissions});
        const std::string error = errorOf(render);
        if (error.empty()) break;
        SCOPED_TRACE(submissions);
        ASSERT_THAT(error, HasSubstr("was lost while it ran '"));
    }
    EXPECT_GE(submissions, 2);
    renderer.device().setFaults({});
    EXPECT_EQ(render(), expected);
}

class FaultsOfEnvironments : public EnvironmentFrames {};

TEST_F(FaultsOfEnvironments, EveryAllocationAndSubmissionMayFail) {
    Scene scene = darkScene();
    addFloor(scene, 4);
    scene.environment = uniform(glm::vec3(0.5f));
    for (int i = 0; i < 20; ++i) {  // more than stand in a list: a grid
        Light light;
        light.type = LightType::Point;
        light.position = {float(i % 5) - 2, 0.5f, float(i / 5) - 2};
        light.range = 1;
        light.castsShadow = false;
        scene.lights.push_back(light);
    }
    load("deferred");
    const auto render = [&] {
        renderer_->setScene(scene);
        return renderer_->render({.width = 32, .height = 18});
    };
    expectRecovery(*renderer_, render, 1, 5);
}

class FaultsOfCocos : public CocosTest {};

TEST_F(FaultsOfCocos, EveryThirdAllocationAndEverySubmissionMayFail) {
    loadArticle("article-v36");
    const Scene scene = withEffects(cloister());
    const auto render = [&] {
        renderer_->setScene(scene);
        return renderer_->render({.width = 32, .height = 18});
    };
    expectRecovery(*renderer_, render, 3, 6);
    takeWarnings();
}

}  // namespace
}  // namespace crevice
