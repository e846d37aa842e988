// Exposure, tone mapping and sRGB encoding, or another effect over the finished frame, into finalColor.
#include "CocosTargets.h"
#include "flow/RenderStage.h"

namespace crevice {
namespace {

class PostProcessStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        io.color("finalColor");
        draw_ = io.fullscreen(isCocos(io.profile()) ? "pipeline/post-process" : "post-process");
        if (io.profile() == Profile::Cocos36) io.input(draw_, 0, litTarget(io.profile()));
    }
    void render(FrameContext& frame) override { frame.draw(draw_); }

private:
    DrawId draw_;
};

}  // namespace

void registerPostProcessStage(StageRegistry& registry) {
    registry.add<PostProcessStage>("PostProcessStage",
                                   {.priority = 19, .help = "Exposure, tone mapping, sRGB; or FXAA."});
}

}  // namespace crevice
