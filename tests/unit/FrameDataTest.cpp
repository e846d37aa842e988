// The frame's blocks, value by value: camera, light, fog, packed lights, and the automatic exposure.
#include "flow/FrameData.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/Primitives.h"

namespace crevice {
namespace {

constexpr float kPi = 3.14159265358979f;

Light lightOf(LightType type, float intensity, const glm::vec3& position = {0, 0, 0}) {
    Light light;
    light.type = type;
    light.intensity = intensity;
    light.position = position;
    return light;
}

FrameView viewAt(const glm::vec3& eye) {
    FrameView view;
    view.camera = Camera::lookAt(eye, {0, 0, 0});
    view.camera.near = 0.5f;
    view.camera.far = 50;
    view.extent = {640, 360};
    view.projection = view.camera.projection(16.0f / 9.0f);
    view.exposure = 0.25f;
    view.frameIndex = 7;
    view.time = 12.75f;
    view.deltaTime = 0.5f;
    return view;
}

void expectNear(const glm::mat4& a, const glm::mat4& b, float tolerance) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) EXPECT_NEAR(a[c][r], b[c][r], tolerance) << c << ',' << r;
}

TEST(FrameData, AutomaticLengthIsAFortiethOfTheDiagonalWithinLimits) {
    Aabb box;
    EXPECT_EQ(automaticLength(box), 1) << "a scene without surfaces";
    box.add(glm::vec3(0));
    EXPECT_EQ(automaticLength(box), 1) << "a point";
    box.add(glm::vec3(1e-7f, 0, 0));
    EXPECT_EQ(automaticLength(box), 2e-6f);
    box.add(glm::vec3(3, 4, 12));
    EXPECT_FLOAT_EQ(automaticLength(box), 13.0f / 40);
    box.add(glm::vec3(1e9f));
    EXPECT_FLOAT_EQ(automaticLength(box), 1e6f);
}

TEST(FrameData, GlobalBlockHoldsTimeAndSizes) {
    const GlobalBlock block = globalBlock(viewAt({0, 0, 5}));
    EXPECT_EQ(block.time, glm::vec4(12.75f, 0.5f, 7, 0.75f));
    EXPECT_EQ(block.screenSize, glm::vec4(640, 360, 1.0f / 640, 1.0f / 360));
    EXPECT_EQ(block.nativeSize, block.screenSize);
}

TEST(FrameData, CameraBlockHoldsMatricesAndTheirInverses) {
    const FrameView view = viewAt({1, 2, 5});
    const CameraBlock block = cameraBlock(view, Scene{});
    EXPECT_EQ(block.view, view.camera.view);
    EXPECT_EQ(block.proj, view.projection);
    EXPECT_LT(block.proj[1][1], 0);  // y points down in Vulkan's clip space
    expectNear(block.view * block.viewInv, glm::mat4(1), 1e-5f);
    expectNear(block.proj * block.projInv, glm::mat4(1), 1e-5f);
    expectNear(block.viewProj * block.viewProjInv, glm::mat4(1), 1e-4f);
    EXPECT_EQ(block.position.w, 0);
    EXPECT_LT(glm::length(glm::vec3(block.position) - glm::vec3(1, 2, 5)), 1e-5f);
    EXPECT_EQ(block.exposure, glm::vec4(0.25f, 4, 1, 1));
}

TEST(FrameData, TheFirstDirectionalLightIsTheMainOne) {
    Scene scene;
    EXPECT_EQ(cameraBlock(viewAt({0, 0, 5}), scene).mainLitColor, glm::vec4(0));
    scene.lights = {lightOf(LightType::Point, 3), lightOf(LightType::Directional, 2),
                    lightOf(LightType::Directional, 9)};
    scene.lights[1].color = {1, 0.5f, 0.25f};
    scene.lights[1].direction = {0, -1, 0};
    CameraBlock block = cameraBlock(viewAt({0, 0, 5}), scene);
    EXPECT_EQ(block.mainLitDir, glm::vec4(0, -1, 0, 1));
    EXPECT_EQ(block.mainLitColor, glm::vec4(1, 0.5f, 0.25f, 2));
    scene.lights[1].castsShadow = false;
    block = cameraBlock(viewAt({0, 0, 5}), scene);
    EXPECT_EQ(block.mainLitDir.w, 0);
}

