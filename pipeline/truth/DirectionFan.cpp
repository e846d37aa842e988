// Antiderivative of the weight, for h ≥ 0: (cos g - cos(2h - g) + 2h sin g) / 4 (Jimenez et al. 2016), odd in (h, g).
#include "truth/DirectionFan.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace crevice {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr int kFanSide = DirectionFan::kSide;

/// 0 towards the viewer, 1 across, 2 away.
float diamondOf(const glm::vec2& v) {
    const float x = std::abs(v.x), sum = x + std::abs(v.y);
    if (!(sum > 0)) return 0;
    return v.y >= 0 ? x / sum : 2 - x / sum;
}

double antiderivative(double h, double gamma) {
    return 0.25 * (std::cos(gamma) - std::cos(2 * h - gamma) + 2 * h * std::sin(gamma));
}

/// Angle at which a bin begins.
double borderAngle(int bin) {
    const double diamond = 2.0 * bin / kFanSide;
    return diamond <= 1 ? std::atan2(diamond, 1 - diamond) : std::atan2(2 - diamond, 1 - diamond);
}

}  // namespace

void DirectionFan::clear(float dither) {
    closed_ = {};
    dither_ = dither;
}

void DirectionFan::close(float side, const glm::vec2& a, const glm::vec2& b) {
    constexpr float kScale = 0.5f * kSide;
    const float from = diamondOf(a) * kScale, to = diamondOf(b) * kScale;
    const int first = std::clamp(static_cast<int>(std::min(from, to) + dither_), 0, kSide);
    const int end = std::clamp(static_cast<int>(std::max(from, to) + dither_), 0, kSide);
    if (first >= end) return;
    auto& words = closed_[side > 0 ? 0 : 1];
    const int firstWord = first / 64, lastWord = (end - 1) / 64;
    const std::uint64_t head = ~std::uint64_t(0) << (first % 64);
    const std::uint64_t tail = ~std::uint64_t(0) >> (63 - (end - 1) % 64);
    if (firstWord == lastWord) {
        words[static_cast<std::size_t>(firstWord)] |= head & tail;
        return;
    }
    words[static_cast<std::size_t>(firstWord)] |= head;
    for (int word = firstWord + 1; word < lastWord; ++word) words[static_cast<std::size_t>(word)] = ~std::uint64_t(0);
    words[static_cast<std::size_t>(lastWord)] |= tail;
}

DirectionFan::Shares DirectionFan::measure(float gamma) const {
    Shares shares;
    for (int side = 0; side < 2; ++side) {
        const double g = side == 0 ? double(gamma) : -double(gamma);
        const double low = std::max(0.0, g - 0.5 * kPi), high = std::min(kPi, g + 0.5 * kPi);
        if (high <= low) continue;
        const auto& words = closed_[static_cast<std::size_t>(side)];
        const double whole = antiderivative(high, g) - antiderivative(low, g);
        shares.whole += whole;
        shares.open += whole;
        const auto isClosed = [&](int bin) {
            return bin < kSide && (words[static_cast<std::size_t>(bin / 64)] >> (bin % 64) & 1) != 0;
        };
        for (int bin = 0; bin < kSide; ++bin) {
            if (bin % 64 == 0 && words[static_cast<std::size_t>(bin / 64)] == 0) {
                bin += 63;
                continue;
            }
            if (!isClosed(bin)) continue;
            const int first = bin;
            while (isClosed(bin + 1)) ++bin;
            const double from = std::clamp(borderAngle(first), low, high);
            const double to = std::clamp(borderAngle(bin + 1), low, high);
            shares.open -= antiderivative(to, g) - antiderivative(from, g);
        }
    }
    return shares;
}

}  // namespace crevice
