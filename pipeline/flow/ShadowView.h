// How a light sees the scene: the matrices of a shadow map, fitted to the scene's bounds.
#pragma once

#include <optional>

#include <glm/glm.hpp>

#include "scene/Scene.h"

namespace crevice {

struct ShadowView {
    glm::mat4 view{1};
    glm::mat4 projection{1};  ///< Vulkan clip space, depth 0 … 1.
    float near = 0, far = 1;  ///< World units along the light.
    float width = 1;          ///< World units across the map (directional).
    int punctualIndex = -1;   ///< Place of a spot light in CCPunctualLights.
};

/// The scene's main light: its first directional light; null when it has none.
const Light* mainLight(const Scene& scene);

/// The main light's view, its volume fitted to the bounds; nothing when there is no main light or it casts no shadow.
std::optional<ShadowView> directionalShadowView(const Scene& scene, const Aabb& bounds);

/// The first spot light that casts shadows, or null.
const Light* shadowedSpot(const Scene& scene);

/// View of the first spot light that casts shadows.
std::optional<ShadowView> spotShadowView(const Scene& scene, const Aabb& bounds);

}  // namespace crevice
