// Ambient occlusion by ray tracing at the very points that a picture shows: what screen-space techniques are measured
// against. docs/reference.md has the definition. One run yields several radii and falloffs from the same rays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "core/Image.h"
#include "scene/Camera.h"
#include "truth/Falloff.h"
#include "truth/RayScene.h"

namespace crevice {

/// One map of a run.
struct AmbientTerm {
    float radius = 1;  ///< World units, above 0; may be larger than the scene.
    const Falloff* falloff = &hardFalloff();
};

struct AmbientSettings {
    std::vector<AmbientTerm> terms = {AmbientTerm{}};  ///< At least one.
    std::uint32_t samples = 1024;  ///< Rays per pixel and DirectionLaw, rounded up to an even number.
    std::uint32_t seed = 1;
    unsigned threads = 0;                   ///< 0 = as many as the machine has. The result does not depend on it.
    std::function<void(float)> progress{};  ///< Share done, called from the calling thread.
    /// Where results are kept by content; nothing = they are not. `cacheFolder("truth")` for the usual place.
    std::optional<std::filesystem::path> cache{};
};

/// Two independent estimates, each from half the rays; their difference tells the noise.
struct Openness {
    double first = 1, second = 1;
    double mean() const { return 0.5 * (first + second); }
};

/// At one point, one for each term. `seed` chooses the set of directions.
std::vector<Openness> traceOpenness(const RayScene& scene, const SurfaceHit& point, const AmbientSettings& settings,
                                    std::uint32_t seed);

inline constexpr float kSkyViewDepth = 1e9f;  ///< As the target `viewDepth` is cleared.

/// The map of one term, row by row from the top: 1 = open; sky = 1.
struct AmbientLayer {
    AmbientTerm term{};
    std::vector<float> openness{};         ///< Mean of the halves.
    std::vector<float> first{}, second{};  ///< From half the rays each.
    double noise = 0;                      ///< Standard error of a pixel, root mean square over all surface pixels.
};

struct AmbientMap {
    glm::uvec2 size{0};
    std::vector<AmbientLayer> layers{};     ///< As settings.terms.
    std::vector<float> viewDepth{};         ///< Linear, along the camera's axis; sky = kSkyViewDepth.
    std::vector<glm::vec3> normal{};        ///< World space, unit length, as the cosine was taken about; sky = 0.
    std::vector<std::uint8_t> isCounted{};  ///< 0: sky or excluded, takes no part in any metric.
    bool fromCache = false;                 ///< No ray was traced.

    std::size_t countedCount() const;
    Image toImage(std::size_t layer = 0) const;  ///< R32F
    /// As AmbientLayer::noise, over the pixels that count now.
    double countedNoise(std::size_t layer = 0) const;
};

/// One camera ray through every pixel's centre, one hemisphere of rays at every hit. The camera's near and far must be
/// set.
AmbientMap traceAmbient(const RayScene& scene, const Camera& camera, const glm::uvec2& size,
                        const AmbientSettings& settings);

/// The same, but the acceleration structure is built only when the cache does not know the answer.
AmbientMap traceAmbient(const Scene& scene, const Camera& camera, const glm::uvec2& size,
                        const AmbientSettings& settings);

/// Takes pixels out of isCounted where a rasterised `viewDepth` of the same size shows another surface: further off
/// than 1/1000 of the depth. Returns how many.
std::size_t excludeOtherSurfaces(AmbientMap& map, const Image& viewDepth);

}  // namespace crevice
