// What a mirror sees of an environment, from polished to dull: a cube map whose levels are blurred by GGX. And the
// table that turns it into what a surface reflects.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "core/Image.h"
#include "scene/Environment.h"

namespace crevice {

inline constexpr std::uint32_t kBrdfTableSize = 64;
/// Split sum, second factor: what GGX with Schlick's Fresnel reflects of a uniform environment is F0 · r + g. RG16F;
/// columns are cos(angle to the viewer), rows the roughness, both 0 at the first and 1 at the last texel's centre.
/// The same model as brdf.chunk: height-correlated Smith, roughness at least 0.045.
Image makeBrdfTable(unsigned threads = 0);

/// Level 0 is the environment; level i of n + 1 what a surface of environmentRoughness(i / n) mirrors when it is looked
/// at head-on: split sum, first factor (B. Karis, "Real Shading in Unreal Engine 4", SIGGRAPH 2013). Halves: brighter
/// than 65504 is clamped to that.
struct EnvironmentCube {
    std::uint32_t size = 0;                  ///< Texels of a side at level 0: a power of two.
    std::vector<std::vector<Image>> levels;  ///< [level][face], RGBA16F; faces as in CubeFaces.h.
    Image brdf;                              ///< makeBrdfTable()
};

inline constexpr std::uint32_t kMinCubeSize = 128, kMaxCubeSize = 512, kLastCubeSize = 8;

/// Roughness at a share of the levels, 0 to 1, and back: levels are spent on smooth surfaces, whose lobes change most
/// (R. Guy, M. Agopian, "Physically Based Rendering in Filament", 5.3.4.6: level = r (2 - r)).
float environmentRoughness(float level);
float environmentLevel(float roughness);

/// Texels of a cube's side for a panorama of that width: a quarter of it, from kMinCubeSize to kMaxCubeSize.
std::uint32_t cubeSizeFor(std::uint32_t panoramaWidth);

/// Blurs an environment. The same bits for any number of threads; 0 = one per processor.
EnvironmentCube filterEnvironment(const Image& equirect, unsigned threads = 0);

/// The same through a cache by content (nothing = none): a damaged file there counts as absent, and a folder that
/// cannot be written is no error.
std::shared_ptr<const EnvironmentCube> cachedEnvironmentCube(const Image& equirect,
                                                             const std::optional<std::filesystem::path>& cache);
/// Names the file in the cache: everything that the cube depends on.
std::string environmentKey(const Image& equirect);

}  // namespace crevice
