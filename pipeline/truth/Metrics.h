// How far a map is from the truth, in numbers that others report too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace crevice {

/// With e = a - t over the n counted values, means written as ⟨ ⟩:
struct MapMetrics {
    std::size_t count = 0;
    double rmse = 0;         ///< √⟨e²⟩
    double mae = 0;          ///< ⟨|e|⟩
    double bias = 0;         ///< ⟨e⟩; above 0: too bright
    double p95 = 0;          ///< The smallest |e| that 95 % of the values do not exceed.
    double correlation = 0;  ///< Pearson: ⟨(a - ⟨a⟩)(t - ⟨t⟩)⟩ / (σa σt); 0 when either is constant
    double skill = 0;    ///< 1 - ⟨e²⟩ / σt²: 0 = as good as the truth's mean everywhere; 0 when t is constant
    double ofWhite = 0;  ///< RMSE over that of an all-white map, √⟨(1 - t)²⟩; 0 when the truth is all white
    double white = 0;    ///< RMSE of an all-white map
    double slope = 0;    ///< Of the best fit a·slope + offset ≈ t (least squares); 0 when a is constant
    double offset = 0;
    double truthVariance = 0;  ///< σt²
    double fitRmse = 0;        ///< What the best fit leaves: √(⟨e²⟩ of the fit), σt √(1 - r²)
};

/// `isCounted` selects values (not 0); empty = all. All spans have one length; what is not finite in `map` counts as 0.
MapMetrics measureMap(std::span<const float> map, std::span<const float> truth,
                      std::span<const std::uint8_t> isCounted = {});

/// RMSE² without the truth's own noise (its standard error): √max(0, rmse² - noise²).
double noiseCorrected(double rmse, double truthNoise);

/// Takes the truth's own noise (its standard error) out of all that it makes worse: the mean squares of rmse, white,
/// fitRmse and of the truth's variance in skill, and the correlation, which noise weakens by the square root of the
/// truth's reliability, ρ = 1 - noise²/σt²: r / √ρ (C. Spearman, "The proof and measurement of association between two
/// things", 1904). What is nothing but noise (ρ ≤ 0) keeps its correlation and skill. mae, p95, slope and offset stay
/// as they are; the bias needs nothing.
void takeNoiseOff(MapMetrics& metrics, double truthNoise);

}  // namespace crevice
