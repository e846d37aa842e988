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

double ladder(double t, double first = 0.1) { return first + (1 - first) * t * t; }

double fraction(double x) { return x - std::floor(x); }

/// A point of a box, pulled onto the hemisphere; `lift` keeps it above the plane. Without it the point may be 0: drawn
/// anew.
glm::dvec3 boxDirection(Pcg32& random, double lift) {
    for (;;) {
        const double x = random.unit() * 2 - 1;
        const double y = random.unit() * 2 - 1;
        const double z = random.unit() + lift;
        const double length = std::sqrt(x * x + y * y + z * z);
        if (length > 1e-3) return glm::dvec3(x, y, z) / length;
    }
}

/// Uniform in the unit ball, by rejection.
glm::dvec3 ballPoint(Pcg32& random) {
    for (;;) {
        const double x = random.unit() * 2 - 1;
        const double y = random.unit() * 2 - 1;
        const double z = random.unit() * 2 - 1;
        const double squared = x * x + y * y + z * z;
        if (squared <= 1 && squared > 1e-6) return {x, y, z};
    }
}

/// Malley's method: uniform on the disc, lifted to the hemisphere, is cosine-weighted. `kMinZ` keeps samples off the
/// plane.
glm::dvec3 cosineDirection(double u, double v) {
    constexpr double kMinZ = 0.05;
    const double r = std::sqrt(u * (1 - kMinZ * kMinZ));
    const double phi = 6.283185307179586 * v;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r * r)};
}

glm::dvec3 ownSample(SsaoKernelKind kind, Pcg32& random, double t) {
    switch (kind) {
        case SsaoKernelKind::Crytek:
            return ballPoint(random);
        case SsaoKernelKind::LearnOpenGl: {
            const glm::dvec3 direction = boxDirection(random, 0);
            return direction * (random.unit() * ladder(t));
        }
        case SsaoKernelKind::Songjihu:
            return boxDirection(random, 0) * ladder(t, 0.01);
        default:
            return boxDirection(random, 0.01) * ladder(t);
    }
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
        if (kind != SsaoKernelKind::Stratified) {
            samples[i] = rounded(ownSample(kind, random, index / count));
        } else {
            // R2: multiples of 1/p and 1/p², p the plastic number.
            const double u = fraction(shiftU + index * 0.7548776662466927);
            const double v = fraction(shiftV + index * 0.5698402909980532);
            samples[i] = rounded(cosineDirection(u, v) * ladder((index + 0.5) / count));
        }
    }
}

double ssaoRayLength(SsaoKernelKind kind, double x) {
    switch (kind) {
        case SsaoKernelKind::Crytek:
            return std::cbrt(x);
        case SsaoKernelKind::LearnOpenGl:
            return x * x;
        case SsaoKernelKind::Songjihu:
            return ladder(x, 0.01);
        default:
            return ladder(x);
    }
}

void makeSsaoRays(SsaoKernelKind kind, std::uint32_t seed, std::size_t pointsPerRay, std::span<glm::vec4> samples) {
    constexpr double kGolden = 0.6180339887498949;
    Pcg32 random(seed);
    const double turn = random.unit();
    const std::size_t rays = samples.size() / pointsPerRay;
    for (std::size_t ray = 0; ray < rays; ++ray) {
        const auto index = static_cast<double>(ray);
        const auto count = static_cast<double>(rays);
        const glm::dvec3 direction = cosineDirection((index + 0.5) / count, fraction(turn + index * kGolden));
        // Every ray starts elsewhere between its first length and its second: together the rays see all lengths.
        const double start = fraction(0.5 / count + index * kGolden);
        for (std::size_t point = 0; point < pointsPerRay; ++point) {
            const double share = (static_cast<double>(point) + start) / static_cast<double>(pointsPerRay);
            samples[ray * pointsPerRay + point] = rounded(direction * ssaoRayLength(kind, share));
        }
    }
}

std::span<const glm::vec4> makeSsaoSamples(SsaoKernelKind kind, std::uint32_t seed, std::size_t pointsPerRay,
                                           std::span<glm::vec4> room) {
    if (pointsPerRay == 0) {
        makeSsaoKernel(kind, seed, room);
        return room;
    }
    const std::span<glm::vec4> whole = room.first(room.size() / pointsPerRay * pointsPerRay);
    makeSsaoRays(kind, seed, pointsPerRay, whole);
    return whole;
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
