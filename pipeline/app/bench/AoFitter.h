// Calibration: which radius, strength and power bring a technique's maps nearest to the truth.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "app/bench/AoResults.h"

namespace crevice {

/// Sums over pixels by the 8-bit level of the map: all it takes to know the squared error of any curve put on the map.
class LevelSums {
public:
    using Curve = std::array<double, 256>;

    void add(std::span<const float> map, std::span<const float> truth, std::span<const std::uint8_t> isCounted);
    /// Mean square of curve(map) - truth.
    double error(const Curve& curve) const;
    /// Of an all-white map.
    double whiteError() const;

private:
    struct Level {
        double count = 0, truth = 0, square = 0;
    };
    std::array<Level, 256> levels_{};
};

/// max(0, 1 - strength (1 - a))^power at every level.
LevelSums::Curve calibrationCurve(double strength, double power);

/// Collects maps of one technique and fits. Every view weighs the same: errors count as shares of a white map's.
class AoFitter {
public:
    /// `factor` of the radius that the map was rendered with.
    void add(double factor, bool forCalibration, LevelSums sums);
    /// Fills in radius, strength, power, fitted, before and after. Without calibration views nothing changes.
    void fit(AoFit& fit) const;

private:
    struct Views {
        std::vector<LevelSums> calibration, evaluation;
    };
    std::map<double, Views> factors_;
};

}  // namespace crevice
