// Fills Cocos' blocks: pure arithmetic, tested without a GPU. Conventions are those of its Vulkan back end.
#include "flow/CocosFrame.h"

#include <algorithm>
#include <cmath>

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

/// Members that both versions have under the same name.
template <class Block>
void fillCamera(Block& block, const FrameView& view, const Scene& scene, const CocosLook& look) {
    const CameraBlock base = cameraBlock(view, scene);
    block.view = base.view, block.viewInv = base.viewInv;
    block.proj = base.proj, block.projInv = base.projInv;
    block.viewProj = base.viewProj, block.viewProjInv = base.viewProjInv;
    block.position = base.position;
    block.exposure = {view.exposure, 1.0f / view.exposure, look.hdr ? 1.0f : 0.0f, 1.0f / kStandardExposure};
    block.mainLitDir = glm::vec4(glm::vec3(base.mainLitDir), look.shadows ? base.mainLitDir.w : 0.0f);
    block.mainLitColor = base.mainLitColor;
    block.mainLitColor.w *= view.exposure;
    // One illuminance scales both colours: the larger component of the two, so that colours are at most 1.
    const Ambient ambient = ambientOf(scene);
    const float scale = ambientScale(scene);
    const bool dark = !scene.environment && ambient.sky == glm::vec3(0) && ambient.ground == glm::vec3(0);
    block.ambientSky = glm::vec4(ambient.sky / scale, dark ? 0.0f : scale * view.exposure);
    block.ambientGround = glm::vec4(ambient.ground / scale, static_cast<float>(look.environmentLevels));
    block.fogColor = glm::vec4(scene.fog.color * view.exposure, 1.0f);
    block.fogBase = base.fogBase;
    block.fogAdd = {scene.fog.top, scene.fog.range, scene.fog.attenuation, 0.0f};
}

}  // namespace

float cocosRange(const Light& light, float exposure) {
    return light.range > 0 ? light.range : std::sqrt(std::max(power(light), 0.0f) * exposure / (kPi * kDarkest));
}

Aabb cocosReach(const Light& light, float exposure) {
    const float range = cocosRange(light, exposure);
    Aabb reach;
    reach.add(light.position - range);
    reach.add(light.position + range);
    return reach;
}

float ambientScale(const Scene& scene) {
    const Ambient ambient = ambientOf(scene);
    const glm::vec3 most = glm::max(ambient.sky, ambient.ground);
    const float scale = std::max({most.x, most.y, most.z});
    return scale > 0 ? scale : 1.0f;
}

GlobalBlock36 cocosGlobal36(const FrameView& view) {
    const GlobalBlock base = globalBlock(view);
    GlobalBlock36 block{.time = base.time, .screenSize = base.screenSize, .nativeSize = base.nativeSize};
    for (glm::vec4& pack : block.debugViewPacks) pack = glm::vec4(1);
    return block;
}

CameraBlock cocosCamera33(const FrameView& view, const Scene& scene, const CocosLook& look) {
    CameraBlock block;
    fillCamera(block, view, scene, look);
    return block;
}

CameraBlock36 cocosCamera36(const FrameView& view, const Scene& scene, const CocosLook& look) {
    CameraBlock36 block;
    fillCamera(block, view, scene, look);
    block.nearFar = {view.camera.near, view.camera.far, 0, 0};
    block.viewPort = {0, 0, glm::vec2(view.extent)};
    return block;
}

std::vector<std::size_t> relevantLights(const FrameView& view, const Scene& scene, int& left, std::size_t most) {
    const Frustum frustum(view.projection * view.camera.view);
    const glm::vec3 eye = view.camera.position();
    std::vector<std::size_t> seen;
    std::vector<float> score(scene.lights.size(), 0.0f);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (light.type == LightType::Directional) continue;
        if (!frustum.intersects(cocosReach(light, view.exposure))) continue;
        const glm::vec3 offset = light.position - eye;
        score[i] = power(light) / std::max(glm::dot(offset, offset), kCocosLightSize * kCocosLightSize);
        seen.push_back(i);
    }
    std::stable_sort(seen.begin(), seen.end(), [&](std::size_t a, std::size_t b) { return score[a] > score[b]; });
    left = seen.size() > most ? static_cast<int>(seen.size() - most) : 0;
    seen.resize(std::min(seen.size(), most));
    return seen;
}

ForwardLightBlock cocosLights(const FrameView& view, const Scene& scene, const std::vector<std::size_t>& lights,
                              const CocosLook& look) {
    const Light* shadowed = look.spotShadows ? shadowedSpot(scene) : nullptr;
    ForwardLightBlock block;
    for (std::size_t i = 0; i < lights.size() && i < std::size_t(kForwardLights); ++i) {
        const Light& light = scene.lights[lights[i]];
        const bool spot = light.type == LightType::Spot;
        const float size = light.size > 0 ? light.size : kCocosLightSize;
        block.position[i] = glm::vec4(light.position, spot ? 1.0f : 0.0f);
        block.color[i] = glm::vec4(light.color, light.intensity * view.exposure / (size * size));
        block.sizeRangeAngle[i] = {size, cocosRange(light, view.exposure), spot ? std::cos(light.outerAngle) : 0.0f,
                                   &light == shadowed ? 1.0f : 0.0f};
        block.direction[i] = glm::vec4(light.direction, 0.0f);
    }
    block.direction[0].w = static_cast<float>(lights.size());
    return block;
}

SingleLightBlock singleLight(const ForwardLightBlock& lights, std::size_t index) {
    SingleLightBlock block{.position = lights.position[index],
                           .color = lights.color[index],
                           .sizeRangeAngle = lights.sizeRangeAngle[index],
                           .direction = lights.direction[index]};
    block.direction.w = 1;
    return block;
}

}  // namespace crevice
