// The blocks of set 0 that every frame fills, byte for byte as the chunks in effects/chunks declare them (std140 /
// std430).
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace crevice {

/// Mirrors `CCGlobal` in cc-global.chunk.
struct GlobalBlock {
    glm::vec4 time{0};        ///< total s, delta s, frame, fraction of a second
    glm::vec4 screenSize{0};  ///< w, h, 1/w, 1/h
    glm::vec4 nativeSize{0};
};
static_assert(sizeof(GlobalBlock) == 48);

/// Mirrors `CCCamera` in cc-camera.chunk (profile v33).
struct CameraBlock {
    glm::mat4 view{1}, viewInv{1}, proj{1}, projInv{1}, viewProj{1}, viewProjInv{1};
    glm::vec4 position{0};  ///< w = 0: Vulkan's sign convention
    glm::vec4 screenScale{1};
    glm::vec4 exposure{1, 1, 0, 1};  ///< exposure, 1/exposure, is HDR, 1/standard exposure
    glm::vec4 mainLitDir{0};         ///< the way the light travels; w = 1: casts a shadow
    glm::vec4 mainLitColor{0};       ///< rgb linear, w = illuminance
    glm::vec4 ambientSky{0};
    glm::vec4 ambientGround{0};
    glm::vec4 fogColor{0};
    glm::vec4 fogBase{0};  ///< start, end, density
    glm::vec4 fogAdd{0};   ///< w: 0 none, 1 linear, 2 exp, 3 exp²
};
static_assert(sizeof(CameraBlock) == 544);

/// Mirrors `CCShadow` in cc-shadow.chunk (3.3.1).
struct ShadowBlock {
    glm::mat4 lightPlaneProj{1}, lightView{1}, lightViewProj{1};
    glm::vec4 invProjDepthInfo{0}, projDepthInfo{0}, projInfo{0};
    glm::vec4 nearFar{0};     ///< near, far, 0, 1 - saturation
    glm::vec4 sizeBias{0};    ///< width, height, pcf, bias
    glm::vec4 typeNormal{0};  ///< light type (0 directional, 1 spot), packing, normal bias, 1 = the map is valid
    glm::vec4 color{0};
};
static_assert(sizeof(ShadowBlock) == 304);

/// Mirrors `CCSpotShadow` in cc-spot-shadow.chunk.
struct SpotShadowBlock {
    glm::mat4 viewProj{1};
    glm::vec4 info{0, 0, 0, -1};  ///< bias, pcf, 1/width, index of the light in CCPunctualLights or -1
    glm::vec4 extra{0};
};
static_assert(sizeof(SpotShadowBlock) == 96);

/// One element of `CCPunctualLights` in cc-lights.chunk.
struct PunctualLight {
    glm::vec4 positionRange{0};   ///< world space; w = range, 0 unlimited
    glm::vec4 colorIntensity{0};  ///< rgb linear; w = candela
    glm::vec4 directionType{0};   ///< the way the light travels; w: 0 point, 1 spot
    glm::vec4 cone{0};            ///< cos outer, 1 / (cos inner - cos outer)
};
static_assert(sizeof(PunctualLight) == 64);

/// Mirrors `CCEnvironment` in environment-light.chunk (std430).
struct EnvironmentBlock {
    glm::vec4 info{0, 0, 1, 0};  ///< intensity, last level of cc_environment, cosine and sine of the rotation
    glm::vec4 view{0};           ///< x: level that SkyboxStage shows
    glm::vec4 irradiance[9]{};   ///< rgb over pi, not scaled: factors of shIrradiancePolynomial()
};
static_assert(sizeof(EnvironmentBlock) == 176);

/// Mirrors `CCLocal` in cc-local.chunk, for effects that take the object's matrix from a block.
struct LocalBlock {
    glm::mat4 world{1}, worldIT{1};
    glm::vec4 lightingMapUv{0};
};
static_assert(sizeof(LocalBlock) == 144);

/// Cocos' deferred light block, `CCForwardLight`, for imported effects: at most ten lights, struct of arrays.
inline constexpr int kForwardLights = 10;
struct ForwardLightBlock {
    glm::vec4 position[kForwardLights]{};        ///< world; w: 0 sphere, 1 spot
    glm::vec4 color[kForwardLights]{};           ///< rgb linear; w = luminous intensity
    glm::vec4 sizeRangeAngle[kForwardLights]{};  ///< size, range, cosine of the spot's outer angle
    glm::vec4 direction[kForwardLights]{};       ///< the way a spot travels; [0].w = number of lights
};
static_assert(sizeof(ForwardLightBlock) == 64 * kForwardLights);

}  // namespace crevice
