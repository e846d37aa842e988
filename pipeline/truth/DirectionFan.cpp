// Antiderivative of the weight, for h ≥ 0: (cos g - cos(2h - g) + 2h sin g) / 4 (Jimenez et al. 2016), odd in (h, g).
#include "truth/DirectionFan.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace crevice {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr int kFanSide = DirectionFan::kSide;

/// Of a direction h: what the antiderivative needs, so that a fan costs no trigonometry per border.
struct Border {
    double angle = 0, cos2 = 1, sin2 = 0;
    explicit Border(double h = 0) : angle(h), cos2(std::cos(2 * h)), sin2(std::sin(2 * h)) {}
};

/// Where bins begin.
struct Borders {
    std::array<Border, kFanSide + 1> values;
    Borders() {
        for (int bin = 0; bin <= kFanSide; ++bin) {
            const double diamond = 2.0 * bin / kFanSide;
            values[static_cast<std::size_t>(bin)] =
                Border(std::atan2(diamond <= 1 ? diamond : 2 - diamond, 1 - diamond));
        }
    }
};

/// The lobe about an angle, on one side.
struct Lobe {
    double gamma, cosine, sine;
    Border low, high;
    explicit Lobe(double g)
        : gamma(g),
          cosine(std::cos(g)),
          sine(std::sin(g)),
          low(std::max(0.0, g - 0.5 * kPi)),
          high(std::min(kPi, g + 0.5 * kPi)) {}
    double antiderivative(const Border& h) const {
        return 0.25 * (cosine - h.cos2 * cosine - h.sin2 * sine + 2 * h.angle * sine);
    }
    double between(const Border& from, const Border& to) const {
        const Border& a = from.angle < low.angle ? low : from;
        const Border& b = to.angle > high.angle ? high : to;
        return a.angle < b.angle ? antiderivative(b) - antiderivative(a) : 0;
    }
};

}  // namespace

void DirectionFan::clear(float dither) {
    closed_ = {};
    dither_ = dither;
}

void DirectionFan::close(float side, float low, float high) {
    constexpr float kScale = 0.5f * kSide;
    const int first = std::clamp(static_cast<int>(low * kScale + dither_), 0, kSide);
    const int end = std::clamp(static_cast<int>(high * kScale + dither_), 0, kSide);
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

/// First bin from `bin` on that is closed or open, as asked; kSide when there is none.
int DirectionFan::findNext(const Side& side, int bin, bool closed) {
    while (bin < kSide) {
        const std::uint64_t word = side[static_cast<std::size_t>(bin / 64)];
        const std::uint64_t rest = (closed ? word : ~word) >> (bin % 64);
        if (rest != 0) return bin + std::countr_zero(rest);
        bin += 64 - bin % 64;
    }
    return kSide;
}

DirectionFan::Shares DirectionFan::measure(float gamma) const {
    static const Borders kBorders;
    Shares shares;
    for (std::size_t i = 0; i < closed_.size(); ++i) {
        const Lobe lobe(i == 0 ? double(gamma) : -double(gamma));
        if (lobe.high.angle <= lobe.low.angle) continue;
        const double whole = lobe.between(lobe.low, lobe.high);
        shares.whole += whole;
        shares.open += whole;
        for (int first = findNext(closed_[i], 0, true); first < kSide;) {
            const int end = findNext(closed_[i], first, false);
            shares.open -= lobe.between(kBorders.values[static_cast<std::size_t>(first)],
                                        kBorders.values[static_cast<std::size_t>(end)]);
            first = findNext(closed_[i], end, true);
        }
    }
    return shares;
}

}  // namespace crevice
