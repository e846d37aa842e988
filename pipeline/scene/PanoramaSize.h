// How large a panorama may be, judged by its header.
#pragma once

#include <cstdint>
#include <string>

#include "core/Limits.h"

namespace crevice {

/// Throws Error when a picture is not twice as wide as high, or takes more than an eighth of `maxImageBytes` as 16
/// bytes a pixel: 8192 x 4096 pixels by default.
void checkPanoramaSize(std::uint64_t width, std::uint64_t height, const std::string& name, const Limits& limits);

}  // namespace crevice
