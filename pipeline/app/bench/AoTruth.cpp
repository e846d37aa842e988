// Rays come from pipeline/truth; here is what a benchmark adds: many maps at once, and rows.
#include "app/bench/AoTruth.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "core/Files.h"

namespace crevice {
AmbientMap traceAoTruth(const Scene& scene, const Camera& camera, const glm::uvec2& size,
                        std::vector<AmbientTerm> terms, const AoTruthSettings& settings) {
    AmbientSettings ambient;
    ambient.terms = std::move(terms);
    ambient.samples = settings.samples;
    ambient.progress = settings.progress;
    if (settings.useCache) ambient.cache = cacheFolder("truth");
    return traceAmbient(scene, camera, size, ambient);
}

std::vector<AoRow> measureRows(std::span<const AoMeasurement> measurements) {
    std::vector<AoRow> rows(measurements.size());
    runParallel(measurements.size(), [&](std::size_t i) {
        const AoMeasurement& m = measurements[i];
        rows[i] = m.row;
        rows[i].metrics = measurePicture(pictureInput(m), *m.regions);
        rows[i].truthNoise = m.truth->countedNoise(m.layer);
        takeNoiseOff(rows[i].metrics.all, rows[i].truthNoise);
    });
    return rows;
}

PictureInput pictureInput(const AoMeasurement& m) {
    return {.size = m.truth->size,
            .map = m.map,
            .truth = m.truth->layers[m.layer].openness,
            .isCounted = m.truth->isCounted,
            .viewDepth = m.truth->viewDepth,
            .camera = *m.camera,
            .radius = static_cast<float>(m.row.radius)};
}

void runParallel(std::size_t count, const std::function<void(std::size_t)>& task) {
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failureLock;
    const auto work = [&] {
        for (std::size_t i = next++; i < count; i = next++) {
            try {
                task(i);
            } catch (...) {
                const std::scoped_lock lock(failureLock);
                if (!failure) failure = std::current_exception();
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        const std::size_t helpers = std::max(1u, std::thread::hardware_concurrency()) - 1;
        for (std::size_t i = 0; i < std::min(helpers, count); ++i) threads.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace crevice
