// Draws back faces for techniques that ask how thick things are: linear view depth of the next back surface behind
// viewDepth.
#include "flow/RenderStage.h"

namespace crevice {
namespace {

class BackFaceStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        io.color("backDepth");
        // Of its own: the G-buffer's depth is needed afterwards.
        io.depth("backDepthBuffer", DepthUse::Write);
        queue_ = io.queue("back-face", QueueSort::FrontToBack);
    }
    void render(FrameContext& frame) override { frame.drawQueue(queue_); }

private:
    QueueId queue_;
};

}  // namespace

void registerBackFaceStage(StageRegistry& registry) {
    registry.add<BackFaceStage>(
        "BackFaceStage",
        {.priority = 11,
         .help = "Back faces into backDepth: how far it is to the next back surface behind viewDepth."});
}

}  // namespace crevice
