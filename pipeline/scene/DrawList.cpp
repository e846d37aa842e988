// Culls boxes eight at a time, sorts by depth with a stable radix sort, and gathers or merges what is one draw.
#include "scene/DrawList.h"

#include <algorithm>
#include <array>
#include <bit>

namespace crevice {

namespace {

struct Item {
    std::uint32_t key = 0;  ///< Depth as an integer that sorts in the drawing order.
    std::uint32_t instance = 0;
};

bool passes(const InstanceGroup& group, const DrawView& view, DrawFilter filter) {
    if (view.casters && !group.castsShadow) return false;
    return filter == DrawFilter::All || group.blended == (filter == DrawFilter::Blend);
}

// Bits of a float as an integer with the same order (M. Herf, "Radix Tricks", 2001).
std::uint32_t sortableBits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value + 0.0f);  // -0 becomes 0
    return bits ^ ((bits >> 31) != 0 ? 0xffffffffu : 0x80000000u);
}

std::vector<std::uint32_t> depthKeys(const InstanceTable& table, const DrawView& view, DrawOrder order) {
    const std::size_t count = table.size();
    std::vector<std::uint32_t> keys(count);
    const glm::vec4 row = 0.5f * glm::vec4(view.view[0].z, view.view[1].z, view.view[2].z, 0);
    const float offset = view.view[3].z;
    const float *x0 = table.low(0).data(), *y0 = table.low(1).data(), *z0 = table.low(2).data();
    const float *x1 = table.high(0).data(), *y1 = table.high(1).data(), *z1 = table.high(2).data();
    const float sign = order == DrawOrder::FrontToBack ? -1.0f : 1.0f;
    for (std::size_t i = 0; i < count; ++i) {
        const float z = row.x * (x0[i] + x1[i]) + row.y * (y0[i] + y1[i]) + row.z * (z0[i] + z1[i]) + offset;
        keys[i] = sortableBits(sign * z);
    }
    return keys;
}

// In the order of their indices.
std::vector<Item> visibleItems(const InstanceTable& table, const DrawView& view, DrawFilter filter, DrawOrder order) {
    std::vector<std::uint8_t> passing;
    for (const InstanceGroup& group : table.groups()) passing.push_back(passes(group, view, filter) ? 1 : 0);
    if (std::find(passing.begin(), passing.end(), 1) == passing.end()) return {};
    const std::size_t count = table.size();
    std::vector<std::uint8_t> inside =
        view.cull ? Frustum(view.viewProjection).intersects(table) : std::vector<std::uint8_t>(count, 1);
    const std::vector<std::uint32_t> keys = depthKeys(table, view, order);
    const std::span<const std::uint32_t> groups = table.groupOf();
    std::vector<Item> items(count);
    std::size_t used = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (!inside[i] || groups[i] == InstanceTable::kNothing || !passing[groups[i]]) continue;
        items[used++] = {keys[i], std::uint32_t(i)};
    }
    items.resize(used);
    return items;
}

// Stable, three digits of eleven bits from the lowest: its time depends on the count alone.
void sortByKey(std::vector<Item>& items) {
    constexpr std::uint32_t kBits = 11, kValues = 1u << kBits;
    constexpr std::size_t kFew = 512;
    if (items.size() < kFew) {
        std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.key < b.key; });
        return;
    }
    std::vector<Item> other(items.size());
    for (std::uint32_t shift = 0; shift < 32; shift += kBits) {
        std::array<std::uint32_t, kValues> starts{};
        for (const Item& item : items) ++starts[item.key >> shift & (kValues - 1)];
        std::uint32_t sum = 0;
        for (std::uint32_t& start : starts) {
            const std::uint32_t count = start;
            start = sum;
            sum += count;
        }
        for (const Item& item : items) other[starts[item.key >> shift & (kValues - 1)]++] = item;
        items.swap(other);
    }
}

DrawBatch batchOf(const InstanceGroup& group, std::size_t first) {
    return {.mesh = group.mesh,
            .material = group.material,
            .flipped = group.flipped,
            .firstInstance = static_cast<std::uint32_t>(first)};
}

// One batch per group. Batches stand in the order of their nearest instance.
DrawList gatherGroups(const InstanceTable& table, const std::vector<Item>& sorted) {
    constexpr std::uint32_t kUnseen = 0xffffffff;
    const std::span<const std::uint32_t> groups = table.groupOf();
    std::vector<std::uint32_t> batchIndex(table.groups().size(), kUnseen);
    DrawList list;
    for (const Item& item : sorted) {
        const std::uint32_t group = groups[item.instance];
        if (batchIndex[group] == kUnseen) {
            batchIndex[group] = static_cast<std::uint32_t>(list.batches.size());
            list.batches.push_back(batchOf(table.groups()[group], 0));
        }
        ++list.batches[batchIndex[group]].instanceCount;
    }
    std::vector<std::uint32_t> next;
    std::uint32_t sum = 0;
    for (DrawBatch& batch : list.batches) {
        batch.firstInstance = sum;
        next.push_back(sum);
        sum += batch.instanceCount;
    }
    list.instances.resize(sorted.size());
    for (const Item& item : sorted) list.instances[next[batchIndex[groups[item.instance]]]++] = item.instance;
    return list;
}

DrawList mergeNeighbours(const InstanceTable& table, const std::vector<Item>& sorted) {
    const std::span<const std::uint32_t> groups = table.groupOf();
    DrawList list;
    list.instances.reserve(sorted.size());
    for (const Item& item : sorted) {
        const std::uint32_t group = groups[item.instance];
        if (list.instances.empty() || groups[list.instances.back()] != group)
            list.batches.push_back(batchOf(table.groups()[group], list.instances.size()));
        list.instances.push_back(item.instance);
        ++list.batches.back().instanceCount;
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

std::vector<std::uint8_t> Frustum::intersects(const InstanceTable& table) const {
    const std::size_t count = table.size();
    std::vector<std::uint8_t> inside(count, 1);
    std::uint8_t* result = inside.data();
    for (const glm::vec4& plane : planes_) {
        // Which corner counts is the plane's choice alone, so the loop has no condition.
        const float* x = (plane.x > 0 ? table.high(0) : table.low(0)).data();
        const float* y = (plane.y > 0 ? table.high(1) : table.low(1)).data();
        const float* z = (plane.z > 0 ? table.high(2) : table.low(2)).data();
        const float nx = plane.x, ny = plane.y, nz = plane.z, w = plane.w;
        for (std::size_t i = 0; i < count; ++i)
            result[i] &= static_cast<std::uint8_t>(!(nx * x[i] + ny * y[i] + nz * z[i] + w < 0));
    }
    return inside;
}

DrawList buildDrawList(const InstanceTable& table, const DrawView& view, DrawFilter filter, DrawOrder order) {
    // Items come in index order, so a stable sort leaves ties to the index.
    std::vector<Item> items = visibleItems(table, view, filter, order);
    sortByKey(items);
    return order == DrawOrder::FrontToBack ? gatherGroups(table, items) : mergeNeighbours(table, items);
}

}  // namespace crevice
