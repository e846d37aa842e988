// The ray-traced truth of a scene's views, and rows that measure maps against it.
#pragma once

#include <span>
#include <vector>

#include "app/bench/AoResults.h"
#include "app/bench/AoViews.h"
#include "truth/AmbientReference.h"

namespace crevice {

/// Rays and where results are kept.
struct AoTruthSettings {
    std::uint32_t samples = 128;
    bool useCache = true;
    std::function<void(float)> progress{};
};

/// A map to measure and what it is measured against.
struct AoMeasurement {
    AoRow row;  ///< Filled in but for the numbers.
    const AmbientMap* truth = nullptr;
    std::size_t layer = 0;
    const Camera* camera = nullptr;
    std::vector<float> map;
    const PictureRegions* regions = nullptr;  ///< Of this truth and radius.
};

AmbientMap traceAoTruth(const Scene& scene, const Camera& camera, const glm::uvec2& size,
                        std::vector<AmbientTerm> terms, const AoTruthSettings& settings);

/// Measures on all processors; rows in the order of the measurements. RMSE, that of white, skill and
/// correlation are without the truth's own noise.
std::vector<AoRow> measureRows(std::span<const AoMeasurement> measurements);

/// What the measurement reads besides regions.
PictureInput pictureInput(const AoMeasurement& measurement);

/// Runs `task(i)` for every i below `count` on all processors. The first exception is thrown again.
void runParallel(std::size_t count, const std::function<void(std::size_t)>& task);

}  // namespace crevice
