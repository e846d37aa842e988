// The table of pixel formats and the decoding of one pixel.
#include "core/Format.h"

#include <cassert>
#include <cstring>

#include <glm/gtc/packing.hpp>

namespace crevice {
namespace {

constexpr std::array<FormatInfo, 16> kFormats{{
    {Format::R8, "R8", 1, 1, false, false},
    {Format::RG8, "RG8", 2, 2, false, false},
    {Format::RGBA8, "RGBA8", 4, 4, false, false},
    {Format::RGBA8_SRGB, "RGBA8_SRGB", 4, 4, false, false},
    {Format::R16, "R16", 1, 2, false, false},
    {Format::RG16, "RG16", 2, 4, false, false},
    {Format::RGBA16, "RGBA16", 4, 8, false, false},
    {Format::R16F, "R16F", 1, 2, true, false},
    {Format::RG16F, "RG16F", 2, 4, true, false},
    {Format::RGBA16F, "RGBA16F", 4, 8, true, false},
    {Format::R32F, "R32F", 1, 4, true, false},
    {Format::RG32F, "RG32F", 2, 8, true, false},
    {Format::RGBA32F, "RGBA32F", 4, 16, true, false},
    {Format::R32UI, "R32UI", 1, 4, false, false},
    {Format::R11G11B10F, "R11G11B10F", 3, 4, true, false},
    {Format::D32F, "D32F", 1, 4, true, true},
}};

constexpr bool tableFollowsEnum() {
    for (std::size_t i = 0; i < kFormats.size(); ++i) {
        if (static_cast<std::size_t>(kFormats[i].format) != i) return false;
    }
    return kFormats.size() == static_cast<std::size_t>(Format::D32F) + 1;
}
static_assert(tableFollowsEnum());

template <class T>
T load(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

glm::vec4 decodeUnorm8(const std::byte* pixel, int channels) {
    glm::vec4 value(0, 0, 0, 1);
    for (int i = 0; i < channels; ++i) value[i] = static_cast<float>(pixel[i]) / 255.0f;
    return value;
}

glm::vec4 decodeUnorm16(const std::byte* pixel, int channels) {
    glm::vec4 value(0, 0, 0, 1);
    for (int i = 0; i < channels; ++i) value[i] = static_cast<float>(load<std::uint16_t>(pixel + 2 * i)) / 65535.0f;
    return value;
}

glm::vec4 decodeHalf(const std::byte* pixel, int channels) {
    glm::vec4 value(0, 0, 0, 1);
    for (int i = 0; i < channels; ++i) value[i] = glm::unpackHalf1x16(load<std::uint16_t>(pixel + 2 * i));
    return value;
}

glm::vec4 decodeFloat(const std::byte* pixel, int channels) {
    glm::vec4 value(0, 0, 0, 1);
    for (int i = 0; i < channels; ++i) value[i] = load<float>(pixel + 4 * i);
    return value;
}

/// Unsigned floats of 5 exponent bits: a half without sign bit and with fewer mantissa bits, so shifting makes a half.
glm::vec4 decodePackedFloats(std::uint32_t bits) {
    const auto half = [](std::uint32_t value, int shift) {
        return glm::unpackHalf1x16(static_cast<std::uint16_t>(value << shift));
    };
    return {half(bits & 0x7ff, 4), half((bits >> 11) & 0x7ff, 4), half((bits >> 22) & 0x3ff, 5), 1.0f};
}

}  // namespace

std::span<const FormatInfo> allFormats() { return kFormats; }

const FormatInfo& formatInfo(Format format) {
    assert(static_cast<std::size_t>(format) < kFormats.size());
    return kFormats[static_cast<std::size_t>(format)];
}

std::optional<Format> formatFromName(std::string_view name) {
    for (const FormatInfo& info : kFormats) {
        if (name == info.name) return info.format;
    }
    return std::nullopt;
}

glm::vec4 decodePixel(Format format, const std::byte* pixel) {
    const int channels = formatInfo(format).channels;
    switch (format) {
        case Format::R8:
        case Format::RG8:
        case Format::RGBA8:
        case Format::RGBA8_SRGB:
            return decodeUnorm8(pixel, channels);
        case Format::R16:
        case Format::RG16:
        case Format::RGBA16:
            return decodeUnorm16(pixel, channels);
        case Format::R16F:
        case Format::RG16F:
        case Format::RGBA16F:
            return decodeHalf(pixel, channels);
        case Format::R32F:
        case Format::RG32F:
        case Format::RGBA32F:
        case Format::D32F:
            return decodeFloat(pixel, channels);
        case Format::R32UI:
            return {static_cast<float>(load<std::uint32_t>(pixel)), 0, 0, 1};
        case Format::R11G11B10F:
            return decodePackedFloats(load<std::uint32_t>(pixel));
    }
    return glm::vec4(0);
}

}  // namespace crevice
