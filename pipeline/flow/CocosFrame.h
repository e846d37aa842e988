// Camera, lights and sky in Cocos' units and layouts. Exposure is applied here, before the shaders: they see light at
// the scale of the picture.
#pragma once

#include <vector>

#include "flow/CocosBlocks.h"
#include "flow/FrameBlocks.h"
#include "flow/FrameContext.h"
#include "scene/Scene.h"

namespace crevice {

/// What a frame's blocks depend on besides view and scene.
struct CocosLook {
    bool hdr = false;
    bool shadows = false;                 ///< There is a map of the main light's.
    bool spotShadows = false;             ///< There is one of the first spot light's that casts shadows.
    std::uint32_t environmentLevels = 1;  ///< Mips of cc_environment.
};

/// What the scene's ambient light and environment are divided by so that shaders see numbers of about 1; the shaders'
/// factor, cc_ambientSky.w, is this times the exposure. Never 0.
float ambientScale(const Scene& scene);

GlobalBlock36 cocosGlobal36(const FrameView& view);
/// CCCamera of 3.3.1.
CameraBlock cocosCamera33(const FrameView& view, const Scene& scene, const CocosLook& look);
/// CCCamera of 3.6.1.
CameraBlock36 cocosCamera36(const FrameView& view, const Scene& scene, const CocosLook& look);

/// Radius in world units at which a light that has none is taken: Cocos' lights are spheres.
inline constexpr float kCocosLightSize = 0.15f;

/// How far a light reaches: its range; where it has none, until it has fallen below one step of an 8-bit picture on a
/// white surface.
float cocosRange(const Light& light, float exposure);
/// The box around that range, in world space.
Aabb cocosReach(const Light& light, float exposure);

/// Indices of the point and spot lights that CCForwardLight holds, at most `most`, brightest at the camera first: by
/// intensity over squared distance, ties by index. Lights whose range does not reach into the view are left out.
/// `left` counts those that the view sees and that found no room.
std::vector<std::size_t> relevantLights(const FrameView& view, const Scene& scene, int& left,
                                        std::size_t most = kForwardLights);

/// CCForwardLight with these lights. color.w = luminance x exposure x 10000 (candela / m² of a light's sphere: Cocos'
/// light meter counts in ten thousands), so that at a distance d a light of I candela gives I x exposure / d².
/// sizeRangeAngle.w = 1 where the spot's shadow map is drawn.
ForwardLightBlock cocosLights(const FrameView& view, const Scene& scene, const std::vector<std::size_t>& lights,
                              const CocosLook& look = {});
/// Of that block's lights one alone, as CCForwardLight is where a pass lights with one at a time.
SingleLightBlock singleLight(const ForwardLightBlock& lights, std::size_t index);

}  // namespace crevice
