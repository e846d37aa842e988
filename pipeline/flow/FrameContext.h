// What a stage may do in render(): targets are bound, barriers are done, set 0 is bound, the viewport is set.
#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "flow/StageIo.h"
#include "plan/TargetSize.h"
#include "scene/Scene.h"

namespace crevice {

class Commands;
class StageExecution;

/// Numbers of work groups of a dispatch.
struct Groups {
    std::uint32_t x = 1, y = 1, z = 1;
};

/// One camera's frame as the pipeline sees it.
struct FrameView {
    Camera camera;                 ///< near and far are filled in.
    glm::uvec2 extent{1280, 720};  ///< Pixels of the frame; while stages run, with the pipeline's guard around it.
    glm::mat4 projection{1};
    float exposure = 1;  ///< Factor from scene luminance to 1.0 before tone mapping.
    std::uint32_t frameIndex = 0;
    float time = 0, deltaTime = 0;  ///< Seconds.
};

class FrameContext {
public:
    FrameContext(StageExecution& execution, const FrameView& view, const Scene& scene)
        : execution_(execution), view_(view), scene_(scene) {}

    const Camera& camera() const { return view_.camera; }
    const FrameView& view() const { return view_; }
    const Scene& scene() const { return scene_; }
    /// Pixels of what this stage writes; the frame's for a stage that writes nothing.
    glm::uvec2 extent() const;
    /// The part of extent() that is needed: what shows the frame and what later stages read of the guard. Draws are cut
    /// to it; the rest keeps what it was cleared to. Dispatches are not cut: they have to write all that they own.
    const FrameCrop& part() const;

    /// Fills a block of set 0 for the draws recorded after it.
    template <class T>
    void upload(BlockId block, const T& data) {
        uploadBytes(block, std::as_bytes(std::span(&data, 1)));
    }

    /// The same with bytes of the block's size.
    void uploadBytes(BlockId block, std::span<const std::byte> bytes);

    void draw(DrawId draw);
    /// Draws the queue as the camera sees it.
    void drawQueue(QueueId queue);
    /// Draws the queue as another viewer sees it (a light): culled and sorted by `viewProjection`. The view is for
    /// sorting.
    void drawQueue(QueueId queue, const glm::mat4& view, const glm::mat4& viewProjection);
    /// Draws the queue once for each light that the frame's view sees, with that light alone in CCForwardLight and its
    /// map in CCShadow: what its reach touches. Cocos' profiles only.
    void drawPerLight(QueueId queue);
    void dispatch(DrawId draw, Groups groups);
    /// Work groups that cover extent() with the effect's own local size.
    Groups groupsFor(DrawId draw) const;

    /// Escape hatch: raw recording inside this stage.
    Commands& commands();

private:
    StageExecution& execution_;
    const FrameView& view_;
    const Scene& scene_;
};

}  // namespace crevice
