// What a run of the occlusion benchmark finds, as plain numbers and pictures.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "app/bench/AoCases.h"
#include "core/Image.h"
#include "truth/PictureMetrics.h"

namespace crevice {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// One map against the truth: a case at one view and radius. The techniques "white" (a map that is 1 everywhere) and
/// "baked" (the materials' occlusion textures) are no cases of the pipeline.
struct AoRow {
    std::string scene, kind, view, set;
    glm::uvec2 size{0};
    double share = 0;  ///< The radius as a share of the diagonal.
    double radius = 0;
    std::string technique, quality, extras;
    PictureMetrics metrics;
    double truthNoise = 0;  ///< Standard error of a pixel of the truth.
    double excluded = 0;    ///< Share of the surface's pixels that show another surface to the rays.
    double taps = 0, tapsPerPixel = 0, denoiseTaps = 0;
    /// Of all occlusion passes and of what a guard adds to the G-buffer, where it was measured.
    double cpuMs = kUnknown;
    double guardMs = kUnknown;     ///< Of it, what the guard adds to the G-buffer.
    double cpuShare = kUnknown;    ///< cpuMs over the yardstick's pass.
    double guardShare = kUnknown;  ///< guardMs over it.

    std::string label() const {
        return technique + (quality.empty() ? "" : " " + quality) + (extras.empty() ? "" : " " + extras);
    }
};

/// Calibration of a technique: openness' = max(0, 1 - strength (1 - openness))^power, rendered with the radius times
/// `radius`. Fitted on the calibration views; RMSE over that of white, mean of the evaluation views.
struct AoFit {
    std::string technique, quality;
    double radius = 1, strength = 1, power = 1;
    double fitted = 0;             ///< Of white, calibration views, after the fit.
    double before = 0, after = 0;  ///< Of white, evaluation views.
    double matched = kUnknown;     ///< RMSE against the technique's own definition over that of white, uncalibrated.
    std::string matchedName;
};

/// Error of a case at a view, split: (map - heightfield) is the estimator's, (heightfield - truth) is not on the
/// screen.
struct AoSplit {
    std::string scene, kind, view, set, technique, quality, extras;
    double share = 0;
    double total = 0, estimator = 0, missing = 0;  ///< RMSE of each.
    double white = 0;                              ///< Of a white map.
    MapMetrics map, floor;                         ///< Of the map and of the heightfield, against the truth.
};

struct AoCurvePoint {
    double x = 0;  ///< Texels read per pixel.
    double cpuShare = 0, ofWhite = 0;
    std::string label;
};
struct AoCurveResult {
    std::string name;
    std::vector<AoCurvePoint> points;
};

/// For one case and scene, small, 8 bits.
struct AoPicture {
    std::string scene, view, label;
    Image map, error;  ///< R8: openness; |openness - truth|, 1/4 = white.
};

/// The lit picture with and without occlusion, and the truth.
struct AoLit {
    std::string scene, view, label;
    Image with, without;
};

struct AoResults {
    std::string command, device;
    std::vector<glm::uvec2> sizes;
    glm::uvec2 studySize{0};  ///< Of calibration, split and matched truths.
    std::uint32_t samples = 0;
    std::uint32_t repeats = 0;
    std::vector<AoCase> cases;
    std::vector<AoRow> rows;
    std::vector<AoFit> fits;
    std::vector<AoSplit> splits;
    std::vector<AoCurveResult> curves;
    std::vector<AoPicture> pictures;
    std::vector<AoLit> lit;
};

}  // namespace crevice
