// A camera: where it stands, how it projects. Matrices follow Vulkan clip space as Cocos' Vulkan back end has it:
// depth 0 (near) … 1 (far), projection[1][1] < 0, so the viewport is positive.
#pragma once

#include <string>

#include <glm/glm.hpp>

namespace crevice {

struct Aabb;

struct Camera {
    std::string name;
    glm::mat4 view{1};  ///< World → view; the camera looks along -z.
    bool orthographic = false;
    float fovY = 0.785398f;    ///< Vertical field of view in radians (perspective).
    float orthoHeight = 2.0f;  ///< Full height of the view volume in world units (orthographic).
    float near = 0.0f;         ///< 0 = from the scene's bounds.
    float far = 0.0f;          ///< 0 = from the scene's bounds.
    glm::vec2 lensShift{
        0};  ///< Off-centre shift in NDC units, added to projection[2]: +x moves the picture's content left, +y up.

    /// View → clip for an aspect ratio (width / height). Unset near and far fall back to 0.1 and 10000 × near: call
    /// fitNearFar() first.
    glm::mat4 projection(float aspect) const;
    glm::vec3 position() const;
    static Camera lookAt(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up = {0, 1, 0});
};

/// Fills near and far where they are 0, so that the bounds are inside with a margin and far / near stays sensible: near
/// is never below far / 4000: a 32-bit depth buffer then tells surfaces at the far end apart that are 1/4000 of their
/// distance behind each other (2^-24 z² / near, and better closer by).
void fitNearFar(Camera& camera, const Aabb& bounds);

}  // namespace crevice
