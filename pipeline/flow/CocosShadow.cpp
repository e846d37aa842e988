// The members are those of the engine's shadow chunks: rows of the projection that let a shader move a point in the
// light's depth without its inverse.
#include "flow/CocosShadow.h"

#include <span>

#include "flow/CocosMacros.h"
#include "plan/TargetSize.h"

namespace crevice {
namespace {

constexpr float kSpot = 1, kDirectional = 0;
const glm::vec4 kShadowColor(0, 0, 0, 76.0f / 255.0f);  // the engine's default; only planar shadows use it

LightShadow lookOf(const ShadowView& view, const Light& light, const ShadowSettings& settings) {
    if (light.shadow) return *light.shadow;
    return {.bias = settings.bias * (view.far - view.near), .pcf = settings.pcf};
}

/// (m10, m14, m11, m15) and (m00, m05, 1 / m00, 1 / m05) of a matrix, as Cocos counts its elements.
glm::vec4 depthInfo(const glm::mat4& m) { return {m[2][2], m[3][2], m[2][3], m[3][3]}; }
glm::vec4 planeInfo(const glm::mat4& m) { return {m[0][0], m[1][1], 1 / m[0][0], 1 / m[1][1]}; }

template <class Block>
void fill(Block& block, const ShadowView& view, const Light& light, const ShadowSettings& settings) {
    const LightShadow look = lookOf(view, light, settings);
    block.lightView = view.view;
    block.lightViewProj = view.projection * view.view;
    block.invProjDepthInfo = depthInfo(glm::inverse(view.projection));
    block.projDepthInfo = depthInfo(view.projection);
    block.projInfo = planeInfo(view.projection);
    block.nearFar = {view.near, view.far, 0, 1 - look.saturation};
    block.sizeBias = glm::vec4(settings.size, static_cast<float>(look.pcf), look.bias);
    block.typeNormal = {light.type == LightType::Spot ? kSpot : kDirectional, 0, look.normalBias, 0};
    block.color = kShadowColor;
}

/// Every point lands at (2, 2, 2), outside of the map, whichever way a shader takes to get there.
template <class Block>
void fillLit(Block& block) {
    block.lightViewProj = glm::mat4(0);
    block.lightViewProj[3] = {2, 2, 2, 1};
    block.invProjDepthInfo = {0, -1, 0, 0};
    block.projDepthInfo = {0, 2, -1, 0};
    block.projInfo = glm::vec4(1);
    block.nearFar = {0, 1, 0, 1};
    block.sizeBias = {1, 1, 0, 0};
    block.typeNormal = {2, 0, 0, 0};
    block.color = kShadowColor;
}

template <class Block>
std::vector<std::byte> make(const ShadowView* view, const Light* light, const ShadowSettings& settings) {
    Block block;
    if (view && light) {
        fill(block, *view, *light, settings);
    } else {
        fillLit(block);
    }
    const auto bytes = std::as_bytes(std::span(&block, 1));
    return {bytes.begin(), bytes.end()};
}

}  // namespace

int pcfType(int choice) { return choice == 0 ? 0 : choice + 1; }

ShadowSettings shadowSettings(const PipelineDesc& desc, bool spot, glm::uvec2 frame) {
    ShadowSettings settings;
    const StageDesc* stage = shadowStage(desc, spot ? "spot" : "directional");
    if (stage && stage->params.isObject()) {
        if (const Value* bias = stage->params.find("bias"); bias && bias->isNumber())
            settings.bias = static_cast<float>(bias->number());
        if (const Value* pcf = stage->params.find("pcf"); pcf && pcf->isString())
            settings.pcf = pcfType(pcf->string() == "1x1" ? 0 : pcf->string() == "5x5" ? 2 : 1);
    }
    const TargetDesc* map = desc.findTarget(shadowMapName(desc.profile, spot));
    if (map) settings.size = glm::vec2(targetExtent(*map, frame.x, frame.y));
    return settings;
}

std::vector<std::byte> shadowBlock(Profile profile, const ShadowView* view, const Light* light,
                                   const ShadowSettings& settings) {
    return profile == Profile::Cocos36 ? make<ShadowBlock36>(view, light, settings)
                                       : make<ShadowBlock>(view, light, settings);
}

}  // namespace crevice