TEST(FrameData, AmbientAndFogAreTheScenes) {
    Scene scene;
    CameraBlock block = cameraBlock(viewAt({0, 0, 5}), scene);
    EXPECT_EQ(glm::vec3(block.ambientSky), glm::vec3(0));
    EXPECT_EQ(block.fogAdd.w, 0);
    scene.ambient = Ambient{{1, 2, 3}, {4, 5, 6}};
    scene.fog = {.type = FogType::Exp2, .color = {0.1f, 0.2f, 0.3f}, .start = 4, .end = 5, .density = 6};
    block = cameraBlock(viewAt({0, 0, 5}), scene);
    EXPECT_EQ(block.ambientSky, glm::vec4(1, 2, 3, 1));
    EXPECT_EQ(block.ambientGround, glm::vec4(4, 5, 6, 0));
    EXPECT_EQ(block.fogColor, glm::vec4(0.1f, 0.2f, 0.3f, 1));
    EXPECT_EQ(block.fogBase, glm::vec4(4, 5, 6, 0));
    EXPECT_EQ(block.fogAdd.w, 3);
}

std::vector<PunctualLight> unpack(const Scene& scene, glm::uvec4& count) {
    const std::vector<std::byte> bytes = punctualLights(scene);
    std::memcpy(&count, bytes.data(), sizeof count);
    std::vector<PunctualLight> lights((bytes.size() - sizeof count) / sizeof(PunctualLight));
    std::memcpy(lights.data(), bytes.data() + sizeof count, lights.size() * sizeof(PunctualLight));
    return lights;
}

TEST(FrameData, PunctualLightsAreAllButTheMainOneInOrder) {
    Scene scene;
    glm::uvec4 count;
    EXPECT_EQ(unpack(scene, count).size(), 1u);  // a buffer is never empty
    EXPECT_EQ(count, glm::uvec4(0));

    scene.lights = {lightOf(LightType::Point, 3, {1, 2, 3}), lightOf(LightType::Directional, 2),
                    lightOf(LightType::Spot, 5, {4, 5, 6}), lightOf(LightType::Directional, 7)};
    scene.lights[0].range = 8;
    scene.lights[0].color = {0.5f, 0.25f, 1};
    scene.lights[2].direction = {1, 0, 0};
    scene.lights[2].innerAngle = kPi / 6;
    scene.lights[2].outerAngle = kPi / 3;
    const std::vector<PunctualLight> lights = unpack(scene, count);
    EXPECT_EQ(count.x, 3u);
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_EQ(lights[0].positionRange, glm::vec4(1, 2, 3, 8));
    EXPECT_EQ(lights[0].colorIntensity, glm::vec4(0.5f, 0.25f, 1, 3));
    EXPECT_EQ(lights[0].directionType.w, 0);
    EXPECT_EQ(lights[1].directionType, glm::vec4(1, 0, 0, 1));
    EXPECT_NEAR(lights[1].cone.x, 0.5f, 1e-6f);
    EXPECT_NEAR(lights[1].cone.y, 1 / (0.8660254f - 0.5f), 1e-5f);
    EXPECT_EQ(lights[2].directionType.w, 2);
    EXPECT_EQ(lights[2].colorIntensity.w, 7);
    // A cone with a sharp edge divides by no zero.
    scene.lights[2].innerAngle = scene.lights[2].outerAngle;
    EXPECT_FLOAT_EQ(unpack(scene, count)[1].cone.y, 1000);
}

TEST(FrameData, TheForwardBlockTakesTenPointAndSpotLights) {
    Scene scene;
    scene.lights.push_back(lightOf(LightType::Directional, 1));
    for (int i = 0; i < 12; ++i) {
        scene.lights.push_back(lightOf(i % 2 ? LightType::Spot : LightType::Point, float(i), {float(i), 0, 0}));
        scene.lights.back().range = 2;
        scene.lights.back().outerAngle = kPi / 3;
    }
    const ForwardLightBlock block = forwardLightBlock(scene);
    EXPECT_EQ(block.direction[0].w, 10);
    EXPECT_EQ(block.position[9], glm::vec4(9, 0, 0, 1));
    EXPECT_EQ(block.position[8], glm::vec4(8, 0, 0, 0));
    EXPECT_EQ(block.color[4].w, 4);
    EXPECT_EQ(block.sizeRangeAngle[3].y, 2);
    EXPECT_NEAR(block.sizeRangeAngle[3].z, 0.5f, 1e-6f);
    EXPECT_EQ(block.sizeRangeAngle[2].z, 0);
    EXPECT_EQ(forwardLightBlock(Scene{}).direction[0].w, 0);
}

