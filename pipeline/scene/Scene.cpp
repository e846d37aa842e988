// Boxes around things, and the light that a scene without any gets.
#include "scene/Scene.h"

#include <cmath>

#include <glm/gtc/constants.hpp>

namespace crevice {

void Aabb::add(const glm::vec3& point) {
    min = empty ? point : glm::min(min, point);
    max = empty ? point : glm::max(max, point);
    empty = false;
}

void Aabb::add(const Aabb& box) {
    if (box.empty) return;
    add(box.min);
    add(box.max);
}

// J. Arvo, "Transforming Axis-Aligned Bounding Boxes", Graphics Gems (1990): each output axis takes the smaller and the
// larger product of every matrix element with the box's two ends.
Aabb Aabb::transformed(const glm::mat4& matrix) const {
    if (empty) return {};
    Aabb result;
    result.empty = false;
    result.min = result.max = glm::vec3(matrix[3]);
    for (int column = 0; column < 3; ++column) {
        const glm::vec3 a = glm::vec3(matrix[column]) * min[column];
        const glm::vec3 b = glm::vec3(matrix[column]) * max[column];
        result.min += glm::min(a, b);
        result.max += glm::max(a, b);
    }
    return result;
}

float Aabb::diagonal() const { return empty ? 0.0f : glm::length(max - min); }

Aabb Scene::bounds() const {
    Aabb box;
    for (const Instance& instance : instances) box.add(meshes[instance.mesh].bounds.transformed(instance.world));
    return box;
}

// KHR_texture_transform: translation * rotation * scale of column vectors (u, v, 1).
glm::vec3 UvTransform::row(int index) const {
    const float c = std::cos(rotation), s = std::sin(rotation);
    return index == 0 ? glm::vec3(c * scale.x, s * scale.y, offset.x) : glm::vec3(-s * scale.x, c * scale.y, offset.y);
}

glm::vec2 UvTransform::apply(const glm::vec2& uv) const {
    const glm::vec3 place(uv, 1);
    return {glm::dot(row(0), place), glm::dot(row(1), place)};
}

bool litByEnvironment(const Scene& scene) { return scene.environment && scene.environment->lights; }

bool addDefaultLight(Scene& scene, bool environment) {
    if (!scene.lights.empty() || scene.ambient || litByEnvironment(scene)) return false;

    // From the upper front left of world space; front is +z, where frameBounds() stands.
    Light key;
    key.name = "default key light";
    key.direction = glm::normalize(glm::vec3(0.5f, -0.8f, -0.45f));
    // A white level floor leaves the key with radiance 0.45 (E cos / pi) and the ambient light with 0.3. The
    // environment that takes the latter's place gives it 0.5, and less from other sides.
    key.intensity = 0.45f * glm::pi<float>() / -key.direction.y;
    scene.lights.push_back(key);
    scene.ambient = Ambient{.sky = {0.34f, 0.35f, 0.37f}, .ground = {0.16f, 0.15f, 0.14f}};
    if (environment && !scene.environment) scene.environment = defaultEnvironment();
    return true;
}

}  // namespace crevice
