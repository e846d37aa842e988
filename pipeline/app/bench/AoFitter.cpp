// A grid of strengths and powers, then a finer one around the best: errors are sums over 256 levels, so this is cheap.
#include "app/bench/AoFitter.h"

#include <algorithm>
#include <cmath>

namespace crevice {
namespace {

/// Mean over views of the squared error as a share of white's.
double meanShare(const std::vector<LevelSums>& views, const LevelSums::Curve& curve) {
    double sum = 0;
    for (const LevelSums& view : views) sum += view.error(curve) / std::max(view.whiteError(), 1e-12);
    return views.empty() ? 0 : sum / static_cast<double>(views.size());
}

/// Mean over views of RMSE over white's: what tables show.
double meanOfWhite(const std::vector<LevelSums>& views, const LevelSums::Curve& curve) {
    double sum = 0;
    for (const LevelSums& view : views) sum += std::sqrt(view.error(curve) / std::max(view.whiteError(), 1e-12));
    return views.empty() ? kUnknown : sum / static_cast<double>(views.size());
}

struct Best {
    double error = 1e30, strength = 1, power = 1;
};

void search(const std::vector<LevelSums>& views, double strength, double power, double step, int reach, Best& best) {
    for (int i = -reach; i <= reach; ++i) {
        for (int k = -reach; k <= reach; ++k) {
            const double s = strength + step * i, p = power + step * k;
            if (s < 0.1 || p < 0.1) continue;
            const double error = meanShare(views, calibrationCurve(s, p));
            if (error < best.error) best = {error, s, p};
        }
    }
}

}  // namespace

void LevelSums::add(std::span<const float> map, std::span<const float> truth, std::span<const std::uint8_t> isCounted) {
    for (std::size_t i = 0; i < map.size(); ++i) {
        if (!isCounted[i]) continue;
        Level& level = levels_[static_cast<std::size_t>(std::clamp(map[i], 0.0f, 1.0f) * 255.0f + 0.5f)];
        level.count += 1;
        level.truth += truth[i];
        level.square += double(truth[i]) * truth[i];
    }
}

double LevelSums::error(const Curve& curve) const {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
        const Level& level = levels_[i];
        sum += level.count * curve[i] * curve[i] - 2 * curve[i] * level.truth + level.square;
        count += level.count;
    }
    return count > 0 ? std::max(0.0, sum / count) : 0;
}

double LevelSums::whiteError() const {
    Curve white;
    white.fill(1);
    return error(white);
}

LevelSums::Curve calibrationCurve(double strength, double power) {
    LevelSums::Curve curve;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        curve[i] = std::pow(std::max(0.0, 1 - strength * (1 - static_cast<double>(i) / 255)), power);
    }
    return curve;
}

void AoFitter::add(double factor, bool forCalibration, LevelSums sums) {
    Views& views = factors_[factor];
    (forCalibration ? views.calibration : views.evaluation).push_back(sums);
}

void AoFitter::fit(AoFit& fit) const {
    constexpr double kCoarse = 0.2, kFine = 0.02;
    Best best;
    for (const auto& [factor, views] : factors_) {
        if (views.calibration.empty()) continue;
        Best here;
        search(views.calibration, 2.5, 2.5, kCoarse, 12, here);
        search(views.calibration, here.strength, here.power, kFine, 10, here);
        if (here.error >= best.error) continue;
        best = here;
        fit.radius = factor;
    }
    fit.strength = best.strength;
    fit.power = best.power;
    const auto shipped = factors_.find(1.0), chosen = factors_.find(fit.radius);
    if (shipped == factors_.end() || chosen == factors_.end()) return;
    const LevelSums::Curve curve = calibrationCurve(fit.strength, fit.power);
    fit.before = meanOfWhite(shipped->second.evaluation, calibrationCurve(1, 1));
    fit.after = meanOfWhite(chosen->second.evaluation, curve);
    fit.fitted = meanOfWhite(chosen->second.calibration, curve);
}

}  // namespace crevice
