// The rows' buffer grows by half, so that a moving camera makes a new one a few times only.
#include "flow/QueueView.h"

#include <algorithm>
#include <cstring>

namespace crevice {

void QueueView::update(Device& device, const SceneGpu& scene, const DrawView& view, DrawFilter filter,
                       DrawOrder order) {
    if (isCurrent_ && view == view_ && filter == filter_ && order == order_) return;
    list_ = buildDrawList(scene.instances(), view, filter, order);
    view_ = view, filter_ = filter, order_ = order;
    isCurrent_ = true;
    if (list_.instances.empty()) return;

    const std::uint64_t bytes = list_.instances.size() * sizeof(InstanceRows);
    if (!rows_ || rows_.size() < bytes) {
        const std::uint64_t most = scene.instances().size() * sizeof(InstanceRows);
        const std::uint64_t size = std::min(most, std::max(bytes, rows_ ? rows_.size() * 3 / 2 : bytes));
        rows_ = Buffer();
        rows_ = Buffer(device, {.size = size, .usage = BufferUsage::Vertex, .name = "instances"});
    }
    const std::span<const InstanceRows> rows = scene.instances().rows();
    std::byte* out = rows_.data().data();
    for (const std::uint32_t instance : list_.instances) {
        std::memcpy(out, &rows[instance], sizeof(InstanceRows));
        out += sizeof(InstanceRows);
    }
}

}  // namespace crevice
