// Culls by boxes, sorts by depth with ties by index, and merges equal neighbours.
#include "scene/DrawList.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <tuple>

namespace crevice {

namespace {

struct Item {
    std::uint32_t instance = 0;
    float depth = 0;
};

bool passes(AlphaMode mode, DrawFilter filter) {
    return filter == DrawFilter::All || (mode == AlphaMode::Blend) == (filter == DrawFilter::Blend);
}

std::vector<Item> visibleItems(const Scene& scene, std::span<const Aabb> boxes, const DrawView& view,
                               DrawFilter filter) {
    const Frustum frustum(view.viewProjection);
    std::vector<Item> items;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (boxes[i].empty || !passes(scene.materials[instance.material].alphaMode, filter)) continue;
        if (view.cull && !frustum.intersects(boxes[i])) continue;
        items.push_back({i, -(view.view * glm::vec4(boxes[i].centre(), 1)).z});
    }
    return items;
}

std::tuple<int, int, bool> keyOf(const Instance& instance) {
    return {instance.mesh, instance.material, instance.flipped};
}

void append(DrawList& list, const Instance& instance, std::uint32_t index, bool merge) {
    if (!merge)
        list.batches.push_back({.mesh = instance.mesh,
                                .material = instance.material,
                                .flipped = instance.flipped,
                                .firstInstance = static_cast<std::uint32_t>(list.instances.size())});
    list.instances.push_back(index);
    ++list.batches.back().instanceCount;
}

// One batch per mesh and material. Batches stand in the order of their nearest instance.
DrawList mergeAll(const Scene& scene, const std::vector<Item>& sorted) {
    std::map<std::tuple<int, int, bool>, std::size_t> batchOf;
    std::vector<std::vector<std::uint32_t>> members;
    for (const Item& item : sorted) {
        const auto [entry, isNew] = batchOf.emplace(keyOf(scene.instances[item.instance]), members.size());
        if (isNew) members.emplace_back();
        members[entry->second].push_back(item.instance);
    }
    DrawList list;
    for (const auto& batch : members)
        for (std::size_t i = 0; i < batch.size(); ++i) append(list, scene.instances[batch[i]], batch[i], i > 0);
    return list;
}

DrawList mergeNeighbours(const Scene& scene, const std::vector<Item>& sorted) {
    DrawList list;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const Instance& instance = scene.instances[sorted[i].instance];
        const bool merge = i > 0 && keyOf(scene.instances[sorted[i - 1].instance]) == keyOf(instance);
        append(list, instance, sorted[i].instance, merge);
    }
    return list;
}

}  // namespace

// G. Gribb, K. Hartmann, "Fast Extraction of Viewing Frustum Planes from the World-View-Projection Matrix" (2001), for
// a depth of 0 … 1: the near plane is the third row alone.
Frustum::Frustum(const glm::mat4& viewProjection) {
    const glm::mat4 rows = glm::transpose(viewProjection);
    planes_[0] = rows[3] + rows[0];
    planes_[1] = rows[3] - rows[0];
    planes_[2] = rows[3] + rows[1];
    planes_[3] = rows[3] - rows[1];
    planes_[4] = rows[2];
    planes_[5] = rows[3] - rows[2];
}

bool Frustum::intersects(const Aabb& box) const {
    for (const glm::vec4& plane : planes_) {
        // The corner that lies farthest along the plane's normal.
        const glm::vec3 corner(plane.x > 0 ? box.max.x : box.min.x, plane.y > 0 ? box.max.y : box.min.y,
                               plane.z > 0 ? box.max.z : box.min.z);
        if (glm::dot(glm::vec3(plane), corner) + plane.w < 0) return false;
    }
    return true;
}

std::vector<Aabb> computeInstanceBounds(const Scene& scene) {
    std::vector<Aabb> boxes;
    boxes.reserve(scene.instances.size());
    for (const Instance& instance : scene.instances)
        boxes.push_back(scene.meshes[instance.mesh].bounds.transformed(instance.world));
    return boxes;
}

DrawList buildDrawList(const Scene& scene, std::span<const Aabb> instanceBounds, const DrawView& view,
                       DrawFilter filter, DrawOrder order) {
    assert(instanceBounds.size() == scene.instances.size());
    std::vector<Item> items = visibleItems(scene, instanceBounds, view, filter);
    const bool nearFirst = order == DrawOrder::FrontToBack;
    // Items come in index order, so a stable sort leaves ties to the index.
    std::stable_sort(items.begin(), items.end(), [nearFirst](const Item& a, const Item& b) {
        return nearFirst ? a.depth < b.depth : b.depth < a.depth;
    });
    return nearFirst ? mergeAll(scene, items) : mergeNeighbours(scene, items);
}

}  // namespace crevice
