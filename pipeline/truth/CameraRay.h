// The ray through a point of a picture, made from what a camera says of itself, not from the projection matrix: the two
// check each other.
#pragma once

#include <glm/glm.hpp>

#include "scene/Camera.h"
#include "truth/RayScene.h"

namespace crevice {

/// `pixel` counts from the upper left corner; centres lie at halves. The direction goes one unit along the camera's
/// axis, so that distances along the ray are linear view depths. Near and far are the camera's and must be set.
Ray makeCameraRay(const Camera& camera, const glm::vec2& pixel, const glm::uvec2& size);

}  // namespace crevice
