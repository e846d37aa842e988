// Fits light cameras: an orthographic box around the bounds, or the spot's cone.
#include "flow/ShadowView.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace crevice {
namespace {

glm::vec3 anyUp(const glm::vec3& direction) {
    return std::abs(direction.y) < 0.99f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
}

/// Vulkan's y points down in clip space; the projections of glm point up.
glm::mat4 flipped(glm::mat4 projection) {
    projection[1] *= -1.0f;
    return projection;
}

}  // namespace

const Light* mainLight(const Scene& scene) {
    for (const Light& light : scene.lights) {
        if (light.type == LightType::Directional) return &light;
    }
    return nullptr;
}

std::optional<ShadowView> directionalShadowView(const Scene& scene, const Aabb& bounds) {
    const Light* light = mainLight(scene);
    if (!light || !light->castsShadow || bounds.empty) return std::nullopt;
    const glm::vec3 centre = bounds.centre();
    const float radius = std::max(0.5f * bounds.diagonal(), 1e-6f);
    ShadowView result;
    result.view = glm::lookAt(centre - light->direction * radius, centre, anyUp(light->direction));
    const Aabb inLight = bounds.transformed(result.view);
    const float margin = 0.01f * radius;
    result.near = std::max(0.0f, -inLight.max.z - margin);
    result.far = -inLight.min.z + margin;
    const glm::vec3 low = inLight.min - margin;
    const glm::vec3 high = inLight.max + margin;
    result.projection = flipped(glm::orthoRH_ZO(low.x, high.x, low.y, high.y, result.near, result.far));
    result.width = std::max(high.x - low.x, high.y - low.y);
    return result;
}

const Light* shadowedSpot(const Scene& scene) {
    for (const Light& light : scene.lights)
        if (light.type == LightType::Spot && light.castsShadow) return &light;
    return nullptr;
}

std::optional<ShadowView> spotShadowView(const Scene& scene, const Aabb& bounds) {
    const Light* spot = shadowedSpot(scene);
    if (!spot) return std::nullopt;
    ShadowView result;
    const float reach =
        glm::length(glm::max(glm::abs(bounds.max - spot->position), glm::abs(bounds.min - spot->position)));
    result.far = std::max(spot->range > 0 ? std::min(spot->range, reach) : reach, 1e-5f);
    result.near = result.far * 0.005f;
    result.view = glm::lookAt(spot->position, spot->position + spot->direction, anyUp(spot->direction));
    const float angle = std::min(2.0f * spot->outerAngle + 0.02f, 3.0f);
    result.projection = flipped(glm::perspectiveRH_ZO(angle, 1.0f, result.near, result.far));
    const Light* main = mainLight(scene);
    const Light* first = scene.lights.data();
    result.punctualIndex = int(std::count_if(first, spot, [&](const Light& light) { return &light != main; }));
    return result;
}

}  // namespace crevice
