// Fills what no geometry covered: the scene's environment, its gradient sky, or nothing.
#include "flow/RenderStage.h"

namespace crevice {
namespace {

Value colorValue(const glm::vec3& color) {
    Value value = Value::makeArray();
    for (int i = 0; i < 3; ++i) value.items().push_back(Value::makeNumber(color[i]));
    return value;
}

class SkyboxStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        io.color("cc_lighting_resultMap");
        io.depth("depth", DepthUse::Test);
        draw_ = io.fullscreen("skybox");
    }
    void activate(StageSetup& setup) override {
        const Sky& sky = setup.scene().sky;
        setup.setProperty(draw_, "zenith", colorValue(sky.zenith));
        setup.setProperty(draw_, "horizon", colorValue(sky.horizon));
        setup.setProperty(draw_, "nadir", colorValue(sky.nadir));
    }
    void render(FrameContext& frame) override {
        const std::optional<Environment>& environment = frame.scene().environment;
        if (frame.scene().sky.enabled || (environment && environment->visible)) frame.draw(draw_);
    }

private:
    DrawId draw_;
};

}  // namespace

void registerSkyboxStage(StageRegistry& registry) {
    registry.add<SkyboxStage>("SkyboxStage",
                              {.priority = 16, .help = "The scene's environment or sky behind everything."});
}

}  // namespace crevice
