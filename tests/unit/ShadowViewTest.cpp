// Light cameras: everything of the scene is inside, between depth 0 and 1, and no larger than it has to be.
#include "flow/ShadowView.h"

#include <gtest/gtest.h>

namespace crevice {
namespace {

Light lightOf(LightType type, const glm::vec3& direction) {
    Light light;
    light.type = type;
    light.direction = glm::normalize(direction);
    return light;
}

Aabb boxOf(const glm::vec3& low, const glm::vec3& high) {
    Aabb box;
    box.add(low);
    box.add(high);
    return box;
}

glm::vec3 project(const ShadowView& view, const glm::vec3& point) {
    const glm::vec4 clip = view.projection * view.view * glm::vec4(point, 1);
    return glm::vec3(clip) / clip.w;
}

std::vector<glm::vec3> cornersOf(const Aabb& box) {
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 8; ++i)
        corners.emplace_back(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                             i & 4 ? box.max.z : box.min.z);
    return corners;
}

TEST(ShadowView, TheSunSeesTheWholeSceneAndFillsItsMap) {
    const Aabb boxes[] = {boxOf({-1, -1, -1}, {1, 1, 1}), boxOf({-40, 0, 3}, {60, 12, 5}),
                          boxOf({7, 7, 7}, {7.001f, 7.002f, 7.001f}), boxOf({-5, 0, -5}, {5, 0, 5})};
    const glm::vec3 directions[] = {{0, -1, 0}, {0, 1, 0}, {1, 0, 0}, {0.5f, -0.8f, -0.45f}, {-1e-4f, -1, 0}};
    for (const Aabb& box : boxes) {
        for (const glm::vec3& direction : directions) {
            Scene scene;
            scene.lights = {lightOf(LightType::Directional, direction)};
            const auto view = directionalShadowView(scene, box);
            ASSERT_TRUE(view);
            glm::vec3 low(2), high(-2);
            for (const glm::vec3& corner : cornersOf(box)) {
                const glm::vec3 p = project(*view, corner);
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
            EXPECT_GE(std::min(low.x, low.y), -1);
            EXPECT_LE(std::max(high.x, high.y), 1);
            EXPECT_GE(low.z, 0);
            EXPECT_LE(high.z, 1);
            EXPECT_LT(view->near, view->far);
            // The side that decides the texel size uses at least nine tenths of the map, unless the light looks along
            // it.
            const float used = std::max(high.x - low.x, high.y - low.y);
            EXPECT_GT(used, 1.7f) << direction.x << ' ' << direction.y << ' ' << direction.z;
        }
    }
}

TEST(ShadowView, DepthGrowsAlongTheLightAndHandednessIsTheCameras) {
    Scene scene;
    scene.lights = {lightOf(LightType::Directional, {0, -1, 0})};
    const auto view = directionalShadowView(scene, boxOf({-1, -1, -1}, {1, 1, 1}));
    ASSERT_TRUE(view);
    EXPECT_LT(project(*view, {0, 1, 0}).z, project(*view, {0, -1, 0}).z);
    EXPECT_LT(view->projection[1][1], 0);
    EXPECT_NEAR(view->width, 2, 0.1f);
}

TEST(ShadowView, OnlyTheMainLightWithAShadowHasAView) {
    Scene scene;
    const Aabb box = boxOf({-1, -1, -1}, {1, 1, 1});
    EXPECT_EQ(mainLight(scene), nullptr);
    EXPECT_FALSE(directionalShadowView(scene, box));
    scene.lights = {lightOf(LightType::Point, {0, -1, 0}), lightOf(LightType::Directional, {0, -1, 0}),
                    lightOf(LightType::Directional, {1, 0, 0})};
    EXPECT_EQ(mainLight(scene), &scene.lights[1]);
    EXPECT_TRUE(directionalShadowView(scene, box));
    EXPECT_FALSE(directionalShadowView(scene, Aabb{}));
    scene.lights[1].castsShadow = false;
    EXPECT_FALSE(directionalShadowView(scene, box));  // the second directional light has no map of its own
}

TEST(ShadowView, TheSpotSeesItsCone) {
    Scene scene;
    scene.lights = {lightOf(LightType::Directional, {0, -1, 0}), lightOf(LightType::Point, {0, -1, 0}),
                    lightOf(LightType::Spot, {0.2f, -1, 0.1f})};
    scene.lights[2].position = {1, 6, 2};
    scene.lights[2].outerAngle = 0.6f;
    const Aabb box = boxOf({-4, 0, -4}, {4, 3, 4});
    const auto view = spotShadowView(scene, box);
    ASSERT_TRUE(view);
    EXPECT_EQ(view->punctualIndex, 1);  // the main light is not in that list
    const glm::vec3 axis = scene.lights[2].direction;
    const glm::vec3 aside = glm::normalize(glm::cross(axis, glm::vec3(1, 0, 0)));
    for (const float angle : {0.0f, 0.3f, 0.59f, -0.59f}) {
        for (const float distance : {0.1f, 1.0f, 6.0f}) {
            const glm::vec3 ray = axis * std::cos(angle) + aside * std::sin(angle);
            const glm::vec3 p = project(*view, scene.lights[2].position + ray * distance);
            EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 1) << angle << ' ' << distance;
            EXPECT_GT(p.z, 0) << angle << ' ' << distance;
            EXPECT_LT(p.z, 1) << angle << ' ' << distance;
        }
    }
    EXPECT_NEAR(project(*view, scene.lights[2].position + axis).x, 0, 1e-5f);
    // The farthest corner of the scene is within reach; a range ends it earlier.
    EXPECT_GE(view->far, glm::length(glm::vec3(-4, 0, -4) - scene.lights[2].position) - 1e-4f);
    scene.lights[2].range = 3;
    EXPECT_FLOAT_EQ(spotShadowView(scene, box)->far, 3);
    scene.lights[2].castsShadow = false;
    EXPECT_FALSE(spotShadowView(scene, box));
}

TEST(ShadowView, ASpotThatLooksStraightDownOrIsWideIsFinite) {
    for (const float angle : {0.01f, 0.785f, 1.57f}) {
        Scene scene;
        scene.lights = {lightOf(LightType::Spot, {0, -1, 0})};
        scene.lights[0].outerAngle = angle;
        scene.lights[0].position = {0, 2, 0};
        const auto view = spotShadowView(scene, boxOf({-1, 0, -1}, {1, 1, 1}));
        ASSERT_TRUE(view);
        const glm::vec3 p = project(*view, {0, 1, 0});
        EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << angle;
        EXPECT_NEAR(p.x, 0, 1e-5f);
    }
}

}  // namespace
}  // namespace crevice
