// What a queue draws as one viewer sees it: the batches, and the rows of their instances on the GPU.
#pragma once

#include "flow/SceneGpu.h"
#include "scene/DrawList.h"

namespace crevice {

/// Kept from frame to frame: as long as the view stays the same, nothing is culled, sorted or copied anew.
class QueueView {
public:
    /// Afterwards list() and rows() are what `view` sees. The GPU must not be using rows() of an earlier frame.
    void update(Device& device, const SceneGpu& scene, const DrawView& view, DrawFilter filter, DrawOrder order);

    const DrawList& list() const { return list_; }
    /// InstanceRows in the order of list().instances; no buffer while that is empty.
    const Buffer& rows() const { return rows_; }

private:
    bool isCurrent_ = false;
    DrawView view_;
    DrawFilter filter_ = DrawFilter::All;
    DrawOrder order_ = DrawOrder::FrontToBack;
    DrawList list_;
    Buffer rows_;
};

}  // namespace crevice
