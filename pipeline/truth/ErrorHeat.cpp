// Colours between three fixed points of Oklab, as sRGB.
#include "truth/ErrorHeat.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace crevice {
namespace {

// Lightness, green to red, blue to yellow.
constexpr glm::dvec3 kNone{0.97, 0, 0};
constexpr glm::dvec3 kTooBright{0.45, 0.16, 0.085};
constexpr glm::dvec3 kTooDark{0.45, -0.02, -0.17};
constexpr std::uint8_t kNotCounted = 128;

/// Ottosson, "A perceptual color space for image processing", 2020.
glm::dvec3 linearFromOklab(const glm::dvec3& lab) {
    const double l = lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z;
    const double m = lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z;
    const double s = lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z;
    const glm::dvec3 cubes(l * l * l, m * m * m, s * s * s);
    return {glm::dot(cubes, {4.0767416621, -3.3077115913, 0.2309699292}),
            glm::dot(cubes, {-1.2684380046, 2.6097574011, -0.3413193965}),
            glm::dot(cubes, {-0.0041960863, -0.7034186147, 1.7076147010})};
}

std::uint8_t srgbByte(double linear) {
    const double x = std::clamp(linear, 0.0, 1.0);
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(encoded * 255));
}

}  // namespace

glm::u8vec3 heatColor(float error, float range) {
    const double share = std::min(std::abs(double(error)) / double(range), 1.0);
    const glm::dvec3 linear = linearFromOklab(glm::mix(kNone, error > 0 ? kTooBright : kTooDark, share));
    return {srgbByte(linear.x), srgbByte(linear.y), srgbByte(linear.z)};
}

Image errorHeat(const glm::uvec2& size, std::span<const float> map, std::span<const float> truth,
                std::span<const std::uint8_t> isCounted, float range) {
    const std::size_t count = std::size_t(size.x) * size.y;
    assert(map.size() == count && truth.size() == count && (isCounted.empty() || isCounted.size() == count));
    Image image(size.x, size.y, Format::RGBA8);
    for (std::size_t i = 0; i < count; ++i) {
        const float value = std::isfinite(map[i]) ? map[i] : 0.0f;
        const bool counts = isCounted.empty() || isCounted[i] != 0;
        const glm::u8vec3 color = counts ? heatColor(value - truth[i], range) : glm::u8vec3(kNotCounted);
        for (int c = 0; c < 3; ++c) image.pixels[4 * i + std::size_t(c)] = std::byte{color[c]};
        image.pixels[4 * i + 3] = std::byte{255};
    }
    return image;
}

}  // namespace crevice
