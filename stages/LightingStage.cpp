// Lights the G-buffer: one full-screen draw into cc_lighting_resultMap.
#include "flow/RenderStage.h"

namespace crevice {
namespace {

class LightingStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        io.color("cc_lighting_resultMap");
        draw_ = io.fullscreen("deferred-lighting");
    }
    void render(FrameContext& frame) override { frame.draw(draw_); }

private:
    DrawId draw_;
};

}  // namespace

void registerLightingStage(StageRegistry& registry) {
    registry.add<LightingStage>("LightingStage", {.priority = 15, .help = "Full-screen lighting of the G-buffer."});
}

}  // namespace crevice
