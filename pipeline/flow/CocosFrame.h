// Camera, lights and sky in Cocos' units and layouts. Exposure is applied here, before the shaders: they see light at
// the scale of the picture.
#pragma once

#include <vector>

#include "flow/CocosBlocks.h"
#include "flow/FrameBlocks.h"
#include "flow/FrameContext.h"
#include "plan/PipelineDesc.h"
#include "scene/Scene.h"

namespace crevice {

/// The document's macro CC_USE_HDR; without one, off for 3.3 (its lighting tone-maps) and on for 3.6.
bool cocosHdr(const PipelineDesc& desc);

GlobalBlock36 cocosGlobal36(const FrameView& view);
/// CCCamera of 3.3.1.
CameraBlock cocosCamera33(const FrameView& view, const Scene& scene, bool hdr);
/// CCCamera of 3.6.1.
CameraBlock36 cocosCamera36(const FrameView& view, const Scene& scene, bool hdr);

/// Radius in world units at which a light that has none is taken: Cocos' lights are spheres.
inline constexpr float kCocosLightSize = 0.15f;

/// Indices of the point and spot lights that CCForwardLight holds, at most ten, brightest at the camera first: by
/// intensity over squared distance, ties by index. Lights whose range does not reach into the view are left out.
/// `left` counts those that the view sees and that found no room.
std::vector<std::size_t> relevantLights(const FrameView& view, const Scene& scene, int& left);

/// CCForwardLight with these lights. color.w = luminance x exposure x 10000 (candela / m² of a light's sphere: Cocos'
/// light meter counts in ten thousands), so that at a distance d a light of I candela gives I x exposure / d².
ForwardLightBlock cocosLights(const FrameView& view, const Scene& scene, const std::vector<std::size_t>& lights);

}  // namespace crevice
