// Projections land in Vulkan clip space; framing and depth fitting work from a millimetre to a hundred kilometres.
#include "scene/Camera.h"

#include <cmath>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/Framing.h"
#include "scene/Scene.h"

namespace crevice {
namespace {

glm::vec3 toNdc(const glm::mat4& projection, const glm::vec3& view) {
    const glm::vec4 clip = projection * glm::vec4(view, 1);
    return glm::vec3(clip) / clip.w;
}

Aabb boxOf(const glm::vec3& min, const glm::vec3& max) {
    Aabb box;
    box.add(min);
    box.add(max);
    return box;
}

TEST(Camera, PerspectiveIsVulkanClipSpace) {
    Camera camera;
    camera.fovY = glm::radians(90.0f);
    camera.near = 1;
    camera.far = 100;
    const glm::mat4 p = camera.projection(2);
    EXPECT_FLOAT_EQ(p[1][1], -1);
    EXPECT_FLOAT_EQ(p[0][0], 0.5f);
    EXPECT_NEAR(toNdc(p, {0, 0, -1}).z, 0, 1e-6);
    EXPECT_NEAR(toNdc(p, {0, 0, -100}).z, 1, 1e-6);
    EXPECT_NEAR(toNdc(p, {0, 10, -10}).y, -1, 1e-6);  // up is -y
    EXPECT_NEAR(toNdc(p, {20, 0, -10}).x, 1, 1e-6);
    EXPECT_FLOAT_EQ((p * glm::vec4(0, 0, -7, 1)).w, 7);  // w is the linear view depth
}

TEST(Camera, OrthographicIsVulkanClipSpace) {
    Camera camera;
    camera.orthographic = true;
    camera.orthoHeight = 4;
    camera.near = 1;
    camera.far = 11;
    const glm::mat4 p = camera.projection(2);
    EXPECT_LT(p[1][1], 0);
    const glm::vec3 corner = toNdc(p, {4, 2, -1});
    EXPECT_NEAR(corner.x, 1, 1e-6);
    EXPECT_NEAR(corner.y, -1, 1e-6);
    EXPECT_NEAR(corner.z, 0, 1e-6);
    EXPECT_NEAR(toNdc(p, {0, 0, -11}).z, 1, 1e-6);
}

TEST(Camera, LensShiftMovesEveryDepthEqually) {
    Camera camera;
    camera.near = 1;
    camera.far = 100;
    camera.lensShift = {0.25f, -0.5f};
    EXPECT_FLOAT_EQ(camera.projection(1)[2][0], 0.25f);
    EXPECT_FLOAT_EQ(camera.projection(1)[2][1], -0.5f);
    for (const bool orthographic : {false, true}) {
        camera.orthographic = orthographic;
        for (const float depth : {2.0f, 50.0f}) {
            const glm::vec3 ndc = toNdc(camera.projection(1), {0, 0, -depth});
            EXPECT_NEAR(ndc.x, -0.25f, 1e-6);
            EXPECT_NEAR(ndc.y, 0.5f, 1e-6);
        }
    }
}

TEST(Camera, LookAtSeesTheTargetInTheMiddle) {
    const Camera camera = Camera::lookAt({3, 4, 5}, {-1, 2, 0});
    const glm::vec3 target = glm::vec3(camera.view * glm::vec4(-1, 2, 0, 1));
    EXPECT_NEAR(target.x, 0, 1e-5);
    EXPECT_NEAR(target.y, 0, 1e-5);
    EXPECT_NEAR(target.z, -std::sqrt(45.0f), 1e-4);
    EXPECT_LT(glm::distance(camera.position(), {3, 4, 5}), 1e-5);
}

TEST(Camera, LookAtSurvivesUpAlongTheView) {
    for (const glm::vec3& target : {glm::vec3(0, -1, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 0)}) {
        const Camera camera = Camera::lookAt({0, 0, 0}, target);
        EXPECT_NEAR(glm::determinant(glm::mat3(camera.view)), 1, 1e-5);
    }
}

TEST(Camera, LooksStraightFarFromTheOrigin) {
    const glm::vec3 far(4e5f, -2e5f, 1e5f), direction = glm::normalize(glm::vec3(0.3f, -0.2f, -1));
    const Camera camera = Camera::lookAt(far, far + 1000.0f * direction);
    const glm::vec3 forward = -glm::vec3(glm::row(camera.view, 2));
    EXPECT_NEAR(glm::distance(forward, direction), 0, 1e-4);
    EXPECT_NEAR(glm::distance(camera.position(), far), 0, 1);
}

TEST(Camera, FramesBoxesOfEverySize) {
    for (const float size : {0.001f, 1.0f, 1000.0f, 100000.0f})
        for (const float aspect : {0.5f, 1.0f, 2.4f}) {
            const Aabb box = boxOf(glm::vec3(-size, 0, -0.3f * size), glm::vec3(size, 0.7f * size, 0.3f * size));
            const Camera camera = frameBounds(box, glm::radians(40.0f), aspect);
            const glm::mat4 viewProjection = camera.projection(aspect) * camera.view;
            float widest = 0;
            glm::vec2 least(1), most(-1);
            for (int i = 0; i < 8; ++i) {
                const glm::vec3 corner(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                                       i & 4 ? box.max.z : box.min.z);
                const glm::vec3 ndc = toNdc(viewProjection, corner);
                widest = std::max({widest, std::abs(ndc.x), std::abs(ndc.y)});
                least = glm::min(least, glm::vec2(ndc));
                most = glm::max(most, glm::vec2(ndc));
                EXPECT_GE(ndc.z, 0) << size;
                EXPECT_LE(ndc.z, 1) << size;
            }
            EXPECT_LE(widest, 1) << size << " " << aspect;
            EXPECT_GE(widest, 0.8f) << size << " " << aspect;  // and not from far away
            const glm::vec2 extent = most - least;             // the tighter direction is centred
            EXPECT_NEAR(extent.x > extent.y ? least.x + most.x : least.y + most.y, 0, 0.1f) << size << " " << aspect;
        }
}

TEST(Camera, FramesAPointAndNothing) {
    for (const Aabb& box : {boxOf(glm::vec3(2), glm::vec3(2)), Aabb{}}) {
        const Camera camera = frameBounds(box, 1, 1);
        EXPECT_GT(camera.near, 0);
        EXPECT_GT(camera.far, camera.near);
        EXPECT_TRUE(std::isfinite(camera.view[3][2]));
    }
}

TEST(Camera, FitsDepthInsideTheBounds) {
    Camera camera = Camera::lookAt({0, 0, 0}, {0, 0, -1});
    fitNearFar(camera, boxOf(glm::vec3(-10), glm::vec3(10)));
    EXPECT_GE(camera.far, 10);
    EXPECT_LE(camera.far, 11);
    EXPECT_NEAR(camera.near, camera.far / 4000, 1e-7);
}

TEST(Camera, FitsDepthTightlyFromOutside) {
    Camera camera = Camera::lookAt({0, 0, 20}, {0, 0, 0});
    fitNearFar(camera, boxOf(glm::vec3(-1), glm::vec3(1)));
    EXPECT_NEAR(camera.near, 19, 0.1f);
    EXPECT_LT(camera.near, 19);
    EXPECT_NEAR(camera.far, 21, 0.1f);
    EXPECT_GT(camera.far, 21);
}

TEST(Camera, FittingKeepsWhatIsGiven) {
    Camera camera = Camera::lookAt({0, 0, 20}, {0, 0, 0});
    camera.near = 0.5f;
    fitNearFar(camera, boxOf(glm::vec3(-1), glm::vec3(1)));
    EXPECT_EQ(camera.near, 0.5f);
    EXPECT_NEAR(camera.far, 21, 0.1f);

    camera.near = 0;
    camera.far = 5;  // ends before the box begins
    fitNearFar(camera, boxOf(glm::vec3(-1), glm::vec3(1)));
    EXPECT_EQ(camera.far, 5);
    EXPECT_LT(camera.near, 5);
    EXPECT_GT(camera.near, 0);
}

TEST(Camera, FitsDepthWhenEverythingIsBehind) {
    Camera camera = Camera::lookAt({0, 0, -20}, {0, 0, -30});
    fitNearFar(camera, boxOf(glm::vec3(-1), glm::vec3(1)));
    EXPECT_GT(camera.near, 0);
    EXPECT_GT(camera.far, camera.near);
}

TEST(Aabb, TransformedBoxHoldsAllCorners) {
    const Aabb box = boxOf({-1, -2, -3}, {1, 2, 3});
    const glm::mat4 m =
        glm::scale(glm::rotate(glm::translate(glm::mat4(1), {5, 0, 0}), glm::radians(90.0f), {0, 0, 1}), {2, 1, -1});
    const Aabb moved = box.transformed(m);
    EXPECT_NEAR(moved.min.x, 3, 1e-5);
    EXPECT_NEAR(moved.max.x, 7, 1e-5);
    EXPECT_NEAR(moved.max.y, 2, 1e-5);
    EXPECT_NEAR(moved.max.z, 3, 1e-5);
    EXPECT_TRUE(Aabb{}.transformed(m).empty);
}

TEST(DefaultLight, OnlyForScenesWithoutAny) {
    Scene scene;
    EXPECT_TRUE(addDefaultLight(scene));
    ASSERT_EQ(scene.lights.size(), 1u);
    ASSERT_TRUE(scene.ambient);
    // A white level floor: key + sky give 0.8, as docs/scenes.md says.
    const float key = scene.lights[0].intensity * -scene.lights[0].direction.y / 3.14159265f;
    EXPECT_NEAR(key + scene.ambient->sky.y, 0.8f, 1e-3);
    EXPECT_NEAR(glm::length(scene.lights[0].direction), 1, 1e-6);
    EXPECT_FALSE(addDefaultLight(scene));

    Scene ambientOnly;
    ambientOnly.ambient = Ambient{};
    EXPECT_FALSE(addDefaultLight(ambientOnly));
    EXPECT_TRUE(ambientOnly.lights.empty());
}

}  // namespace
}  // namespace crevice
