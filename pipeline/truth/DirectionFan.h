// The directions of a slice around the view ray, each open or closed, and how much of a cosine lobe is open.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

namespace crevice {

/// The full turn in 2048 bins, even in the quotient of the smaller to the sum of both coordinates: no trigonometry.
class DirectionFan {
public:
    /// All open. `dither` in [0,1) is what is added before rounding down to a bin: the mean over many fans is exact.
    void clear(float dither);
    /// A direction (x aside, either side, y towards the viewer) as the fan counts: 0 towards the viewer, 1 across, 2
    /// away.
    static float place(const glm::vec2& direction) {
        const float x = std::abs(direction.x), sum = x + std::abs(direction.y);
        if (!(sum > 0)) return 0;
        return direction.y >= 0 ? x / sum : 2 - x / sum;
    }
    /// Closes the directions between two places, low ≤ high, on the side of positive or negative x.
    void close(float side, float low, float high);

    struct Shares {
        double open = 0, whole = 0;
    };
    /// Integrals of |sin h| cos(h - gamma) over the open and over all directions of the hemisphere, |h - gamma| ≤ 90°;
    /// h is the angle from the view ray towards positive x.
    Shares measure(float gamma) const;

    static constexpr int kSide = 1024;  ///< Bins of half a turn.

private:
    static constexpr int kWords = kSide / 64;

    using Side = std::array<std::uint64_t, kWords>;
    static int findNext(const Side& side, int bin, bool closed);

    std::array<Side, 2> closed_{};  ///< Of both sides, from the view ray on.
    float dither_ = 0;
};

}  // namespace crevice
