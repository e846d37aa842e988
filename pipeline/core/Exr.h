// Reading of EXR bytes, for readImage().
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/Image.h"
#include "core/Limits.h"

namespace crevice {

bool looksLikeExr(std::span<const std::byte> bytes);

struct ExrSize {
    std::uint32_t width = 0, height = 0;
};
/// Of the data window, from the header alone. Throws Error, also when it is beyond the limits.
ExrSize exrSize(std::span<const std::byte> bytes, const std::string& name, const Limits& limits = {});

/// Scan lines or tiles, channels R, G, B, A or a single one as grey, to RGBA32F. `name` stands in messages. Throws
/// Error.
Image decodeExr(std::span<const std::byte> bytes, const std::string& name, const Limits& limits = {});

/// The last of R, G and B that is there, counted from 1; 3 for a single channel that is shown as grey.
int exrColourChannels(std::span<const std::byte> bytes, const std::string& name, const Limits& limits = {});

}  // namespace crevice
