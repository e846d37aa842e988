// What a scene lacks is left out of the shaders: the picture is that of the whole shader.
#include "FrameFixture.h"

namespace crevice {
namespace {

class LeftOut : public FrameTest {
protected:
    static Light made(LightType type, bool castsShadow) {
        Light light;
        light.type = type;
        light.castsShadow = castsShadow;
        light.position = {-1.5f, 2.5f, 1};
        light.direction = glm::normalize(glm::vec3(1.5f, -2.5f, -1));
        light.intensity = type == LightType::Directional ? 2 : 12;
        return light;
    }
    static Scene boxOnFloor(std::vector<Light> lights, FogType fog = FogType::None) {
        Scene scene = darkScene();
        scene.ambient = Ambient{{0.1f, 0.1f, 0.12f}, {0.05f, 0.05f, 0.05f}};
        addObject(scene, makePlane({8, 8}), glm::mat4(1));
        addObject(scene, makeBox({1, 1, 1}), glm::translate(glm::mat4(1), glm::vec3(0, 0.5f, 0)));
        scene.lights = std::move(lights);
        scene.fog = {.type = fog, .color = {0.3f, 0.4f, 0.5f}, .start = 1, .end = 9, .density = 0.2f};
        scene.exposureEv = 0;
        return scene;
    }
};

TEST_F(LeftOut, ChangesNoPicture) {
    const Light sun = made(LightType::Directional, true), plainSun = made(LightType::Directional, false);
    const Light point = made(LightType::Point, true), spot = made(LightType::Spot, true);
    const std::vector<std::pair<std::string, Scene>> scenes = {
        {"ambient alone", boxOnFloor({})},
        {"sun", boxOnFloor({sun})},
        {"sun without a shadow", boxOnFloor({plainSun})},
        {"point light", boxOnFloor({point})},
        {"sun and spot light", boxOnFloor({sun, spot})},
        {"fog", boxOnFloor({plainSun}, FogType::Exp)},
    };
    View view{.width = 96, .height = 54};
    view.camera = Camera::lookAt({1, 3, 4}, {0, 0.3f, 0});
    for (const auto& [pipeline, stage] :
         {std::pair("deferred", "LightingStage"), std::pair("forward", "ForwardStage")}) {
        const std::string defines = std::string(stage) + ".defines.";
        std::vector<Image> pictures;
        load(pipeline);
        for (const auto& [name, scene] : scenes) {
            renderer_->setScene(scene);
            pictures.push_back(renderer_->render(view));
        }
        load(pipeline, {},
             {{defines + "CC_LIGHTS", "2"}, {defines + "CC_MAIN_SHADOW", "1"}, {defines + "CC_FOG", "1"}});
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            renderer_->setScene(scenes[i].second);
            EXPECT_LE(largestByteDifference(renderer_->render(view), pictures[i]), 1)
                << pipeline << ", " << scenes[i].first;
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_GT(largestByteDifference(pictures[i], pictures[j]), 4)
                    << scenes[i].first << ", " << scenes[j].first;
        }
    }
}

// The shadow maps stay written, and a document may go on listing them.
TEST_F(LeftOut, ListedShadowMapsAreNoMistakeInASceneWithoutShadows) {
    load("deferred", {}, {{"LightingStage.reads", R"(["cc_shadowMap", "cc_spotLightingMap"])"}});
    renderer_->setScene(boxOnFloor({}));
    EXPECT_NO_THROW(renderer_->render({.width = 32, .height = 18}));
}

}  // namespace
}  // namespace crevice
