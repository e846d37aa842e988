// Rows are shared out to threads; a pixel depends on its own seed alone.
#include "truth/AmbientReference.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <thread>

#include "truth/CameraRay.h"
#include "truth/Sampling.h"
#include "truth/TruthCache.h"

namespace crevice {
namespace {

/// Rays start this share of the radius above the surface, so that no rounding lets them begin below it.
constexpr float kOriginOffset = 1e-4f;
/// The share counts of no more than this part of the scene: for radii beyond the scene.
constexpr float kLargestOffsetRadius = 1.0f / 400;

/// The terms that share one set of rays.
struct Bundle {
    DirectionLaw law = DirectionLaw::Cosine;
    float reach = 0;       ///< Length of the rays: that of the farthest term.
    bool onlyHard = true;  ///< One hard term alone: whether rays are blocked is enough.
    std::vector<std::size_t> terms{};
};

std::vector<Bundle> makeBundles(const AmbientSettings& settings) {
    std::vector<Bundle> bundles;
    for (const DirectionLaw law : {DirectionLaw::Cosine, DirectionLaw::Uniform, DirectionLaw::Box}) {
        Bundle bundle{.law = law};
        for (std::size_t i = 0; i < settings.terms.size(); ++i) {
            const AmbientTerm& term = settings.terms[i];
            if (term.falloff->directions != law) continue;
            const float reach = term.radius * term.falloff->reach;
            bundle.onlyHard =
                term.falloff->isHard() && (bundle.terms.empty() || (bundle.onlyHard && reach == bundle.reach));
            bundle.reach = std::max(bundle.reach, reach);
            bundle.terms.push_back(i);
        }
        if (!bundle.terms.empty()) bundles.push_back(std::move(bundle));
    }
    return bundles;
}

float smallestRadius(const AmbientSettings& settings) {
    float radius = settings.terms.front().radius;
    for (const AmbientTerm& term : settings.terms) radius = std::min(radius, term.radius);
    return radius;
}

/// What is the same for all points.
struct Run {
    const RayScene& scene;
    const AmbientSettings& settings;
    std::vector<Bundle> bundles = makeBundles(settings);
    float offset = kOriginOffset * std::min(smallestRadius(settings), kLargestOffsetRadius* scene.diagonal());
    std::uint32_t count = std::max(1u, settings.samples / 2 + settings.samples % 2);  ///< Rays of a half.
};

/// E[ρ] of every term, from one half of the rays.
void traceHalf(const Run& run, const SurfaceHit& point, std::uint32_t seed, std::vector<double>& means) {
    glm::vec3 u, v;
    makeBasis(point.normal, u, v);
    Ray ray{.origin = point.position + std::max(run.offset, point.positionError) * point.geometricNormal, .near = 0};
    for (const Bundle& bundle : run.bundles) {
        const auto number = static_cast<std::uint32_t>(bundle.law);
        const std::uint32_t own = number == 0 ? seed : hashWithSeed(number, seed);
        ray.far = bundle.reach;
        for (const std::size_t i : bundle.terms) means[i] = 0;
        for (std::uint32_t k = 0; k < run.count; ++k) {
            const glm::vec3 local = sampleDirection(bundle.law, scrambledSobol(k, own));
            ray.direction = local.x * u + local.y * v + local.z * point.normal;
            if (bundle.onlyHard) {
                if (!run.scene.isBlocked(ray)) continue;
                for (const std::size_t i : bundle.terms) means[i] += 1;
                continue;
            }
            const float distance = run.scene.findDistance(ray);
            if (!(distance <= bundle.reach)) continue;
            for (const std::size_t i : bundle.terms) {
                const AmbientTerm& term = run.settings.terms[i];
                means[i] += static_cast<double>(term.falloff->at(distance / term.radius));
            }
        }
        for (const std::size_t i : bundle.terms) means[i] /= run.count;
    }
}

/// Scratch memory of a thread.
struct Halves {
    std::vector<double> first, second;
    explicit Halves(const AmbientSettings& settings) : first(settings.terms.size()), second(settings.terms.size()) {}
    void trace(const Run& run, const SurfaceHit& point, std::uint32_t seed) {
        traceHalf(run, point, hashWithSeed(0, seed), first);
        traceHalf(run, point, hashWithSeed(1, seed), second);
    }
    Openness of(std::size_t term, const AmbientSettings& settings) const {
        const Falloff& falloff = *settings.terms[term].falloff;
        return {falloff.openness(first[term]), falloff.openness(second[term])};
    }
};

void traceRow(AmbientMap& map, std::uint32_t y, const Run& run, const Camera& camera, Halves& halves) {
    for (std::uint32_t x = 0; x < map.size.x; ++x) {
        const std::size_t pixel = std::size_t(y) * map.size.x + x;
        const auto hit = run.scene.findVisible(makeCameraRay(camera, glm::vec2(x, y) + 0.5f, map.size));
        if (!hit) continue;
        halves.trace(run, *hit, hashWithSeed(static_cast<std::uint32_t>(pixel), run.settings.seed));
        for (std::size_t i = 0; i < map.layers.size(); ++i) {
            const Openness openness = halves.of(i, run.settings);
            map.layers[i].first[pixel] = static_cast<float>(openness.first);
            map.layers[i].second[pixel] = static_cast<float>(openness.second);
        }
        map.viewDepth[pixel] = hit->distance;
        map.normal[pixel] = hit->normal;
        map.isCounted[pixel] = 1;
    }
}

AmbientMap emptyMap(const glm::uvec2& size, const AmbientSettings& settings) {
    const std::size_t pixels = std::size_t(size.x) * size.y;
    AmbientMap map{.size = size,
                   .viewDepth = std::vector<float>(pixels, kSkyViewDepth),
                   .normal = std::vector<glm::vec3>(pixels, glm::vec3(0)),
                   .isCounted = std::vector<std::uint8_t>(pixels, 0)};
    const std::vector<float> open(pixels, 1.0f);
    for (const AmbientTerm& term : settings.terms)
        map.layers.push_back({.term = term, .openness = open, .first = open, .second = open});
    return map;
}

void traceMap(AmbientMap& map, const RayScene& scene, const Camera& camera, const AmbientSettings& settings) {
    const std::uint32_t rows = map.size.y;
    const Run run{scene, settings};
    std::atomic<std::uint32_t> nextRow{0};
    const auto work = [&](bool reports) {
        Halves halves(settings);
        for (std::uint32_t y = nextRow++; y < rows; y = nextRow++) {
            if (reports && settings.progress) settings.progress(static_cast<float>(y) / static_cast<float>(rows));
            traceRow(map, y, run, camera, halves);
        }
    };
    const unsigned threads = settings.threads ? settings.threads : std::max(1u, std::thread::hardware_concurrency());
    {
        std::vector<std::jthread> helpers;
        for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(work, false);
        work(true);
    }
}

/// What follows from the halves.
void finishMap(AmbientMap& map) {
    for (std::size_t i = 0; i < map.layers.size(); ++i) {
        AmbientLayer& layer = map.layers[i];
        for (std::size_t p = 0; p < layer.openness.size(); ++p)
            layer.openness[p] = static_cast<float>(0.5 * (double(layer.first[p]) + double(layer.second[p])));
        layer.noise = map.countedNoise(i);
    }
}

using RayMaker = std::function<const RayScene&()>;

AmbientMap loadOrTrace(const Scene& scene, const RayMaker& rays, const Camera& camera, const glm::uvec2& size,
                       const AmbientSettings& settings) {
    assert(camera.near > 0 && camera.far > camera.near && !settings.terms.empty());
    const std::string key = settings.cache ? truthKey(scene, camera, size, settings) : std::string();
    AmbientMap map = emptyMap(size, settings);
    map.fromCache = settings.cache && loadTruth(*settings.cache, key, map);
    if (!map.fromCache) {
        traceMap(map, rays(), camera, settings);
        if (settings.cache) storeTruth(*settings.cache, key, map);
    }
    finishMap(map);
    return map;
}

}  // namespace

std::vector<Openness> traceOpenness(const RayScene& scene, const SurfaceHit& point, const AmbientSettings& settings,
                                    std::uint32_t seed) {
    const Run run{scene, settings};
    Halves halves(settings);
    halves.trace(run, point, seed);
    std::vector<Openness> result;
    for (std::size_t i = 0; i < settings.terms.size(); ++i) result.push_back(halves.of(i, settings));
    return result;
}

AmbientMap traceAmbient(const RayScene& scene, const Camera& camera, const glm::uvec2& size,
                        const AmbientSettings& settings) {
    return loadOrTrace(
        scene.source(), [&]() -> const RayScene& { return scene; }, camera, size, settings);
}

AmbientMap traceAmbient(const Scene& scene, const Camera& camera, const glm::uvec2& size,
                        const AmbientSettings& settings) {
    std::optional<RayScene> rays;
    return loadOrTrace(
        scene, [&]() -> const RayScene& { return rays.emplace(scene); }, camera, size, settings);
}

}  // namespace crevice
