// The smaller levels of a picture, made on the processor: the same texels on every device.
#pragma once

#include <vector>

#include "core/Image.h"

namespace crevice {

/// Levels 1 … down to 1x1 of an RGBA8 or RGBA8_SRGB image (asserted): the mean of 2x2 texels of the level before,
/// rounded half up; of sRGB colours in linear light (alpha is linear). Sizes are halved and rounded down, as Vulkan's
/// are: the last row or column of an odd level has no part in the next.
std::vector<Image> makeMips(const Image& image);

}  // namespace crevice
