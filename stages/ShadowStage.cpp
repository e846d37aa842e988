// Renders the depth of shadow casters as one light sees them: the first directional light, or the first spot light.
#include <glm/gtc/matrix_transform.hpp>

#include "flow/FrameBlocks.h"
#include "flow/RenderStage.h"
#include "flow/ShadowView.h"

namespace crevice {
namespace {

enum LightKind { kDirectional, kSpot };
constexpr const char* kLightNames[] = {"directional", "spot"};
constexpr const char* kPcfNames[] = {"1x1", "3x3", "5x5"};

class ShadowStage final : public RenderStage {
public:
    void params(ParamVisitor& v) override {
        v.choice("light", light_, kLightNames,
                 {.help = "Which light: the scene's first directional or first spot light that casts shadows."});
        v.choice("pcf", pcf_, kPcfNames, {.help = "Percentage-closer filter: texels averaged by the lighting."});
        v.field("bias", bias_, {.min = 0, .max = 0.1, .help = "Depth bias, as a share of the light's depth range."});
        v.field("normalBias", normalBias_,
                {.min = 0, .max = 10, .unit = "texels", .help = "Shift along the normal before the look-up."});
    }
    void declare(StageIo& io) override {
        // Cocos' shadow blocks stay empty: its effects are drawn without shadows (docs/cocos-runtime.md).
        if (isCocos(io.profile())) {
            if (io.hasTarget("cc_shadowMap")) io.depth("cc_shadowMap", DepthUse::Write);
            return;
        }
        draws_ = true;
        io.depth(light_ == kSpot ? "cc_spotLightingMap" : "cc_shadowMap", DepthUse::Write);
        camera_ = io.block<CameraBlock>("CCCamera");
        if (light_ == kSpot) {
            spot_ = io.block<SpotShadowBlock>("CCSpotShadow");
        } else {
            shadow_ = io.block<ShadowBlock>("CCShadow");
        }
        queue_ = io.queue("shadow-caster", QueueSort::FrontToBack);
    }
    void activate(StageSetup& setup) override {
        view_ = light_ == kSpot ? spotShadowView(setup.scene(), setup.sceneBounds())
                                : directionalShadowView(setup.scene(), setup.sceneBounds());
    }
    void render(FrameContext& frame) override {
        if (!draws_) return;
        uploadForLighting(frame);
        if (!view_) return;
        // Casters see the light as their camera; the frame's own camera is back when the next stage begins.
        CameraBlock camera;
        camera.view = view_->view;
        camera.proj = view_->projection;
        camera.viewProj = view_->projection * view_->view;
        frame.upload(camera_, camera);
        frame.drawQueue(queue_, camera.view, camera.viewProj);
    }

private:
    void uploadForLighting(FrameContext& frame) {
        const glm::vec2 size(frame.extent());
        const glm::mat4 viewProj = view_ ? view_->projection * view_->view : glm::mat4(1);
        if (light_ == kSpot) {
            SpotShadowBlock block;
            block.viewProj = viewProj;
            block.info = {bias_, static_cast<float>(pcf_), 1.0f / size.x,
                          view_ ? static_cast<float>(view_->punctualIndex) : -1.0f};
            frame.upload(spot_, block);
            return;
        }
        ShadowBlock block;
        if (view_) {
            block.lightView = view_->view;
            block.lightViewProj = viewProj;
            block.nearFar = {view_->near, view_->far, 0.0f, 0.0f};
        }
        block.sizeBias = {size, static_cast<float>(pcf_), bias_};
        // World units of one texel times the normal bias: the lighting shifts its look-up by that along the normal.
        block.typeNormal = {0.0f, 0.0f, view_ ? normalBias_ * view_->width / size.x : 0.0f, view_ ? 1.0f : 0.0f};
        frame.upload(shadow_, block);
    }

    bool draws_ = false;
    int light_ = kDirectional;
    int pcf_ = 1;
    float bias_ = 0.0008f;
    float normalBias_ = 1.5f;
    std::optional<ShadowView> view_;
    BlockId camera_, shadow_, spot_;
    QueueId queue_;
};

}  // namespace

void registerShadowStage(StageRegistry& registry) {
    registry.add<ShadowStage>("ShadowStage", {.priority = 0, .help = "Shadow map of a directional or spot light."});
}

}  // namespace crevice
