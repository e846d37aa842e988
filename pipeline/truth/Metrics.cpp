// Two passes in double: sums, then moments about the means.
#include "truth/Metrics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace crevice {

MapMetrics measureMap(std::span<const float> map, std::span<const float> truth,
                      std::span<const std::uint8_t> isCounted) {
    assert(map.size() == truth.size() && (isCounted.empty() || isCounted.size() == map.size()));
    std::vector<double> a, t, errors;
    for (std::size_t i = 0; i < map.size(); ++i) {
        if (!isCounted.empty() && !isCounted[i]) continue;
        a.push_back(std::isfinite(map[i]) ? static_cast<double>(map[i]) : 0.0);
        t.push_back(static_cast<double>(truth[i]));
    }
    MapMetrics result;
    result.count = a.size();
    if (a.empty()) return result;

    const auto n = static_cast<double>(a.size());
    double meanA = 0, meanT = 0;
    for (std::size_t i = 0; i < a.size(); ++i) meanA += a[i] / n, meanT += t[i] / n;
    double mse = 0, whiteMse = 0, varianceA = 0, varianceT = 0, covariance = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double e = a[i] - t[i];
        errors.push_back(std::abs(e));
        result.mae += std::abs(e) / n;
        mse += e * e / n;
        whiteMse += (1 - t[i]) * (1 - t[i]) / n;
        varianceA += (a[i] - meanA) * (a[i] - meanA) / n;
        varianceT += (t[i] - meanT) * (t[i] - meanT) / n;
        covariance += (a[i] - meanA) * (t[i] - meanT) / n;
    }
    result.rmse = std::sqrt(mse);
    result.bias = meanA - meanT;
    result.truthVariance = varianceT;
    if (varianceA > 0 && varianceT > 0) result.correlation = covariance / std::sqrt(varianceA * varianceT);
    if (varianceT > 0) result.skill = 1 - mse / varianceT;
    result.white = std::sqrt(whiteMse);
    if (whiteMse > 0) result.ofWhite = result.rmse / result.white;
    if (varianceA > 0) result.slope = covariance / varianceA;
    result.offset = meanT - result.slope * meanA;
    result.fitRmse = std::sqrt(std::max(0.0, varianceT - result.slope * covariance));
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.95 * n)) - 1;
    std::nth_element(errors.begin(), errors.begin() + rank, errors.end());
    result.p95 = errors[static_cast<std::size_t>(rank)];
    return result;
}

double noiseCorrected(double rmse, double truthNoise) {
    return std::sqrt(std::max(0.0, rmse * rmse - truthNoise * truthNoise));
}

void takeNoiseOff(MapMetrics& metrics, double truthNoise) {
    metrics.rmse = noiseCorrected(metrics.rmse, truthNoise);
    metrics.white = noiseCorrected(metrics.white, truthNoise);
    metrics.fitRmse = noiseCorrected(metrics.fitRmse, truthNoise);
    metrics.ofWhite = metrics.white > 0 ? metrics.rmse / metrics.white : 0;
    const double variance = metrics.truthVariance - truthNoise * truthNoise;
    if (variance <= 0) return;
    metrics.skill = 1 - metrics.rmse * metrics.rmse / variance;
    metrics.correlation = std::clamp(metrics.correlation * std::sqrt(metrics.truthVariance / variance), -1.0, 1.0);
    metrics.truthVariance = variance;
}

}  // namespace crevice
