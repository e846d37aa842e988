// Hands a stage's calls to its execution.
#include "flow/FrameContext.h"

#include "flow/StageExecution.h"

namespace crevice {

glm::uvec2 FrameContext::extent() const { return execution_.extent(); }

const FrameCrop& FrameContext::part() const { return execution_.part(); }

void FrameContext::draw(DrawId draw) { execution_.draw(draw); }

void FrameContext::drawQueue(QueueId queue) {
    execution_.drawQueue(queue, view_.camera.view, view_.projection * view_.camera.view);
}

void FrameContext::drawQueue(QueueId queue, const glm::mat4& view, const glm::mat4& viewProjection) {
    execution_.drawQueue(queue, view, viewProjection);
}

void FrameContext::drawPerLight(QueueId queue) {
    execution_.drawPerLight(queue, view_.camera.view, view_.projection * view_.camera.view);
}

void FrameContext::dispatch(DrawId draw, Groups groups) { execution_.dispatch(draw, groups); }

Groups FrameContext::groupsFor(DrawId draw) const { return execution_.groupsFor(draw); }

Commands& FrameContext::commands() { return execution_.commands(); }

void FrameContext::uploadBytes(BlockId block, std::span<const std::byte> bytes) { execution_.upload(block, bytes); }

}  // namespace crevice
