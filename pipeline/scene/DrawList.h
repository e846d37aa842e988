// What a camera (or a light) sees of a scene, in drawing order, grouped into instanced batches. Pure data, no GPU.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scene/InstanceTable.h"

namespace crevice {

/// FrontToBack batches every instance of a mesh and material into one draw; BackToFront keeps the exact order, as
/// blending needs.
enum class DrawOrder : std::uint8_t { FrontToBack, BackToFront };

/// Which materials take part. Opaque includes alpha-masked ones.
enum class DrawFilter : std::uint8_t { Opaque, Blend, All };

struct DrawBatch {
    int mesh = 0;
    int material = 0;
    bool flipped = false;             ///< The instances mirror: draw with the other front face.
    std::uint32_t firstInstance = 0;  ///< Into DrawList::instances.
    std::uint32_t instanceCount = 0;
    bool operator==(const DrawBatch&) const = default;
};

struct DrawList {
    std::vector<DrawBatch> batches;
    std::vector<std::uint32_t> instances;  ///< Indices into Scene::instances, batch after batch.
    bool operator==(const DrawList&) const = default;
};

/// The six planes of a clip space with depth 0 … 1, pointing inwards, taken from a world → clip matrix.
struct Frustum {
    explicit Frustum(const glm::mat4& viewProjection);
    /// False only when the box is certainly outside: it lies wholly behind one plane.
    bool intersects(const Aabb& box) const;
    /// The same of every box of a table: 1 or 0 each.
    std::vector<std::uint8_t> intersects(const InstanceTable& table) const;

private:
    glm::vec4 planes_[6];
};

struct DrawView {
    glm::mat4 view{1};            ///< Depth is -z of a box's centre in this space.
    glm::mat4 viewProjection{1};  ///< World → clip, for culling.
    bool cull = true;
    bool casters = false;  ///< Only what casts shadows.
    bool operator==(const DrawView&) const = default;
};

/// Front to back, batches stand in the order of their nearest instance, and a batch's instances by depth. Ties of depth
/// are broken by the instance's index, so the list depends on nothing else.
DrawList buildDrawList(const InstanceTable& table, const DrawView& view, DrawFilter filter, DrawOrder order);

}  // namespace crevice
