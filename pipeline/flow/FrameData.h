// What a frame knows before any stage runs: camera, screen, lights, fog and exposure as the blocks of set 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "flow/FrameBlocks.h"
#include "flow/FrameContext.h"
#include "scene/Scene.h"

namespace crevice {

/// World units that `auto` lengths such as an occlusion radius take: 1/40 of the diagonal of the scene's bounding box,
/// from 2e-6 to 1e6; 1 for a scene without extent.
float automaticLength(const Aabb& scene);

/// The view with `guard` more pixels on each side: what shows at a pixel p of the frame shows at p + guard.
FrameView guardedView(const FrameView& view, std::uint32_t guard);

/// What level surfaces receive: of the scene's environment, else its ambient light. For effects that know no
/// environment.
Ambient ambientOf(const Scene& scene);

GlobalBlock globalBlock(const FrameView& view);
CameraBlock cameraBlock(const FrameView& view, const Scene& scene);

/// Bytes of the storage buffer CCPunctualLights: uvec4 count, then one PunctualLight each. All lights but the main one,
/// in the scene's order; further directional lights have type 2.
std::vector<std::byte> punctualLights(const Scene& scene);

/// The first ten point and spot lights.
ForwardLightBlock forwardLightBlock(const Scene& scene);

/// Factor from scene luminance to 1.0 for an exposure value at ISO 100: 1 / (1.2 · 2^EV)
/// (S. Lagarde, C. de Rousiers: Moving Frostbite to PBR, 2014, section 5.1).
float exposureFromEv(float ev);
/// The EV that brings a white diffuse surface under the scene's lights to 0.8: from the light sources alone, so that it
/// is the same for every camera and every run. See docs/scenes.md.
float autoExposureEv(const Scene& scene);

}  // namespace crevice
