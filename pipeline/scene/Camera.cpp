// Projection into Vulkan clip space, and cameras that fit their depth range to a box.
#include "scene/Camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/Framing.h"
#include "scene/Scene.h"

namespace crevice {

namespace {

constexpr float kDefaultNear = 0.1f;
constexpr float kDefaultFarPerNear = 1e4f;
constexpr float kMaxFarPerNear = 4000.0f;  // 32-bit depth then resolves 1/4000 of the largest distance
constexpr float kDepthMargin = 0.01f;      // of the depth range on either side

}  // namespace

// Vulkan 1.3 specification, 27.2 "coordinate transformations": y points down and depth is 0 … 1, hence the minus in
// [1][1] and far / (near - far) in [2][2].
glm::mat4 Camera::projection(float aspect) const {
    const float n = near > 0 ? near : kDefaultNear;
    const float f = far > n ? far : n * kDefaultFarPerNear;
    glm::mat4 p(0);
    if (orthographic) {
        p[0][0] = 2.0f / (orthoHeight * aspect);
        p[1][1] = -2.0f / orthoHeight;
        p[2][2] = 1.0f / (n - f);
        p[3] = {-lensShift.x, -lensShift.y, n / (n - f), 1};
        return p;
    }
    const float scale = 1.0f / std::tan(0.5f * fovY);
    p[0][0] = scale / aspect;
    p[1][1] = -scale;
    p[2] = {lensShift.x, lensShift.y, f / (n - f), -1};
    p[3][2] = n * f / (n - f);
    return p;
}

glm::vec3 Camera::position() const { return glm::vec3(glm::inverse(view)[3]); }

Camera Camera::lookAt(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up) {
    const glm::vec3 offset = target - eye;
    const glm::vec3 forward = glm::length(offset) > 0 ? glm::normalize(offset) : glm::vec3(0, 0, -1);
    // An `up` along the view would leave no sideways direction: take the axis that is farthest from it.
    glm::vec3 safeUp = up;
    if (glm::length(glm::cross(forward, up)) < 1e-4f * glm::length(up) || glm::length(up) == 0)
        safeUp = std::abs(forward.y) > 0.9f ? glm::vec3(0, 0, forward.y > 0 ? 1 : -1) : glm::vec3(0, 1, 0);
    Camera camera;
    // Turned at the origin, then moved: far from it, eye + forward would lose the direction's digits.
    camera.view = glm::lookAtRH(glm::vec3(0), forward, safeUp);
    camera.view[3] = glm::vec4(-(glm::mat3(camera.view) * eye), 1);
    return camera;
}

void fitNearFar(Camera& camera, const Aabb& bounds) {
    const bool fitNear = camera.near <= 0;
    const bool fitFar = camera.far <= 0;
    float nearest = kDefaultNear, farthest = kDefaultNear * kDefaultFarPerNear;
    if (!bounds.empty) {
        nearest = std::numeric_limits<float>::max();
        farthest = std::numeric_limits<float>::lowest();
        for (const glm::vec3& corner : corners(bounds)) {
            const float depth = -(camera.view * glm::vec4(corner, 1)).z;
            nearest = std::min(nearest, depth);
            farthest = std::max(farthest, depth);
        }
        const float margin = kDepthMargin * std::max(farthest - nearest, 1e-3f * std::abs(farthest));
        nearest -= margin;
        farthest += margin;
        // Nothing in front of the camera: any range will do, in the scene's own scale.
        if (farthest <= 0) farthest = std::max(bounds.diagonal(), 1e-3f);
    }
    if (fitFar) camera.far = std::max(farthest, fitNear ? 0.0f : 1.1f * camera.near);
    if (fitNear) camera.near = std::clamp(nearest, camera.far / kMaxFarPerNear, 0.9f * camera.far);
}

}  // namespace crevice
