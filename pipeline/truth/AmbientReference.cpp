// Rows are shared out to threads; a pixel depends on its own seed alone.
#include "truth/AmbientReference.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstring>
#include <thread>

#include "truth/CameraRay.h"
#include "truth/Sampling.h"

namespace crevice {
namespace {

/// Rays start this share of the radius above the surface, so that no rounding lets them begin below it.
constexpr float kOriginOffset = 1e-4f;
/// The share counts of no more than this part of the scene: for radii beyond the scene.
constexpr float kLargestOffsetRadius = 1.0f / 400;
constexpr float kDepthTolerance = 1e-3f;

float weightAt(float distance, const AmbientSettings& settings) {
    const float x = distance / settings.radius;
    if (!(x < 1)) return 0;
    return settings.falloff == Falloff::Linear ? 1 - x : settings.falloff == Falloff::Quadratic ? 1 - x * x : 1;
}

double traceHalf(const RayScene& scene, const SurfaceHit& point, const AmbientSettings& settings, std::uint32_t seed) {
    const std::uint32_t count = std::max(1u, (settings.samples + 1) / 2);
    glm::vec3 u, v;
    makeBasis(point.normal, u, v);
    const float offset = std::max(kOriginOffset * std::min(settings.radius, kLargestOffsetRadius * scene.diagonal()),
                                  point.positionError);
    Ray ray{.origin = point.position + offset * point.geometricNormal, .near = 0, .far = settings.radius};
    double occlusion = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 local = cosineDirection(scrambledSobol(i, seed));
        ray.direction = local.x * u + local.y * v + local.z * point.normal;
        if (settings.falloff == Falloff::Hard) {
            occlusion += scene.isBlocked(ray) ? 1 : 0;
        } else {
            occlusion += static_cast<double>(weightAt(scene.findDistance(ray), settings));
        }
    }
    return 1 - occlusion / count;
}

/// The squared differences of the halves, for the noise, and how many.
struct RowNoise {
    double sum = 0;
    std::size_t count = 0;
};

RowNoise traceRow(AmbientMap& map, std::uint32_t y, const RayScene& scene, const Camera& camera,
                  const AmbientSettings& settings) {
    RowNoise noise;
    for (std::uint32_t x = 0; x < map.size.x; ++x) {
        const std::size_t pixel = std::size_t(y) * map.size.x + x;
        const auto hit = scene.findVisible(makeCameraRay(camera, glm::vec2(x, y) + 0.5f, map.size));
        if (!hit) continue;
        const std::uint32_t seed = hashWithSeed(static_cast<std::uint32_t>(pixel), settings.seed);
        const Openness openness = traceOpenness(scene, *hit, settings, seed);
        map.openness[pixel] = static_cast<float>(openness.mean());
        map.viewDepth[pixel] = hit->distance;
        map.isCounted[pixel] = 1;
        noise.sum += (openness.first - openness.second) * (openness.first - openness.second);
        ++noise.count;
    }
    return noise;
}

}  // namespace

Openness traceOpenness(const RayScene& scene, const SurfaceHit& point, const AmbientSettings& settings,
                       std::uint32_t seed) {
    return {traceHalf(scene, point, settings, hashWithSeed(0, seed)),
            traceHalf(scene, point, settings, hashWithSeed(1, seed))};
}

AmbientMap traceAmbient(const RayScene& scene, const Camera& camera, const glm::uvec2& size,
                        const AmbientSettings& settings) {
    assert(camera.near > 0 && camera.far > camera.near && settings.radius > 0);
    const std::size_t pixels = std::size_t(size.x) * size.y;
    AmbientMap map{.size = size,
                   .openness = std::vector<float>(pixels, 1.0f),
                   .viewDepth = std::vector<float>(pixels, kSkyViewDepth),
                   .isCounted = std::vector<std::uint8_t>(pixels, 0)};
    std::vector<RowNoise> noise(size.y);
    std::atomic<std::uint32_t> nextRow{0};
    const auto work = [&](bool reports) {
        for (std::uint32_t y = nextRow++; y < size.y; y = nextRow++) {
            if (reports && settings.progress) settings.progress(static_cast<float>(y) / static_cast<float>(size.y));
            noise[y] = traceRow(map, y, scene, camera, settings);
        }
    };
    const unsigned threads = settings.threads ? settings.threads : std::max(1u, std::thread::hardware_concurrency());
    {
        std::vector<std::jthread> helpers;
        for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(work, false);
        work(true);
    }
    RowNoise total;
    for (const RowNoise& row : noise) {
        total.sum += row.sum;
        total.count += row.count;
    }
    // The mean of two halves has a quarter of the variance of their difference.
    if (total.count > 0) map.noise = std::sqrt(total.sum / (4.0 * static_cast<double>(total.count)));
    return map;
}

std::size_t AmbientMap::countedCount() const {
    return static_cast<std::size_t>(std::count(isCounted.begin(), isCounted.end(), std::uint8_t{1}));
}

Image AmbientMap::toImage() const {
    Image image(size.x, size.y, Format::R32F);
    std::memcpy(image.pixels.data(), openness.data(), openness.size() * sizeof(float));
    return image;
}

std::size_t excludeOtherSurfaces(AmbientMap& map, const Image& viewDepth) {
    assert(viewDepth.width == map.size.x && viewDepth.height == map.size.y);
    std::size_t excluded = 0;
    for (std::uint32_t y = 0; y < map.size.y; ++y) {
        for (std::uint32_t x = 0; x < map.size.x; ++x) {
            const std::size_t pixel = std::size_t(y) * map.size.x + x;
            const float traced = map.viewDepth[pixel];
            if (std::abs(viewDepth.at(x, y).x - traced) <= kDepthTolerance * traced) continue;
            map.isCounted[pixel] = 0;
            ++excluded;
        }
    }
    return excluded;
}

}  // namespace crevice
