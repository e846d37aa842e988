// The blocks of sets 0 and 2 as Cocos 3.6.1 lays them out, byte for byte (std140). Those of 3.3.1 are in FrameBlocks.h:
// Crevice's own have its layout.
#pragma once

#include <glm/glm.hpp>

namespace crevice {

/// `CCGlobal` of 3.6.1.
struct GlobalBlock36 {
    glm::vec4 time{0}, screenSize{0}, nativeSize{0};  ///< As in GlobalBlock.
    glm::vec4 debugViewMode{0};                       ///< 0 = the picture itself
    glm::vec4 debugViewPacks[3]{};                    ///< Which terms of light a debug view shows.
};
static_assert(sizeof(GlobalBlock36) == 112);

/// `CCCamera` of 3.6.1.
struct CameraBlock36 {
    glm::mat4 view{1}, viewInv{1}, proj{1}, projInv{1}, viewProj{1}, viewProjInv{1};
    glm::vec4 position{0};  ///< w = 0: Vulkan's sign convention
    glm::vec4 surfaceTransform{0, 0, 1, 0};
    glm::vec4 screenScale{1};
    glm::vec4 exposure{1, 1, 0, 1};  ///< exposure, 1/exposure, is HDR, 1/standard exposure
    glm::vec4 mainLitDir{0};         ///< the way the light travels; w = 1: casts a shadow
    glm::vec4 mainLitColor{0};       ///< rgb linear, w = illuminance x exposure
    glm::vec4 ambientSky{0};         ///< rgb, w = illuminance x exposure
    glm::vec4 ambientGround{0};      ///< rgb, w = mips of the environment
    glm::vec4 fogColor{0}, fogBase{0}, fogAdd{0};
    glm::vec4 nearFar{0};   ///< near, far, the depth of the near plane in clip space
    glm::vec4 viewPort{0};  ///< x, y, width, height in pixels
};
static_assert(sizeof(CameraBlock36) == 592);

/// `CCShadow` of 3.6.1.
struct ShadowBlock36 {
    glm::mat4 lightView{1}, lightViewProj{1};
    glm::vec4 invProjDepthInfo{0}, projDepthInfo{0}, projInfo{0};
    glm::vec4 nearFar{0};     ///< near, far, 0, 1 - saturation
    glm::vec4 sizeBias{0};    ///< width, height, pcf, bias
    glm::vec4 typeNormal{0};  ///< light type, packing, normal bias, cascades
    glm::vec4 color{0};
    glm::vec4 planar{0};  ///< normal and distance of the plane that shadows are flattened to
};
static_assert(sizeof(ShadowBlock36) == 256);

/// `CCCSM` of 3.6.1: four cascades.
struct CsmBlock36 {
    glm::mat4 viewDirections[3]{};  ///< Each holds one row of four cascades.
    glm::vec4 atlas[4]{};
    glm::mat4 viewProj[4]{};
    glm::vec4 projDepthInfo[4]{}, projInfo[4]{};
    glm::vec4 splits{0};
};
static_assert(sizeof(CsmBlock36) == 656);

/// `CCForwardLight` of the forward pipelines: one light at a time; 3.7 added the last member.
struct SingleLightBlock {
    glm::vec4 position{0}, color{0}, sizeRangeAngle{0}, direction{0}, boundingSize{0};
};
static_assert(sizeof(SingleLightBlock) == 80);

/// `CCLocal` of 3.6.1.
struct LocalBlock36 {
    glm::mat4 world{1}, worldIT{1};
    glm::vec4 lightingMapUv{0}, localShadowBias{0};
};
static_assert(sizeof(LocalBlock36) == 160);

}  // namespace crevice
