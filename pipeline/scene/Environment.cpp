// Directions of panoramas, and what is known of one at once: bad texels and spherical harmonics.
#include "scene/Environment.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "core/Error.h"
#include "core/Parallel.h"

namespace crevice {
namespace {

constexpr double kPi = 3.14159265358979323846;

glm::vec4* rowOf(Image& image, std::uint32_t y) { return reinterpret_cast<glm::vec4*>(image.pixel(0, y)); }
const glm::vec4* rowOf(const Image& image, std::uint32_t y) {
    return reinterpret_cast<const glm::vec4*>(image.pixel(0, y));
}

struct BadTexels {
    std::uint64_t notANumber = 0, negative = 0, tooBright = 0;
};

BadTexels clampTexels(Image& radiance) {
    BadTexels bad;
    for (std::uint32_t y = 0; y < radiance.height; ++y) {
        glm::vec4* row = rowOf(radiance, y);
        for (std::uint32_t x = 0; x < radiance.width; ++x) {
            bool nan = false, negative = false, bright = false;
            for (int c = 0; c < 3; ++c) {
                float& value = row[x][c];
                nan |= std::isnan(value);
                negative |= value < 0;
                bright |= value > kMaxRadiance;
                value = value > 0 ? std::min(value, kMaxRadiance) : 0.0f;  // false for not-a-number as well
            }
            row[x].a = 1;
            bad.notANumber += nan;
            bad.negative += negative;
            bad.tooBright += bright;
        }
    }
    return bad;
}

void noteBadTexels(const BadTexels& bad, const std::string& name, const Log& log) {
    const auto say = [&](std::uint64_t count, const char* what) {
        if (count > 0)
            log.note(fmt::format("environment '{}': {} texel{} {}", name, count, count == 1 ? "" : "s", what));
    };
    say(bad.notANumber, "not a number, taken as black");
    say(bad.negative, "negative, taken as black");
    say(bad.tooBright, "brighter than 1e9, clamped");
}

using RowSums = std::array<glm::dvec3, 9>;

/// Integrals over one texel's azimuths.
struct ColumnIntegrals {
    double one, cosine, sine, cosine2, sine2, sineCosine;
};
std::vector<ColumnIntegrals> columnIntegrals(std::uint32_t width) {
    std::vector<ColumnIntegrals> columns;
    for (std::uint32_t x = 0; x < width; ++x) {
        const double a = 2 * kPi * (double(x) / width - 0.5), b = 2 * kPi * (double(x + 1) / width - 0.5);
        const double doubled = (std::sin(2 * b) - std::sin(2 * a)) / 4;
        columns.push_back({b - a, std::sin(b) - std::sin(a), std::cos(a) - std::cos(b), (b - a) / 2 + doubled,
                           (b - a) / 2 - doubled, (std::cos(2 * a) - std::cos(2 * b)) / 4});
    }
    return columns;
}

/// Sum of one row's texels times the integrals of the basis over them, which are exact: y is the cosine of the polar
/// angle t, x and z its sine times cosine and sine of the azimuth.
RowSums harmonicsOfRow(const Image& radiance, std::uint32_t y, const std::vector<ColumnIntegrals>& columns) {
    const double a = kPi * y / radiance.height, b = kPi * (y + 1) / radiance.height;
    const auto between = [&](auto antiderivative) { return antiderivative(b) - antiderivative(a); };
    const double one = between([](double t) { return -std::cos(t); });                       // of sin t
    const double cosine = between([](double t) { return std::pow(std::sin(t), 2) / 2; });    // of cos t sin t
    const double sine = between([](double t) { return t / 2 - std::sin(2 * t) / 4; });       // of sin² t
    const double both = between([](double t) { return std::pow(std::sin(t), 3) / 3; });      // of sin² t cos t
    const double cosine2 = between([](double t) { return -std::pow(std::cos(t), 3) / 3; });  // of cos² t sin t
    const double sine2 = one - cosine2;                                                      // of sin³ t
    RowSums sums{};
    const glm::vec4* row = rowOf(radiance, y);
    for (std::uint32_t x = 0; x < radiance.width; ++x) {
        const ColumnIntegrals& c = columns[x];
        const std::array<double, 9> integrals{one * c.one,
                                              cosine * c.one,
                                              sine * c.sine,
                                              sine * c.cosine,
                                              both * c.cosine,
                                              both * c.sine,
                                              3 * sine2 * c.sine2 - one * c.one,
                                              sine2 * c.sineCosine,
                                              sine2 * c.cosine2 - cosine2 * c.one};
        const glm::dvec3 light(row[x]);
        for (std::size_t i = 0; i < integrals.size(); ++i) sums[i] += integrals[i] * light;
    }
    return sums;
}

/// Rows are summed in order, so that the result does not depend on the threads.
ShCoefficients harmonicsOf(const Image& radiance) {
    const std::vector<ColumnIntegrals> columns = columnIntegrals(radiance.width);
    std::vector<RowSums> rows(radiance.height);
    forEachRow(radiance.height, 0, [&](std::uint32_t y) { rows[y] = harmonicsOfRow(radiance, y, columns); });
    RowSums total{};
    for (const RowSums& row : rows)
        for (std::size_t i = 0; i < total.size(); ++i) total[i] += row[i];
    ShCoefficients result;
    for (std::size_t i = 0; i < total.size(); ++i) result[i] = glm::vec3(total[i] * kShNorm[i]);
    return result;
}

/// A texel with wrapped columns; beyond a pole lies the other side of the same row.
glm::vec3 texelAround(const Image& image, int x, int y) {
    const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
    if (y < 0 || y >= height) {
        y = y < 0 ? -1 - y : 2 * height - 1 - y;
        x += width / 2;
    }
    x = (x % width + width) % width;
    return glm::vec3(rowOf(image, static_cast<std::uint32_t>(y))[x]);
}

}  // namespace

glm::dvec3 equirectDirection(double x, double y, std::uint32_t width, std::uint32_t height) {
    const double azimuth = 2 * kPi * ((x + 0.5) / width - 0.5), polar = kPi * (y + 0.5) / height;
    return {std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth)};
}

