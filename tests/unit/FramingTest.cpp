// The default view holds all that is drawn, and no box around it.
#include "scene/Framing.h"

#include <cmath>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/Primitives.h"

namespace crevice {
namespace {

Scene sceneWith(Mesh mesh, const glm::mat4& world) {
    Scene scene;
    updateBounds(mesh);
    scene.meshes.push_back(std::move(mesh));
    scene.materials.emplace_back();
    scene.instances.push_back({.mesh = 0, .material = 0, .world = world, .name = {}});
    return scene;
}

/// Extent of the drawn vertices in the picture: least x, least y, most x, most y, from -1 to 1.
glm::vec4 extentOf(const Scene& scene, const Camera& camera, float aspect) {
    glm::vec4 extent(1e9f, 1e9f, -1e9f, -1e9f);
    for (const Instance& instance : scene.instances)
        for (const std::uint32_t index : scene.meshes[std::size_t(instance.mesh)].indices) {
            const glm::vec3& place = scene.meshes[std::size_t(instance.mesh)].vertices[index].position;
            const glm::vec4 clip = camera.projection(aspect) * camera.view * instance.world * glm::vec4(place, 1);
            const glm::vec2 ndc = glm::vec2(clip) / clip.w;
            extent = {glm::min(glm::vec2(extent), ndc), glm::max(glm::vec2(extent.z, extent.w), ndc)};
        }
    return extent;
}

// A long thin stick across its box: the box is far larger than what is seen of it.
Scene stick() {
    const glm::mat4 turn = glm::rotate(glm::mat4(1), 0.7f, glm::normalize(glm::vec3(1, 0.2f, 0.4f)));
    return sceneWith(makeBox({0.1f, 8, 0.1f}), turn);
}

TEST(Framing, WhatIsDrawnFillsThePictureInItsMiddle) {
    for (const float aspect : {0.4f, 1.0f, 1.7777778f, 4.0f})
        for (const float fov : {10.0f, 40.0f, 110.0f}) {
            const Scene scene = stick();
            const Camera camera = frameOutline(outlineOf(scene), scene.bounds(), glm::radians(fov), aspect);
            const glm::vec4 extent = extentOf(scene, camera, aspect);
            const glm::vec2 size = glm::vec2(extent.z - extent.x, extent.w - extent.y);
            EXPECT_GE(extent.x, -1) << aspect << " " << fov;
            EXPECT_GE(extent.y, -1) << aspect << " " << fov;
            EXPECT_LE(extent.z, 1) << aspect << " " << fov;
            EXPECT_LE(extent.w, 1) << aspect << " " << fov;
            EXPECT_GT(std::max(size.x, size.y), 1.7f) << aspect << " " << fov;
            EXPECT_NEAR(extent.x + extent.z, 0, 0.15f) << aspect << " " << fov;
            EXPECT_NEAR(extent.y + extent.w, 0, 0.15f) << aspect << " " << fov;
        }
}

TEST(Framing, VerticesThatNoTriangleUsesDoNotCount) {
    Scene scene = sceneWith(makeBox(glm::vec3(1)), glm::mat4(1));
    const std::vector<glm::vec3> expected = outlineOf(scene);
    Vertex stray;
    stray.position = glm::vec3(0, 90, 0);
    scene.meshes[0].vertices.insert(scene.meshes[0].vertices.end(), 100, stray);
    updateBounds(scene.meshes[0]);
    EXPECT_EQ(outlineOf(scene), expected);
}

TEST(Framing, BoxesStandForMeshesWithoutVertices) {
    Scene scene = stick();
    scene.meshes[0].vertices.clear();
    const Aabb bounds = scene.bounds();
    const std::vector<glm::vec3> outline = outlineOf(scene);
    ASSERT_FALSE(outline.empty());
    for (const glm::vec3& point : outline) {
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(point, bounds.min - 1e-4f)));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(point, bounds.max + 1e-4f)));
    }
    EXPECT_TRUE(outlineOf(Scene{}).empty());
    const Camera camera = frameOutline({}, Aabb{}, 1, 1);
    EXPECT_TRUE(std::isfinite(camera.view[3][2]));
}

TEST(Framing, APointIsSeen) {
    const Scene scene = sceneWith(makeBox(glm::vec3(1)), glm::scale(glm::mat4(1), glm::vec3(0)));
    const Camera camera = frameOutline(outlineOf(scene), scene.bounds(), 1, 1);
    EXPECT_TRUE(std::isfinite(camera.view[3][2]));
    EXPECT_GT(camera.far, camera.near);
}

}  // namespace
}  // namespace crevice
