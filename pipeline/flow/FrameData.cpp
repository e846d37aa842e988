// Fills the frame's blocks from camera and scene: pure arithmetic, tested without a GPU.
#include "flow/FrameData.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "flow/ShadowView.h"

namespace crevice {
namespace {

constexpr float kWhiteAtAutoExposure = 0.8f;
constexpr float kPi = 3.14159265358979f;

float luminance(const glm::vec3& color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

PunctualLight pack(const Light& light) {
    PunctualLight packed;
    packed.positionRange = glm::vec4(light.position, light.range);
    packed.colorIntensity = glm::vec4(light.color, light.intensity);
    const float type = light.type == LightType::Point ? 0.0f : light.type == LightType::Spot ? 1.0f : 2.0f;
    packed.directionType = glm::vec4(light.direction, type);
    const float cosOuter = std::cos(light.outerAngle);
    const float cosInner = std::cos(light.innerAngle);
    packed.cone = glm::vec4(cosOuter, 1.0f / std::max(cosInner - cosOuter, 1e-3f), 0, 0);
    return packed;
}

}  // namespace

FrameView guardedView(const FrameView& view, std::uint32_t guard) {
    if (guard == 0) return view;
    FrameView wide = view;
    wide.extent = view.extent + 2 * guard;
    // The border is as wide on both sides, so the centre stays: clip x and y shrink by frame / (frame + 2 guard),
    // whatever the projection (rows 0 and 1, the lens shift in them included). Depth is left alone.
    const glm::vec2 share = glm::vec2(view.extent) / glm::vec2(wide.extent);
    for (int column = 0; column < 4; ++column) {
        wide.projection[column].x *= share.x;
        wide.projection[column].y *= share.y;
    }
    wide.camera.fovY = 2.0f * std::atan(std::tan(0.5f * view.camera.fovY) / share.y);
    wide.camera.orthoHeight /= share.y;
    wide.camera.lensShift *= share;
    return wide;
}

Ambient ambientOf(const Scene& scene) {
    if (!litByEnvironment(scene)) return scene.ambient.value_or(Ambient{});
    return {.sky = scene.environment->diffuse({0, 1, 0}), .ground = scene.environment->diffuse({0, -1, 0})};
}

GlobalBlock globalBlock(const FrameView& view) {
    const glm::vec2 size(view.extent);
    GlobalBlock block;
    block.time = {view.time, view.deltaTime, static_cast<float>(view.frameIndex), view.time - std::floor(view.time)};
    block.screenSize = {size, 1.0f / size};
    block.nativeSize = block.screenSize;
    return block;
}

CameraBlock cameraBlock(const FrameView& view, const Scene& scene) {
    CameraBlock block;
    block.view = view.camera.view;
    block.viewInv = glm::inverse(block.view);
    block.proj = view.projection;
    block.projInv = glm::inverse(block.proj);
    block.viewProj = block.proj * block.view;
    block.viewProjInv = block.viewInv * block.projInv;
    block.position = glm::vec4(view.camera.position(), 0.0f);
    block.exposure = {view.exposure, 1.0f / view.exposure, 1.0f, 1.0f};
    if (const Light* main = mainLight(scene)) {
        block.mainLitDir = glm::vec4(main->direction, main->castsShadow ? 1.0f : 0.0f);
        block.mainLitColor = glm::vec4(main->color, main->intensity);
    }
    const Ambient ambient = ambientOf(scene);
    block.ambientSky = glm::vec4(ambient.sky, 1.0f);
    block.ambientGround = glm::vec4(ambient.ground, 0.0f);
    block.fogColor = glm::vec4(scene.fog.color, 1.0f);
    block.fogBase = {scene.fog.start, scene.fog.end, scene.fog.density, 0.0f};
    block.fogAdd.w = scene.fog.type == FogType::Layered ? 0.0f : static_cast<float>(scene.fog.type);
    return block;
}

std::vector<std::byte> punctualLights(const Scene& scene) {
    const Light* main = mainLight(scene);
    std::vector<PunctualLight> lights;
    for (const Light& light : scene.lights) {
        if (&light != main) lights.push_back(pack(light));
    }
    const glm::uvec4 count(static_cast<std::uint32_t>(lights.size()), 0, 0, 0);
    // A buffer of no lights still needs room for the array's first element.
    std::vector<std::byte> bytes(sizeof count + std::max<std::size_t>(lights.size(), 1) * sizeof(PunctualLight));
    std::memcpy(bytes.data(), &count, sizeof count);
    if (!lights.empty()) std::memcpy(bytes.data() + sizeof count, lights.data(), lights.size() * sizeof(PunctualLight));
    return bytes;
}

ForwardLightBlock forwardLightBlock(const Scene& scene) {
    ForwardLightBlock block;
    int count = 0;
    for (const Light& light : scene.lights) {
        if (light.type == LightType::Directional || count == kForwardLights) continue;
        const bool spot = light.type == LightType::Spot;
        block.position[count] = glm::vec4(light.position, spot ? 1.0f : 0.0f);
        block.color[count] = glm::vec4(light.color, light.intensity);
        block.sizeRangeAngle[count] = {0.0f, light.range, spot ? std::cos(light.outerAngle) : 0.0f, 0.0f};
        block.direction[count] = glm::vec4(light.direction, 0.0f);
        ++count;
    }
    block.direction[0].w = static_cast<float>(count);
    return block;
}

float automaticLength(const Aabb& scene) {
    const float diagonal = scene.diagonal();
    return diagonal > 0 ? std::clamp(diagonal / 40.0f, 2e-6f, 1e6f) : 1.0f;
}

namespace {

float distanceTo(const Aabb& box, const glm::vec3& point) {
    return box.empty ? 0.0f : glm::distance(point, glm::clamp(point, box.min, box.max));
}

/// Whether a lamp can light anything in the box, as glTF's lights do: within its range and, of a spot, its cone, which
/// is tried against the sphere around the box.
bool reaches(const Light& lamp, const Aabb& box) {
    if (lamp.range > 0 && distanceTo(box, lamp.position) >= lamp.range) return false;
    if (lamp.type != LightType::Spot || box.empty) return true;
    const glm::vec3 toCentre = 0.5f * (box.min + box.max) - lamp.position;
    const float distance = glm::length(toCentre), radius = 0.5f * box.diagonal();
    if (distance <= radius) return true;
    const float cosine = glm::clamp(glm::dot(glm::normalize(lamp.direction), toCentre) / distance, -1.0f, 1.0f);
    return std::acos(cosine) < lamp.outerAngle + std::asin(radius / distance);
}

}  // namespace

float exposureFromEv(float ev) { return 1.0f / (1.2f * std::exp2(ev)); }

float autoExposureEv(const Scene& scene) {
    // Illuminance of a surface that faces the lights: directional light at 45 degrees, hemispheric ambient from both
    // sides, point and spot lights from a quarter of the scene's diagonal inside its bounds.
    const Aabb bounds = scene.bounds();
    const float reach = std::max(0.25f * bounds.diagonal(), 1e-6f);
    float illuminance = 0;
    for (const Light& light : scene.lights) {
        const float power = luminance(light.color) * light.intensity;
        if (light.type != LightType::Directional && !reaches(light, bounds)) continue;
        const float distance = reach + distanceTo(bounds, light.position);
        illuminance += light.type == LightType::Directional ? power * 0.70710678f : power / (distance * distance);
    }
    const Ambient ambient = ambientOf(scene);
    illuminance += kPi * 0.5f * (luminance(ambient.sky) + luminance(ambient.ground));
    if (illuminance <= 0) return std::log2(1.0f / 1.2f);  // nothing but emission: exposure 1
    const float exposure = kWhiteAtAutoExposure * kPi / illuminance;
    return std::log2(1.0f / (1.2f * exposure));
}

}  // namespace crevice
