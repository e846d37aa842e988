// A compute dispatch given by the document alone; it covers what it writes with the effect's own local size.
#include "flow/RenderStage.h"

namespace crevice {
namespace {

class ComputeStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        for (const std::string& target : io.documentWrites()) io.storage(target);
        draw_ = io.compute("");
    }
    void render(FrameContext& frame) override { frame.dispatch(draw_, frame.groupsFor(draw_)); }

private:
    DrawId draw_;
};

}  // namespace

void registerComputeStage(StageRegistry& registry) {
    registry.add<ComputeStage>("ComputeStage",
                               {.priority = {}, .help = "Data-only: one compute dispatch of an effect."});
}

}  // namespace crevice
