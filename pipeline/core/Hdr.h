// Reading of Radiance .hdr bytes (RGBE).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "core/Image.h"
#include "core/Limits.h"

namespace crevice {

bool looksLikeHdr(std::span<const std::byte> bytes);

/// What the text at the beginning of a .hdr file says.
struct HdrHeader {
    std::uint32_t width = 0, height = 0;
    float exposure = 1;        ///< Product of all EXPOSURE lines: what the stored values were multiplied by.
    std::size_t pixelsAt = 0;  ///< Offset of the first scan line.
};

/// Throws Error: not RGBE, a turned picture, a size beyond the limits. `name` stands in messages.
HdrHeader readHdrHeader(std::span<const std::byte> bytes, const std::string& name, const Limits& limits = {});

/// Radiance as RGBA32F, alpha 1, EXPOSURE divided out. Throws Error, also for a file that ends early.
Image decodeHdr(std::span<const std::byte> bytes, const std::string& name, const Limits& limits = {});

}  // namespace crevice
