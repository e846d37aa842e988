// Draws opaque geometry with lighting in one pass, into colour and depth; Cocos' lights follow one at a time.
#include "CocosTargets.h"
#include "flow/RenderStage.h"

namespace crevice {
namespace {

class ForwardStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        const bool cocos = isCocos(io.profile());
        io.color("cc_lighting_resultMap");
        io.depth("depth", DepthUse::Write);
        queues_ = declareQueues(io, "default", QueueSort::FrontToBack, cocos ? "builtin-standard" : "standard");
        if (cocos) lights_ = io.perLight("forward-add", "builtin-standard");
    }
    void render(FrameContext& frame) override {
        for (const QueueId queue : queues_) frame.drawQueue(queue);
        if (lights_) frame.drawPerLight(*lights_);
    }

private:
    std::vector<QueueId> queues_;
    std::optional<QueueId> lights_;
};

}  // namespace

void registerForwardStage(StageRegistry& registry) {
    registry.add<ForwardStage>("ForwardStage", {.priority = 10, .help = "Opaque geometry, lit while it is drawn."});
}

}  // namespace crevice
