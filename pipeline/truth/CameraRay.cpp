// Field of view or height of the view volume, aspect ratio and lens shift.
#include "truth/CameraRay.h"

#include <cmath>

namespace crevice {

Ray makeCameraRay(const Camera& camera, const glm::vec2& pixel, const glm::uvec2& size) {
    const glm::vec2 extent(size);
    const float aspect = extent.x / extent.y;
    // -1 … 1 over the picture, x right and y down; the lens shift moves the picture's content left and up by as much.
    const glm::vec2 place = 2.0f * pixel / extent - 1.0f + camera.lensShift;
    const float halfHeight = camera.orthographic ? 0.5f * camera.orthoHeight : std::tan(0.5f * camera.fovY);
    const glm::vec2 aside(place.x * halfHeight * aspect, -place.y * halfHeight);

    const glm::mat4 toWorld = glm::inverse(camera.view);
    const glm::vec3 right(toWorld[0]), up(toWorld[1]), forward(-toWorld[2]), eye(toWorld[3]);
    const glm::vec3 offset = aside.x * right + aside.y * up;
    if (camera.orthographic) return {eye + offset, forward, camera.near, camera.far};
    return {eye, forward + offset, camera.near, camera.far};
}

}  // namespace crevice
