// SSIM with a mask: weighted moments of both maps under a Gaussian window, from blurs in rows, then in columns.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "truth/PictureMetrics.h"

namespace crevice {
namespace {

constexpr int kReach = 5;  // 11x11
constexpr double kSigma = 1.5, kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

using Plane = std::vector<double>;

std::array<double, 2 * kReach + 1> makeWindow() {
    std::array<double, 2 * kReach + 1> window{};
    for (int i = -kReach; i <= kReach; ++i)
        window[static_cast<std::size_t>(i + kReach)] = std::exp(-0.5 * i * i / (kSigma * kSigma));
    return window;
}

/// Values outside the picture are 0. Tap by tap over whole rows, so that the compiler can take several pixels at once.
Plane blurAlong(const Plane& plane, const glm::ivec2& size, const glm::ivec2& step) {
    const auto window = makeWindow();
    Plane result(plane.size(), 0.0);
    for (int y = 0; y < size.y; ++y) {
        double* to = &result[std::size_t(y) * size.x];
        for (int i = -kReach; i <= kReach; ++i) {
            const int v = y + i * step.y;
            if (v < 0 || v >= size.y) continue;
            const double weight = window[static_cast<std::size_t>(i + kReach)];
            const double* from = &plane[std::size_t(v) * size.x];
            const int shift = i * step.x, begin = std::max(0, -shift), end = std::min(size.x, size.x - shift);
            for (int x = begin; x < end; ++x) to[x] += weight * from[x + shift];
        }
    }
    return result;
}

Plane blur(const Plane& plane, const glm::ivec2& size) {
    return blurAlong(blurAlong(plane, size, {1, 0}), size, {0, 1});
}

}  // namespace

double structuralSimilarity(const glm::uvec2& size, std::span<const float> a, std::span<const float> b,
                            std::span<const std::uint8_t> isCounted) {
    assert(a.size() == b.size() && a.size() == std::size_t(size.x) * size.y);
    const std::size_t n = a.size();
    Plane weight(n), sumA(n), sumB(n), squareA(n), squareB(n), product(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (!isCounted.empty() && !isCounted[i]) continue;
        const double va = std::isfinite(a[i]) ? static_cast<double>(a[i]) : 0, vb = static_cast<double>(b[i]);
        weight[i] = 1, sumA[i] = va, sumB[i] = vb, squareA[i] = va * va, squareB[i] = vb * vb, product[i] = va * vb;
    }
    const Plane counted = weight;
    for (Plane* plane : {&weight, &sumA, &sumB, &squareA, &squareB, &product}) *plane = blur(*plane, glm::ivec2(size));
    double total = 0, count = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (counted[i] == 0) continue;
        const double w = weight[i], ma = sumA[i] / w, mb = sumB[i] / w;
        const double varianceA = squareA[i] / w - ma * ma, varianceB = squareB[i] / w - mb * mb;
        const double covariance = product[i] / w - ma * mb;
        total +=
            (2 * ma * mb + kC1) * (2 * covariance + kC2) / ((ma * ma + mb * mb + kC1) * (varianceA + varianceB + kC2));
        count += 1;
    }
    return count > 0 ? total / count : 1;
}

}  // namespace crevice
