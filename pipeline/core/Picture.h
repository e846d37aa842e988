// Eight-bit pictures from bytes: PNG, JPEG and WebP; refused by their header when they are too large.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/Image.h"
#include "core/Limits.h"

namespace crevice {

enum class PictureKind { Png, Jpeg, WebP };

/// What a picture says of itself before it is decoded; none of it can be trusted, only refused.
struct PictureHeader {
    PictureKind kind = PictureKind::Png;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// By content, not by name; nothing when it is none of the three, or cut off before its size.
std::optional<PictureHeader> readPictureHeader(std::span<const std::byte> bytes);

/// Throws Error when the size is 0, beyond limits.maxImageSide or maxImagePixels, or more than `byteCount` bytes of
/// file can hold. `name` stands in messages.
void checkPictureSize(const PictureHeader& header, std::size_t byteCount, const std::string& name,
                      const Limits& limits);

/// RGBA8, whatever the channels and depths were; 16 bits are rounded. Throws Error.
Image decodePicture(std::span<const std::byte> bytes, const std::string& name, const Limits& limits = {});

}  // namespace crevice
