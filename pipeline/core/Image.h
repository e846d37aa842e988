// A CPU image in one of Crevice's formats, and its way to and from PNG and EXR files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include <glm/glm.hpp>

#include "core/Format.h"

namespace crevice {

struct Limits;

/// Rows top to bottom, tightly packed.
struct Image {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    Format format = Format::RGBA8;
    std::vector<std::byte> pixels;

    Image() = default;
    Image(std::uint32_t width, std::uint32_t height, Format format);

    /// Pixel as floats, see decodePixel(). x and y must be inside.
    glm::vec4 at(std::uint32_t x, std::uint32_t y) const;
    std::byte* pixel(std::uint32_t x, std::uint32_t y);
    const std::byte* pixel(std::uint32_t x, std::uint32_t y) const;
    bool operator==(const Image&) const = default;
};

/// The part of an image that starts at `offset`; it must lie inside.
Image cropped(const Image& image, glm::uvec2 offset, glm::uvec2 extent);

/// How raw values become 8 bits in a PNG: clamped to [0,1]; signed ones as x/2+1/2; depth divided by `far`.
/// Alpha is only clamped. Rounding is half up: floor(x * 255 + 1/2); not-a-number becomes 0.
enum class PngMapping { Clamp, Signed, DepthByFar };

/// 8-bit image of the same channel count (R8, RG8 or RGBA8; three channels become RGBA8). `far` must be positive.
Image toEightBit(const Image& image, PngMapping mapping, float far = 1.0f);

/// PNG bytes of an R8, RG8 (as RGB, blue 0), RGBA8 image. Fast: level 1. Opaque RGBA is written as RGB.
std::vector<std::byte> encodePng(const Image& image);
/// EXR bytes: full float channels (R, RG, RGB(A)), zip.
std::vector<std::byte> encodeExr(const Image& image);
/// Reads PNG, JPEG, WebP (8/16 bit → RGBA8) EXR or Radiance .hdr (→ RGBA32F) by content. Throws Error.
Image readImage(const std::filesystem::path& path);
Image readImage(const std::filesystem::path& path, const Limits& limits);
/// Chooses PNG or EXR by extension and writes aside, then renames. Throws Error for another extension.
void writeImage(const std::filesystem::path& path, const Image& image, PngMapping mapping = PngMapping::Clamp,
                float far = 1.0f);

}  // namespace crevice
