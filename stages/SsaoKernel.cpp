// Makes the kernels with a generator of our own, since std distributions differ between libraries.
#include "SsaoKernel.h"

#include <fmt/format.h>

#include <cmath>

namespace crevice {
namespace {

/// PCG32 (O'Neill 2014), XSH-RR output, fixed stream.
class Pcg32 {
public:
    explicit Pcg32(std::uint32_t seed) : state_(0) {
        next();
        state_ += seed;
        next();
    }
    std::uint32_t next() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005ull + kIncrement;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
        const auto rotation = static_cast<std::uint32_t>(old >> 59u);
        return (shifted >> rotation) | (shifted << ((32u - rotation) & 31u));
    }
    /// [0, 1) in steps of 2^-24.
    double unit() { return (next() >> 8u) * 0x1p-24; }

private:
    static constexpr std::uint64_t kIncrement = 1442695040888963407ull;
    std::uint64_t state_;
};

double ladder(double t) { return 0.1 + 0.9 * t * t; }

double fraction(double x) { return x - std::floor(x); }

glm::dvec3 articleDirection(Pcg32& random) {
    const double x = random.unit() * 2 - 1;
    const double y = random.unit() * 2 - 1;
    const double z = random.unit() + 0.01;
    return glm::dvec3(x, y, z) / std::sqrt(x * x + y * y + z * z);
}

/// Malley's method: uniform on the disc, lifted to the hemisphere, is cosine-weighted. `kMinZ` keeps samples off the
/// plane.
glm::dvec3 cosineDirection(double u, double v) {
    constexpr double kMinZ = 0.05;
    const double r = std::sqrt(u * (1 - kMinZ * kMinZ));
    const double phi = 6.283185307179586 * v;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r * r)};
}

/// Steps of 2^-20: libraries whose cosines differ in the last bit still give the same kernel.
glm::vec4 rounded(const glm::dvec3& sample) { return {glm::vec3(glm::round(sample * 0x1p20) * 0x1p-20), 0}; }

}  // namespace

void makeSsaoKernel(SsaoKernelKind kind, std::uint32_t seed, std::span<glm::vec4> samples) {
    Pcg32 random(seed);
    const auto count = static_cast<double>(samples.size());
    const double shiftU = random.unit();
    const double shiftV = random.unit();
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto index = static_cast<double>(i);
        if (kind == SsaoKernelKind::Article) {
            samples[i] = rounded(articleDirection(random) * ladder(index / count));
        } else {
            // R2: multiples of 1/p and 1/p², p the plastic number.
            const double u = fraction(shiftU + index * 0.7548776662466927);
            const double v = fraction(shiftV + index * 0.5698402909980532);
            samples[i] = rounded(cosineDirection(u, v) * ladder((index + 0.5) / count));
        }
    }
}

std::string ssaoKernelChunk(std::span<const glm::vec4> samples) {
    std::string text = fmt::format("const vec3 kSsaoKernel[{}] = vec3[](\n", samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        // Nine significant digits give every float back exactly.
        text += fmt::format("  vec3({:.9g}, {:.9g}, {:.9g}){}\n", samples[i].x, samples[i].y, samples[i].z,
                            i + 1 < samples.size() ? "," : ");");
    }
    return text;
}

}  // namespace crevice
