// Pixel formats by the names that documents use; one table for names, sizes and channels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <glm/glm.hpp>

namespace crevice {

enum class Format : std::uint8_t {
    R8,
    RG8,
    RGBA8,
    RGBA8_SRGB,
    R16,
    RG16,
    RGBA16,
    R16F,
    RG16F,
    RGBA16F,
    R32F,
    RG32F,
    RGBA32F,
    R32UI,
    R11G11B10F,
    D32F
};

struct FormatInfo {
    Format format;
    const char* name;  ///< "R8", as in pipeline documents
    int channels;
    int bytesPerPixel;
    bool isFloat;
    bool isDepth;
};

/// All formats in enum order.
std::span<const FormatInfo> allFormats();
const FormatInfo& formatInfo(Format format);
std::optional<Format> formatFromName(std::string_view name);

/// Decodes one pixel to floats (missing channels 0, alpha 1; sRGB stays encoded: raw / 255; R32UI as a plain number).
glm::vec4 decodePixel(Format format, const std::byte* pixel);

}  // namespace crevice
