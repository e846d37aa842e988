// Renders the depth of shadow casters as one light sees them: the first directional light, or the first spot light.
#include <glm/gtc/matrix_transform.hpp>

#include "flow/CocosMacros.h"
#include "flow/CocosShadow.h"
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
        profile_ = io.profile();
        if (isCocos(profile_)) return declareCocos(io);
        io.depth(light_ == kSpot ? "cc_spotLightingMap" : "cc_shadowMap", DepthUse::Write);
        camera_ = io.block<CameraBlock>("CCCamera");
        if (light_ == kSpot) {
            spot_ = io.block<SpotShadowBlock>("CCSpotShadow");
        } else {
            shadow_ = io.block<ShadowBlock>("CCShadow");
        }
        queue_ = io.casters("standard");
    }
    void activate(StageSetup& setup) override {
        view_ = light_ == kSpot ? spotShadowView(setup.scene(), setup.sceneBounds())
                                : directionalShadowView(setup.scene(), setup.sceneBounds());
    }
    void render(FrameContext& frame) override {
        if (isCocos(profile_)) return renderCocos(frame);
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
    /// Cocos' maps hold depth as a colour, which its casters write; a document without a map has no shadows.
    void declareCocos(StageIo& io) {
        const std::string map(shadowMapName(profile_, light_ == kSpot)), depth(shadowDepthName(light_ == kSpot));
        if (!io.hasTarget(map)) return;
        draws_ = true;
        io.color(map);
        io.depth(depth, DepthUse::Write);
        shadow_ =
            profile_ == Profile::Cocos36 ? io.block<ShadowBlock36>("CCShadow") : io.block<ShadowBlock>("CCShadow");
        queue_ = io.casters("builtin-standard");
    }
    void renderCocos(FrameContext& frame) {
        if (!draws_ || !view_) return;
        const Light* light = light_ == kSpot ? shadowedSpot(frame.scene()) : mainLight(frame.scene());
        frame.uploadBytes(shadow_,
                          shadowBlock(profile_, &*view_, light,
                                      {.bias = bias_, .pcf = pcfType(pcf_), .size = glm::vec2(frame.extent())}));
        frame.drawQueue(queue_, view_->view, view_->projection * view_->view);
    }
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

    Profile profile_ = Profile::Crevice;
    bool draws_ = false;  ///< Under a Cocos profile: there is a map.
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
