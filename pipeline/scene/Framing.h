// Views that frame a scene by what is drawn of it: a box would leave a slanted or slender model small and off the
// middle.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/Camera.h"
#include "scene/Scene.h"

namespace crevice {

std::array<glm::vec3, 8> corners(const Aabb& box);

/// A view from the front right above that frames the box for an aspect ratio.
Camera frameBounds(const Aabb& bounds, float fovY, float aspect);

/// A few points in world space, such that a view from the default direction that holds them holds the scene, but for 2
/// % of its size. Of scenes with more than 500,000 vertices to draw, and of meshes without vertices, the corners of
/// boxes. Empty for an empty scene.
std::vector<glm::vec3> outlineOf(const Scene& scene);

/// frameBounds(), but framing the points; near and far are those of the bounds. Without points: of the bounds.
Camera frameOutline(std::span<const glm::vec3> outline, const Aabb& bounds, float fovY, float aspect);

}  // namespace crevice
