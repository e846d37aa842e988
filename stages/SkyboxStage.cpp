// Fills what no geometry covered: the scene's environment, its gradient sky, or nothing.
#include "CocosTargets.h"
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
        io.color(litTarget(io.profile()));
        io.depth("depth", DepthUse::Test);
        draw_ = io.fullscreen(isCocos(io.profile()) ? "cocos-skybox" : "skybox");
        if (io.profile() == Profile::Cocos36) io.define(draw_, "COCOS_VERSION", "36");
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
