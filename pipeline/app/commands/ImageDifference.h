// How far two pictures are apart, in numbers and as a picture.
#pragma once

#include <array>

#include "core/Image.h"

namespace crevice {

/// Values are those of the files: 1 = white in 8-bit pictures. Alpha counts only where a picture has any below 1.
struct ImageDifference {
    double rmse = 0;  ///< Root of the mean square over all counted channels.
    int colours = 3;  ///< Counted channels but for alpha.
    double max = 0;   ///< Largest difference of a channel.
    std::array<double, 4> meanAbs{};
    bool alphaCounts = false;
    double psnr() const;  ///< Decibels against a peak of 1; infinite when equal.
};

/// The sizes must be equal; of the colour channels the first `colours` count. A not-a-number differs from everything
/// but another one: infinitely.
ImageDifference compareImages(const Image& a, const Image& b, int colours = 3);

/// Largest channel difference of each pixel, from black (none) over red and yellow to white (`max`).
Image makeHeatImage(const Image& a, const Image& b, double max);

}  // namespace crevice
