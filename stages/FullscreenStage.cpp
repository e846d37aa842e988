// A full-screen draw given by the document alone: "effect", "reads", "writes", "material", "defines".
#include "flow/RenderStage.h"

namespace crevice {
namespace {

class FullscreenStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        for (const std::string& target : io.documentWrites()) io.color(target);
        draw_ = io.fullscreen("");
    }
    void render(FrameContext& frame) override { frame.draw(draw_); }

private:
    DrawId draw_;
};

}  // namespace

void registerFullscreenStage(StageRegistry& registry) {
    registry.add<FullscreenStage>("FullscreenStage",
                                  {.priority = {}, .help = "Data-only: one full-screen draw of an effect."});
}

}  // namespace crevice
