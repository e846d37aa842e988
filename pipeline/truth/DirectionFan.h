// The directions of a slice around the view ray, each open or closed, and how much of a cosine lobe is open.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

namespace crevice {

/// The full turn in 2048 bins, even in the quotient of the smaller to the sum of both coordinates: no trigonometry.
class DirectionFan {
public:
    /// All open. `dither` in [0,1) is what is added before rounding down to a bin: the mean over many fans is exact.
    void clear(float dither);
    /// Closes the directions between two vectors (x aside, y towards the viewer), both on one side (the sign of x).
    void close(float side, const glm::vec2& a, const glm::vec2& b);

    struct Shares {
        double open = 0, whole = 0;
    };
    /// Integrals of |sin h| cos(h - gamma) over the open and over all directions of the hemisphere, |h - gamma| ≤ 90°;
    /// h is the angle from the view ray towards positive x.
    Shares measure(float gamma) const;

    static constexpr int kSide = 1024;  ///< Bins of half a turn.

private:
    static constexpr int kWords = kSide / 64;

    std::array<std::array<std::uint64_t, kWords>, 2> closed_{};  ///< Of both sides, from the view ray on.
    float dither_ = 0;
};

}  // namespace crevice
