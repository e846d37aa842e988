// Fills Cocos' blocks: pure arithmetic, tested without a GPU. Conventions are those of its Vulkan back end.
#include "flow/CocosFrame.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "flow/FrameData.h"
#include "flow/ShadowView.h"
#include "scene/DrawList.h"

namespace crevice {
namespace {

constexpr float kStandardExposure = 1.0f / 38400.0f;  // f/16, 1/125 s, ISO 100
constexpr float kPi = 3.14159265358979f;
constexpr float kDarkest = 1.0f / 255.0f;

float power(const Light& light) {
    return glm::dot(light.color, glm::vec3(0.2126f, 0.7152f, 0.0722f)) * light.intensity;
}

/// Where a light without range has fallen below one step of an 8-bit picture on a white surface.
float rangeOf(const Light& light, float exposure) {
    return light.range > 0 ? light.range : std::sqrt(std::max(power(light), 0.0f) * exposure / (kPi * kDarkest));
}

/// Members that both versions have under the same name.
template <class Block>
void fillCamera(Block& block, const FrameView& view, const Scene& scene, bool hdr) {
    const CameraBlock base = cameraBlock(view, scene);
    block.view = base.view, block.viewInv = base.viewInv;
    block.proj = base.proj, block.projInv = base.projInv;
    block.viewProj = base.viewProj, block.viewProjInv = base.viewProjInv;
    block.position = base.position;
    block.exposure = {view.exposure, 1.0f / view.exposure, hdr ? 1.0f : 0.0f, 1.0f / kStandardExposure};
    block.mainLitDir = glm::vec4(glm::vec3(base.mainLitDir), 0.0f);  // w: there is no shadow map of it
    block.mainLitColor = base.mainLitColor;
    block.mainLitColor.w *= view.exposure;
    // One illuminance scales both colours: the larger component of the two, so that colours are at most 1.
    const Ambient ambient = ambientOf(scene);
    const glm::vec3 most = glm::max(ambient.sky, ambient.ground);
    const float illuminance = std::max({most.x, most.y, most.z});
    const float scale = illuminance > 0 ? 1.0f / illuminance : 0.0f;
    block.ambientSky = glm::vec4(ambient.sky * scale, illuminance * view.exposure);
    block.ambientGround = glm::vec4(ambient.ground * scale, 0.0f);
    block.fogColor = base.fogColor, block.fogBase = base.fogBase;
}

}  // namespace

bool cocosHdr(const PipelineDesc& desc) {
    const Value* macro = desc.macros.isObject() ? desc.macros.find("CC_USE_HDR") : nullptr;
    if (!macro) return desc.profile == Profile::Cocos36;
    if (macro->isBool()) return macro->boolean();
    return macro->isNumber() ? macro->number() != 0 : macro->isString() && macro->string() != "0";
}

GlobalBlock36 cocosGlobal36(const FrameView& view) {
    const GlobalBlock base = globalBlock(view);
    GlobalBlock36 block{.time = base.time, .screenSize = base.screenSize, .nativeSize = base.nativeSize};
    for (glm::vec4& pack : block.debugViewPacks) pack = glm::vec4(1);
    return block;
}

CameraBlock cocosCamera33(const FrameView& view, const Scene& scene, bool hdr) {
    CameraBlock block;
    fillCamera(block, view, scene, hdr);
    return block;
}

CameraBlock36 cocosCamera36(const FrameView& view, const Scene& scene, bool hdr) {
    CameraBlock36 block;
    fillCamera(block, view, scene, hdr);
    block.nearFar = {view.camera.near, view.camera.far, 0, 0};
    block.viewPort = {0, 0, glm::vec2(view.extent)};
    return block;
}

std::vector<std::size_t> relevantLights(const FrameView& view, const Scene& scene, int& left) {
    const Frustum frustum(view.projection * view.camera.view);
    const glm::vec3 eye = view.camera.position();
    std::vector<std::size_t> seen;
    std::vector<float> score(scene.lights.size(), 0.0f);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (light.type == LightType::Directional) continue;
        Aabb reach;
        const float range = rangeOf(light, view.exposure);
        reach.add(light.position - range);
        reach.add(light.position + range);
        if (!frustum.intersects(reach)) continue;
        const glm::vec3 offset = light.position - eye;
        score[i] = power(light) / std::max(glm::dot(offset, offset), kCocosLightSize * kCocosLightSize);
        seen.push_back(i);
    }
    std::stable_sort(seen.begin(), seen.end(), [&](std::size_t a, std::size_t b) { return score[a] > score[b]; });
    left = std::max(0, static_cast<int>(seen.size()) - kForwardLights);
    seen.resize(std::min<std::size_t>(seen.size(), kForwardLights));
    return seen;
}

ForwardLightBlock cocosLights(const FrameView& view, const Scene& scene, const std::vector<std::size_t>& lights) {
    ForwardLightBlock block;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Light& light = scene.lights[lights[i]];
        const bool spot = light.type == LightType::Spot;
        const float size = light.size > 0 ? light.size : kCocosLightSize;
        block.position[i] = glm::vec4(light.position, spot ? 1.0f : 0.0f);
        block.color[i] = glm::vec4(light.color, light.intensity * view.exposure / (size * size));
        block.sizeRangeAngle[i] = {size, rangeOf(light, view.exposure), spot ? std::cos(light.outerAngle) : 0.0f, 0.0f};
        block.direction[i] = glm::vec4(light.direction, 0.0f);
    }
    block.direction[0].w = static_cast<float>(lights.size());
    return block;
}

}  // namespace crevice
