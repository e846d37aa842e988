// Small pictures for the report.
#pragma once

#include <span>
#include <string>

#include "core/Image.h"

namespace crevice {

/// 8-bit grey picture of values in [0, 1], times `gain`, shrunk by averaging until it is at most `width` wide.
Image greyPicture(std::span<const float> values, const glm::uvec2& size, std::uint32_t width, float gain = 1);

/// An RGBA8 picture shrunk the same way.
Image shrunk(const Image& image, std::uint32_t width);

/// "data:image/png;base64,…"
std::string pngDataUri(const Image& image);

}  // namespace crevice
