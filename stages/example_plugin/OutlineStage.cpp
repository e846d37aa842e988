// Draws lines where depth or normals of neighbouring pixels jump: an example of a stage in a shared library.
#include "flow/RenderStage.h"

struct OutlineBlock {  // Mirrors `CCOutline` in outline.effect.
    glm::vec4 color{0, 0, 0, 1};
    glm::vec4 limits{0};  ///< Distance of the neighbours in pixels, depth jump, cosine of the angle, unused.
};

class OutlineStage final : public crevice::RenderStage {
public:
    void params(crevice::ParamVisitor& v) override {
        v.field("color", data_.color, {.min = 0, .max = 1, .help = "Of the lines, as displayed; alpha is opacity."});
        v.field("width", width_, {.min = 1, .max = 8, .unit = "pixels", .help = "Reach of a line to either side."});
        v.field("depthJump", depthJump_, {.min = 0, .max = 1, .help = "Jump that draws, as a share of the depth."});
        v.field("angle", angle_, {.min = 0, .max = 180, .unit = "degrees", .help = "Bend of a surface that draws."});
    }
    void declare(crevice::StageIo& io) override {
        io.color("outlined");
        block_ = io.block<OutlineBlock>("CCOutline");
        draw_ = io.fullscreen("outline");
    }
    void activate(crevice::StageSetup&) override {
        data_.limits = {float(width_), depthJump_, std::cos(glm::radians(angle_)), 0};
    }
    void render(crevice::FrameContext& frame) override {
        frame.upload(block_, data_);
        frame.draw(draw_);
    }

private:
    OutlineBlock data_;
    std::uint32_t width_ = 1;
    float depthJump_ = 0.1f, angle_ = 40;
    crevice::BlockId block_;
    crevice::DrawId draw_;
};

CREVICE_PLUGIN(registry) { registry.add<OutlineStage>("OutlineStage", {.priority = 20, .help = "Lines along edges."}); }