glm::vec3 sampleEquirect(const Image& equirect, const glm::vec3& direction) {
    assert(equirect.format == Format::RGBA32F);
    const float azimuth = std::atan2(direction.z, direction.x);
    // Near the poles acos would lose half the digits.
    const float polar = std::atan2(std::hypot(direction.x, direction.z), direction.y);
    const float x = (azimuth * glm::one_over_two_pi<float>() + 0.5f) * static_cast<float>(equirect.width) - 0.5f;
    const float y = polar * glm::one_over_pi<float>() * static_cast<float>(equirect.height) - 0.5f;
    const float left = std::floor(x), top = std::floor(y);
    const int x0 = static_cast<int>(left), y0 = static_cast<int>(top);
    const glm::vec3 upper = glm::mix(texelAround(equirect, x0, y0), texelAround(equirect, x0 + 1, y0), x - left);
    const glm::vec3 lower =
        glm::mix(texelAround(equirect, x0, y0 + 1), texelAround(equirect, x0 + 1, y0 + 1), x - left);
    return glm::mix(upper, lower, y - top);
}

glm::vec3 Environment::diffuse(const glm::vec3& normalWorld) const {
    const float c = std::cos(rotation), s = std::sin(rotation);
    const glm::vec3 turnedBack(c * normalWorld.x - s * normalWorld.z, normalWorld.y,
                               s * normalWorld.x + c * normalWorld.z);
    return shIrradiance(harmonics, turnedBack) * intensity;
}

void checkPanoramaShape(std::uint64_t width, std::uint64_t height, const std::string& name) {
    if (width > 0 && width == 2 * height) return;
    throw Error(
        fmt::format("environment '{}' is {} x {} pixels, and a panorama of all directions is twice as wide as high",
                    name, width, height),
        "use an equirectangular panorama; cube crosses and mirror balls have to be converted");
}

Environment makeEnvironment(Image radiance, const std::string& name, const Log& log) {
    assert(radiance.format == Format::RGBA32F);
    checkPanoramaShape(radiance.width, radiance.height, name);
    noteBadTexels(clampTexels(radiance), name, log);
    Environment environment;
    environment.name = name;
    environment.harmonics = harmonicsOf(radiance);
    environment.radiance = std::move(radiance);
    return environment;
}

}  // namespace crevice
