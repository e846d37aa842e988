// Ambient occlusion by ray tracing at the very points that a picture shows: what screen-space techniques are measured
// against. docs/reference.md has the definition.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "core/Image.h"
#include "scene/Camera.h"
#include "truth/RayScene.h"

namespace crevice {

/// How much a surface at distance t occludes, within the radius R: 1, 1 - t/R, 1 - (t/R)²; nothing beyond.
enum class Falloff : std::uint8_t { Hard, Linear, Quadratic };

struct AmbientSettings {
    float radius = 1;  ///< World units, above 0; may be larger than the scene.
    Falloff falloff = Falloff::Hard;
    std::uint32_t samples = 1024;  ///< Rays per pixel, rounded up to an even number.
    std::uint32_t seed = 1;
    unsigned threads = 0;                   ///< 0 = as many as the machine has. The result does not depend on it.
    std::function<void(float)> progress{};  ///< Share done, called from the calling thread.
};

/// Two independent estimates, each from half the rays; their difference tells the noise.
struct Openness {
    double first = 1, second = 1;
    double mean() const { return 0.5 * (first + second); }
};

/// At one point. `seed` chooses the set of directions.
Openness traceOpenness(const RayScene& scene, const SurfaceHit& point, const AmbientSettings& settings,
                       std::uint32_t seed);

inline constexpr float kSkyViewDepth = 1e9f;  ///< As the target `viewDepth` is cleared.

/// Row by row from the top.
struct AmbientMap {
    glm::uvec2 size{0};
    std::vector<float> openness;          ///< 1 = open; sky = 1.
    std::vector<float> viewDepth;         ///< Linear, along the camera's axis; sky = kSkyViewDepth.
    std::vector<std::uint8_t> isCounted;  ///< 0: sky or excluded, takes no part in any metric.
    double noise = 0;                     ///< Standard error of a pixel, root mean square over the surface.

    std::size_t countedCount() const;
    Image toImage() const;  ///< R32F
};

/// One camera ray through every pixel's centre, one hemisphere of rays at every hit. The camera's near and far must be
/// set.
AmbientMap traceAmbient(const RayScene& scene, const Camera& camera, const glm::uvec2& size,
                        const AmbientSettings& settings);

/// Takes pixels out of isCounted where a rasterised `viewDepth` of the same size shows another surface: further off
/// than 1/1000 of the depth. Returns how many.
std::size_t excludeOtherSurfaces(AmbientMap& map, const Image& viewDepth);

}  // namespace crevice
