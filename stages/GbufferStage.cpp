// Draws opaque geometry into the G-buffer: albedo, world position, world normal, emissive, linear view depth.
#include "CocosTargets.h"
#include "flow/RenderStage.h"

namespace crevice {
namespace {

class GbufferStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        for (const char* target : gbufferTargets(io.profile())) io.color(target);
        if (!isCocos(io.profile())) io.color("viewDepth");
        io.depth("depth", DepthUse::Write);
        queues_ = declareQueues(io, phaseOf(io.profile()), QueueSort::FrontToBack,
                                isCocos(io.profile()) ? "builtin-standard" : "standard");
    }
    void render(FrameContext& frame) override {
        for (const QueueId queue : queues_) frame.drawQueue(queue);
    }

private:
    static const char* phaseOf(Profile profile) {
        if (profile == Profile::Cocos36) return "default";
        return profile == Profile::Cocos33 ? "deferred" : "gbuffer";
    }

    std::vector<QueueId> queues_;
};

}  // namespace

void registerGbufferStage(StageRegistry& registry) {
    registry.add<GbufferStage>("GbufferStage",
                               {.priority = 10, .help = "Opaque geometry into the G-buffer maps and viewDepth."});
}

}  // namespace crevice
