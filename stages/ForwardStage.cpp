// Draws opaque geometry with lighting in one pass, into colour and depth.
#include "flow/RenderStage.h"

namespace crevice {
namespace {

class ForwardStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        io.color("cc_lighting_resultMap");
        io.depth("depth", DepthUse::Write);
        queue_ = io.queue("default", QueueSort::FrontToBack);
    }
    void render(FrameContext& frame) override { frame.drawQueue(queue_); }

private:
    QueueId queue_;
};

}  // namespace

void registerForwardStage(StageRegistry& registry) {
    registry.add<ForwardStage>("ForwardStage", {.priority = 10, .help = "Opaque geometry, lit while it is drawn."});
}

}  // namespace crevice
