// Draws opaque geometry into the G-buffer: albedo, world position, world normal, emissive, linear view depth.
#include "flow/RenderStage.h"

namespace crevice {
namespace {

class GbufferStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        io.color("cc_gbuffer_albedoMap");
        io.color("cc_gbuffer_positionMap");
        io.color("cc_gbuffer_normalMap");
        io.color("cc_gbuffer_emissiveMap");
        io.color("viewDepth");
        io.depth("depth", DepthUse::Write);
        queue_ = io.queue("gbuffer", QueueSort::FrontToBack);
    }
    void render(FrameContext& frame) override { frame.drawQueue(queue_); }

private:
    QueueId queue_;
};

}  // namespace

void registerGbufferStage(StageRegistry& registry) {
    registry.add<GbufferStage>("GbufferStage",
                               {.priority = 10, .help = "Opaque geometry into the G-buffer maps and viewDepth."});
}

}  // namespace crevice