TEST(FrameData, AStopHalvesTheExposure) {
    EXPECT_FLOAT_EQ(exposureFromEv(0), 1 / 1.2f);
    EXPECT_FLOAT_EQ(exposureFromEv(3), exposureFromEv(2) / 2);
    EXPECT_FLOAT_EQ(exposureFromEv(-1), exposureFromEv(0) * 2);
}

/// What a white diffuse surface of that illuminance becomes under the automatic exposure.
float whiteAt(const Scene& scene, float illuminance) {
    return exposureFromEv(autoExposureEv(scene)) * illuminance / kPi;
}

TEST(FrameData, AutomaticExposureBringsWhiteToFourFifths) {
    Scene scene;
    EXPECT_FLOAT_EQ(exposureFromEv(autoExposureEv(scene)), 1);  // nothing but emission
    for (const float lux : {0.01f, 1.0f, 100000.0f}) {
        scene.lights = {lightOf(LightType::Directional, lux)};
        EXPECT_NEAR(whiteAt(scene, lux * 0.70710678f), 0.8f, 1e-5f) << lux;  // light from 45 degrees
    }
    scene.lights.clear();
    scene.ambient = Ambient{{2, 2, 2}, {1, 1, 1}};
    EXPECT_NEAR(whiteAt(scene, kPi * 1.5f), 0.8f, 1e-5f);
}

TEST(FrameData, AutomaticExposureCountsLampsByTheSceneSize) {
    Scene scene;
    scene.meshes.push_back(makeBox({3, 4, 12}));  // diagonal 13
    updateBounds(scene.meshes[0]);
    scene.instances.resize(1);
    scene.lights = {lightOf(LightType::Point, 10), lightOf(LightType::Spot, 10)};
    const float reach = 13.0f / 4;
    EXPECT_NEAR(whiteAt(scene, 20 / (reach * reach)), 0.8f, 1e-5f);
    // Outside of the scene its distance counts as well: 5 beyond a corner.
    const glm::vec3 corner(1.5f, 2, 6);
    scene.lights[0].position = scene.lights[1].position = corner + glm::vec3(3, 4, 0);
    EXPECT_NEAR(whiteAt(scene, 20 / ((reach + 5) * (reach + 5))), 0.8f, 1e-5f);
    scene.lights[0].position = scene.lights[1].position = 0.9f * corner;
    EXPECT_NEAR(whiteAt(scene, 20 / (reach * reach)), 0.8f, 1e-5f);
    // One whose light ends before the scene does not count, nor does a spot that looks away from it.
    scene.lights[0].position = scene.lights[1].position = corner + glm::vec3(3, 4, 0);
    scene.lights[0].range = 4.9f;
    EXPECT_NEAR(whiteAt(scene, 10 / ((reach + 5) * (reach + 5))), 0.8f, 1e-5f);
    scene.lights[0].range = 5.1f;
    scene.lights[1].direction = glm::normalize(glm::vec3(3, 4, 0));
    EXPECT_NEAR(whiteAt(scene, 10 / ((reach + 5) * (reach + 5))), 0.8f, 1e-5f);
    scene.lights[1].direction *= -1.0f;
    EXPECT_NEAR(whiteAt(scene, 20 / ((reach + 5) * (reach + 5))), 0.8f, 1e-5f);
    scene.lights[0].range = 0;
    scene.lights[0].position = 0.9f * corner;
    // Luminance, not a channel's value: green counts most.
    scene.lights.resize(1);
    scene.lights[0].color = {0, 1, 0};
    EXPECT_NEAR(whiteAt(scene, 0.7152f * 10 / (reach * reach)), 0.8f, 1e-5f);
    // Scaling the scene and its lights together changes nothing.
    const float before = autoExposureEv(scene);
    scene.instances[0].world = glm::scale(glm::mat4(1), glm::vec3(1000));
    scene.lights[0].intensity *= 1e6f;
    EXPECT_NEAR(autoExposureEv(scene), before, 1e-4f);
}

}  // namespace
}  // namespace crevice
