// Lights the G-buffer: one full-screen draw into cc_lighting_resultMap.
#include "CocosTargets.h"
#include "flow/RenderStage.h"

namespace crevice {
namespace {

class LightingStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        io.color(litTarget(io.profile()));
        if (!isCocos(io.profile())) {
            draw_ = io.fullscreen("deferred-lighting");
            return;
        }
        // Cocos' quad lies on the far plane and is lit where something nearer was drawn; blended objects follow it.
        io.depth("depth", DepthUse::Test);
        draw_ = io.fullscreen("pipeline/deferred-lighting");
        bindGbuffer(io, draw_);
        for (std::size_t i = 0; i < io.documentQueues().size(); ++i)
            queues_.push_back(io.queue("default", QueueSort::BackToFront, "builtin-standard"));
    }
    void render(FrameContext& frame) override {
        frame.draw(draw_);
        for (const QueueId queue : queues_) frame.drawQueue(queue);
    }

private:
    DrawId draw_;
    std::vector<QueueId> queues_;
};

}  // namespace

void registerLightingStage(StageRegistry& registry) {
    registry.add<LightingStage>("LightingStage", {.priority = 15, .help = "Full-screen lighting of the G-buffer."});
}

}  // namespace crevice
