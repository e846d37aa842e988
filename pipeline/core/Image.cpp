// A CPU image: access to pixels and the mapping of any format to 8 bits.
#include "core/Image.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace crevice {
namespace {

Format eightBitFormat(int channels) {
    if (channels == 1) return Format::R8;
    return channels == 2 ? Format::RG8 : Format::RGBA8;
}

bool isEightBit(Format format) {
    return format == Format::R8 || format == Format::RG8 || format == Format::RGBA8 || format == Format::RGBA8_SRGB;
}

/// Round half up. Not-a-number becomes 0: both comparisons are false for it.
std::byte toByte(float value) {
    if (!(value > 0.0f)) return std::byte{0};
    if (value >= 1.0f) return std::byte{255};
    return static_cast<std::byte>(static_cast<int>(value * 255.0f + 0.5f));
}

/// Colours are mapped, alpha is only clamped.
glm::vec4 applyMapping(glm::vec4 value, PngMapping mapping, float far) {
    switch (mapping) {
        case PngMapping::Clamp:
            return value;
        case PngMapping::Signed:
            return {glm::vec3(value) * 0.5f + 0.5f, value.a};
        case PngMapping::DepthByFar:
            return {glm::vec3(value) / far, value.a};
    }
    return value;
}

}  // namespace

Image::Image(std::uint32_t imageWidth, std::uint32_t imageHeight, Format imageFormat)
    : width(imageWidth),
      height(imageHeight),
      format(imageFormat),
      pixels(std::size_t(imageWidth) * imageHeight * static_cast<std::size_t>(formatInfo(imageFormat).bytesPerPixel)) {}

std::byte* Image::pixel(std::uint32_t x, std::uint32_t y) {
    assert(x < width && y < height);
    const auto stride = static_cast<std::size_t>(formatInfo(format).bytesPerPixel);
    return pixels.data() + (std::size_t(y) * width + x) * stride;
}

const std::byte* Image::pixel(std::uint32_t x, std::uint32_t y) const {
    assert(x < width && y < height);
    const auto stride = static_cast<std::size_t>(formatInfo(format).bytesPerPixel);
    return pixels.data() + (std::size_t(y) * width + x) * stride;
}

glm::vec4 Image::at(std::uint32_t x, std::uint32_t y) const { return decodePixel(format, pixel(x, y)); }

Image cropped(const Image& image, glm::uvec2 offset, glm::uvec2 extent) {
    assert(offset.x + extent.x <= image.width && offset.y + extent.y <= image.height);
    Image part(extent.x, extent.y, image.format);
    const std::size_t rowBytes = part.pixels.size() / std::max(1u, extent.y);
    for (std::uint32_t y = 0; y < extent.y; ++y)
        std::memcpy(part.pixel(0, y), image.pixel(offset.x, offset.y + y), rowBytes);
    return part;
}

Image toEightBit(const Image& image, PngMapping mapping, float far) {
    assert(far > 0.0f);
    const int channels = formatInfo(image.format).channels;
    if (mapping == PngMapping::Clamp && isEightBit(image.format)) {
        Image copy = image;
        copy.format = eightBitFormat(channels);
        return copy;
    }
    Image result(image.width, image.height, eightBitFormat(channels));
    const int written = formatInfo(result.format).channels;
    const auto sourceStride = static_cast<std::size_t>(formatInfo(image.format).bytesPerPixel);
    const std::byte* source = image.pixels.data();
    std::byte* target = result.pixels.data();
    for (std::size_t i = 0; i < std::size_t(image.width) * image.height; ++i) {
        const glm::vec4 value = applyMapping(decodePixel(image.format, source), mapping, far);
        for (int c = 0; c < written; ++c) *target++ = toByte(value[c]);
        source += sourceStride;
    }
    return result;
}

}  // namespace crevice
