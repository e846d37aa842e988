// Objects for scenes that tests build by hand.
#pragma once

#include <utility>

#include <glm/glm.hpp>

#include "scene/Primitives.h"

namespace crevice {

/// A mesh of its own and one instance of it.
inline void addObject(Scene& scene, Mesh mesh, const glm::mat4& world = glm::mat4(1), int material = 0) {
    updateBounds(mesh);
    scene.meshes.push_back(std::move(mesh));
    Instance instance;
    instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
    instance.material = material;
    instance.world = world;
    instance.flipped = glm::determinant(glm::mat3(world)) < 0;
    scene.instances.push_back(instance);
}

}  // namespace crevice
