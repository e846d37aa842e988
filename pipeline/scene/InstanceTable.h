// What culling, sorting and drawing read of a scene's instances, as arrays in their order: made once per scene.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/Scene.h"

namespace crevice {

/// Three rows of a world matrix: a point's world coordinate is the dot product of a row and (x, y, z, 1). The layout of
/// the vertex attributes a_matWorld0 to a_matWorld2.
struct InstanceRows {
    glm::vec4 row0, row1, row2;
};
static_assert(sizeof(InstanceRows) == 48);

/// Instances that can be one draw: the same mesh, material and winding, and all cast shadows or none.
struct InstanceGroup {
    int mesh = 0;
    int material = 0;
    bool flipped = false;
    bool blended = false;  ///< The material's alpha mode is Blend.
    bool castsShadow = true;
};

/// One array per number, so that loops over all instances run in vector registers.
class InstanceTable {
public:
    explicit InstanceTable(const Scene& scene);

    std::size_t size() const { return group_.size(); }
    /// World-space box.
    Aabb box(std::size_t instance) const;
    /// World-space box of all instances.
    const Aabb& bounds() const { return bounds_; }
    std::span<const InstanceRows> rows() const { return rows_; }
    /// In the order in which the scene's instances first use them.
    std::span<const InstanceGroup> groups() const { return groups_; }
    /// Per instance an index into groups(); kNothing for an instance of an empty mesh.
    std::span<const std::uint32_t> groupOf() const { return group_; }
    static constexpr std::uint32_t kNothing = 0xffffffff;

    /// Coordinates of the boxes' corners: [axis], then one number per instance.
    std::span<const float> low(int axis) const { return low_[axis]; }
    std::span<const float> high(int axis) const { return high_[axis]; }

private:
    std::vector<float> low_[3], high_[3];
    std::vector<InstanceRows> rows_;
    std::vector<std::uint32_t> group_;
    std::vector<InstanceGroup> groups_;
    Aabb bounds_;
};

}  // namespace crevice
