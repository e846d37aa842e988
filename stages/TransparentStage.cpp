// Draws blended geometry over the lit frame, forward-shaded, back to front.
#include "flow/RenderStage.h"

namespace crevice {
namespace {

class TransparentStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        io.color("cc_lighting_resultMap");
        io.depth("depth", DepthUse::Test);
        queue_ = io.queue("default", QueueSort::BackToFront);
    }
    void render(FrameContext& frame) override { frame.drawQueue(queue_); }

private:
    QueueId queue_;
};

}  // namespace

void registerTransparentStage(StageRegistry& registry) {
    registry.add<TransparentStage>("TransparentStage", {.priority = 18, .help = "Blended geometry, back to front."});
}

}  // namespace crevice
