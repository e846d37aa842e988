// Halves level by level; sRGB goes through tables, a power per texel would cost more than the rest of loading.
#include "core/ImageMips.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace crevice {
namespace {

constexpr int kChannels = 4;
constexpr int kEncodeSteps = 1 << 14;  // fine enough that neighbouring bytes differ by at least one step in the darks

/// Both directions of the sRGB curve (IEC 61966-2-1).
struct SrgbTables {
    std::array<float, 256> linear;
    std::array<std::uint8_t, kEncodeSteps + 1> encoded;

    SrgbTables() {
        for (int i = 0; i < 256; ++i) {
            const double c = i / 255.0;
            linear[std::size_t(i)] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
        }
        for (int i = 0; i <= kEncodeSteps; ++i) {
            const double c = static_cast<double>(i) / kEncodeSteps;
            const double coded = c <= 0.0031308 ? c * 12.92 : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
            encoded[std::size_t(i)] = static_cast<std::uint8_t>(coded * 255.0 + 0.5);
        }
    }
    std::uint8_t meanOf(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) const {
        const float mean = 0.25f * (linear[a] + linear[b] + linear[c] + linear[d]);
        return encoded[static_cast<std::size_t>(mean * kEncodeSteps + 0.5f)];
    }
};

std::uint8_t plainMean(int a, int b, int c, int d) { return static_cast<std::uint8_t>((a + b + c + d + 2) / 4); }

const std::uint8_t* bytesOf(const std::byte* bytes) { return reinterpret_cast<const std::uint8_t*>(bytes); }

Image halved(const Image& from, const SrgbTables* srgb) {
    Image to(std::max(from.width / 2, 1u), std::max(from.height / 2, 1u), from.format);
    const std::size_t right = from.width > 1 ? kChannels : 0;  // a side of one texel is its own neighbour
    for (std::uint32_t y = 0; y < to.height; ++y) {
        const std::uint8_t* upper = bytesOf(from.pixel(0, std::min(2 * y, from.height - 1)));
        const std::uint8_t* lower = bytesOf(from.pixel(0, std::min(2 * y + 1, from.height - 1)));
        auto* out = reinterpret_cast<std::uint8_t*>(to.pixel(0, y));
        for (std::uint32_t x = 0; x < to.width; ++x, upper += 2 * kChannels, lower += 2 * kChannels, out += kChannels) {
            for (int c = 0; c < kChannels; ++c) {
                const std::uint8_t a = upper[c], b = upper[c + right], d = lower[c], e = lower[c + right];
                out[c] = srgb && c < 3 ? srgb->meanOf(a, b, d, e) : plainMean(a, b, d, e);
            }
        }
    }
    return to;
}

}  // namespace

std::vector<Image> makeMips(const Image& image) {
    assert(image.format == Format::RGBA8 || image.format == Format::RGBA8_SRGB);
    static const SrgbTables tables;
    const SrgbTables* srgb = image.format == Format::RGBA8_SRGB ? &tables : nullptr;
    std::vector<Image> levels;
    for (std::uint32_t side = std::max(image.width, image.height); side > 1; side /= 2) {
        levels.push_back(halved(levels.empty() ? image : levels.back(), srgb));
    }
    return levels;
}

}  // namespace crevice
