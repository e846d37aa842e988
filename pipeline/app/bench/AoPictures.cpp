// Averages over whole blocks of pixels: nothing between them is left out.
#include "app/bench/AoPictures.h"

#include <algorithm>
#include <cstdint>

namespace crevice {
namespace {

/// Calls `store(x, y, averages)` for every pixel of the small picture; `load(x, y, c)` gives the large one's channels.
template <class Load, class Store>
void average(const glm::uvec2& size, const glm::uvec2& small, int channels, Load load, Store store) {
    for (std::uint32_t y = 0; y < small.y; ++y) {
        for (std::uint32_t x = 0; x < small.x; ++x) {
            const std::uint32_t x0 = x * size.x / small.x, x1 = std::max(x0 + 1, (x + 1) * size.x / small.x);
            const std::uint32_t y0 = y * size.y / small.y, y1 = std::max(y0 + 1, (y + 1) * size.y / small.y);
            for (int c = 0; c < channels; ++c) {
                double sum = 0;
                for (std::uint32_t v = y0; v < y1; ++v)
                    for (std::uint32_t u = x0; u < x1; ++u) sum += load(u, v, c);
                store(x, y, c, sum / (double(x1 - x0) * double(y1 - y0)));
            }
        }
    }
}

glm::uvec2 smallSize(const glm::uvec2& size, std::uint32_t width) {
    if (size.x <= width) return size;
    return {width, std::max(1u, (size.y * width + size.x / 2) / size.x)};
}

std::byte toByte(double value) { return static_cast<std::byte>(std::clamp(value, 0.0, 255.0) + 0.5); }

}  // namespace

Image greyPicture(std::span<const float> values, const glm::uvec2& size, std::uint32_t width, float gain) {
    const glm::uvec2 small = smallSize(size, width);
    Image image(small.x, small.y, Format::R8);
    average(
        size, small, 1,
        [&](std::uint32_t x, std::uint32_t y, int) { return double(values[std::size_t(y) * size.x + x]); },
        [&](std::uint32_t x, std::uint32_t y, int, double value) { *image.pixel(x, y) = toByte(value * gain * 255); });
    return image;
}

Image shrunk(const Image& image, std::uint32_t width) {
    const glm::uvec2 size{image.width, image.height}, small = smallSize(size, width);
    Image result(small.x, small.y, Format::RGBA8);
    average(
        size, small, 4,
        [&](std::uint32_t x, std::uint32_t y, int c) { return std::to_integer<int>(image.pixel(x, y)[c]); },
        [&](std::uint32_t x, std::uint32_t y, int c, double value) { result.pixel(x, y)[c] = toByte(value); });
    return result;
}

std::string pngDataUri(const Image& image) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::vector<std::byte> bytes = encodePng(image);
    std::string text = "data:image/png;base64,";
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const bool isPadding = k > 0 && i + k - 1 >= bytes.size();  // digit k holds bits of byte k - 1
            text += isPadding ? '=' : kDigits[group >> (18 - 6 * k) & 63];
        }
    }
    return text;
}

}  // namespace crevice
