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
    float unit() { return static_cast<float>(next() >> 8u) * 0x1p-24f; }

private:
    static constexpr std::uint64_t kIncrement = 1442695040888963407ull;
    std::uint64_t state_;
};

float ladder(float t) { return 0.1f + 0.9f * t * t; }

glm::vec3 articleDirection(Pcg32& random) {
    const float x = random.unit() * 2.0f - 1.0f;
    const float y = random.unit() * 2.0f - 1.0f;
    const float z = random.unit() + 0.01f;
    return glm::vec3(x, y, z) / std::sqrt(x * x + y * y + z * z);
}

/// Malley's method: uniform on the disc, lifted to the hemisphere, is cosine-weighted. `kMinZ` keeps samples off the
/// plane.
glm::vec3 cosineDirection(float u, float v) {
    constexpr float kMinZ = 0.05f;
    const float r = std::sqrt(u * (1.0f - kMinZ * kMinZ));
    const float phi = 6.28318530718f * v;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0f - r * r)};
}

float fraction(double x) { return static_cast<float>(x - std::floor(x)); }

}  // namespace

void makeSsaoKernel(SsaoKernelKind kind, std::uint32_t seed, std::span<glm::vec4> samples) {
    Pcg32 random(seed);
    const auto count = static_cast<float>(samples.size());
    const double shiftU = random.unit();
    const double shiftV = random.unit();
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto index = static_cast<float>(i);
        if (kind == SsaoKernelKind::Article) {
            samples[i] = glm::vec4(articleDirection(random) * ladder(index / count), 0.0f);
        } else {
            // R2: multiples of 1/p and 1/p², p the plastic number.
            const float u = fraction(shiftU + static_cast<double>(i) * 0.7548776662466927);
            const float v = fraction(shiftV + static_cast<double>(i) * 0.5698402909980532);
            samples[i] = glm::vec4(cosineDirection(u, v) * ladder((index + 0.5f) / count), 0.0f);
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
