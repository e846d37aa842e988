// Which lights reach which part of the world: a grid of cells over the lights, for shaders that shade with few of many.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scene/Scene.h"

namespace crevice {

/// The grid lies in world space, so one serves every camera, and it is built once per scene.
struct LightGrid {
    glm::vec3 origin{0};           ///< World-space corner of the first cell.
    glm::vec3 cellsPerUnit{0};     ///< Cells per world unit.
    glm::uvec3 size{1};            ///< Cells along each axis.
    std::uint32_t everywhere = 0;  ///< Lights that every point is shaded with.
    /// cells + 1 places within this array, where the lists of cells begin and the last ends; then the lights that are
    /// everywhere; then the lists. A light is its index in CCPunctualLights.
    std::vector<std::uint32_t> words{0, 2, 2};
};

/// Distance beyond which a light without a range is left out where others are near. All such lights together then miss
/// less than half a step of the 8-bit sRGB picture near black, on a white matte surface that faces them. `exposure`:
/// factor from scene luminance to 1.0. `count`: lights without a range in the scene.
float negligibleDistance(const Light& light, float exposure, std::size_t count);

/// `bounds`: where surfaces may be.
LightGrid makeLightGrid(const Scene& scene, const Aabb& bounds, float exposure);

/// Bytes of the storage buffer CCLightGrid in cc-lights.chunk.
std::vector<std::byte> lightGridBytes(const LightGrid& grid);

}  // namespace crevice
