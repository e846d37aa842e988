// Boxes are found by the matrix's absolute values, groups by a hash of mesh, material, winding and shadow.
#include "scene/InstanceTable.h"

#include <unordered_map>

namespace crevice {
namespace {

std::uint64_t keyOf(const Instance& instance) {
    return std::uint64_t(std::uint32_t(instance.mesh)) << 32 | std::uint64_t(std::uint32_t(instance.material)) << 2 |
           std::uint64_t(instance.castsShadow) << 1 | std::uint64_t(instance.flipped);
}

}  // namespace

InstanceTable::InstanceTable(const Scene& scene) {
    const std::size_t count = scene.instances.size();
    for (int axis = 0; axis < 3; ++axis) low_[axis].resize(count), high_[axis].resize(count);
    rows_.resize(count);
    group_.resize(count);
    std::unordered_map<std::uint64_t, std::uint32_t> groupIndex;
    for (std::size_t i = 0; i < count; ++i) {
        const Instance& instance = scene.instances[i];
        const glm::mat4 rows = glm::transpose(instance.world);
        rows_[i] = {rows[0], rows[1], rows[2]};
        const Aabb box = scene.meshes[std::size_t(instance.mesh)].bounds.transformed(instance.world);
        group_[i] = kNothing;
        if (box.empty) continue;
        bounds_.add(box);
        for (int axis = 0; axis < 3; ++axis) {
            low_[axis][i] = box.min[axis];
            high_[axis][i] = box.max[axis];
        }
        const auto [entry, isNew] = groupIndex.emplace(keyOf(instance), std::uint32_t(groups_.size()));
        if (isNew)
            groups_.push_back({.mesh = instance.mesh,
                               .material = instance.material,
                               .flipped = instance.flipped,
                               .blended = scene.materials[std::size_t(instance.material)].alphaMode == AlphaMode::Blend,
                               .castsShadow = instance.castsShadow});
        group_[i] = entry->second;
    }
}

Aabb InstanceTable::box(std::size_t instance) const {
    Aabb box;
    if (group_[instance] == kNothing) return box;
    box.min = {low_[0][instance], low_[1][instance], low_[2][instance]};
    box.max = {high_[0][instance], high_[1][instance], high_[2][instance]};
    box.empty = false;
    return box;
}

}  // namespace crevice
