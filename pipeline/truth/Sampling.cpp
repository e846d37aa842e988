// Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020 (the permutation is Laine and Karras', 2011), and
// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
#include "truth/Sampling.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>

namespace crevice {
namespace {

std::uint32_t reverseBits(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Every bit is flipped or not by a hash of the lower ones: an Owen scramble of the reversed number.
std::uint32_t permuteUpwards(std::uint32_t x, std::uint32_t seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

std::uint32_t scramble(std::uint32_t x, std::uint32_t seed) {
    return reverseBits(permuteUpwards(reverseBits(x), seed));
}

/// Second dimension of Sobol's sequence (primitive polynomial x + 1): each direction number is the one before XOR
/// itself halved.
std::uint32_t secondSobol(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t direction = 1u << 31; index != 0; index >>= 1, direction ^= direction >> 1)
        if (index & 1) result ^= direction;
    return result;
}

/// 24 bits, so that the result stays below 1.
float toUnit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

/// Share of the directions of DirectionLaw::Box whose angle to the axis has a tangent of at most t. A third of the box
/// is the pyramid on its top, two thirds are those on its sides; directions are uniform over every pyramid's base.
double boxShareWithin(double t) {
    constexpr double kQuarter = 0.25 * glm::pi<double>();
    // The circle of radius t around the top's middle leaves the top there, and the sides begin to count.
    const double past = t > 1 ? std::min(1.0, std::sqrt(t * t - 1)) : 0;
    const double top = t <= 1 ? kQuarter * t * t : past < 1 ? past + t * t * (kQuarter - std::atan(past)) : 1;
    const double side = past - 0.5 * (past * std::sqrt(1 + past * past) + std::asinh(past)) / std::max(t, 1.0);
    return (top + 2 * side) / 3;
}

/// Cosines of the angles that equal shares of the directions do not exceed.
struct BoxCosines {
    static constexpr std::size_t kSteps = 4096;
    std::array<float, kSteps + 1> values{};
    BoxCosines() {
        for (std::size_t i = 0; i <= kSteps; ++i) {
            double low = 0, high = glm::half_pi<double>();
            for (int round = 0; round < 60; ++round) {
                const double middle = 0.5 * (low + high);
                (boxShareWithin(std::tan(middle)) < double(i) / kSteps ? low : high) = middle;
            }
            values[i] = static_cast<float>(std::cos(0.5 * (low + high)));
        }
    }
};

glm::vec3 withCosine(float cosine, float turn) {
    const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine)), angle = 2 * glm::pi<float>() * turn;
    return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

glm::vec3 boxDirection(const glm::vec2& uniform) {
    static const BoxCosines kCosines;
    const float place = uniform.x * float(BoxCosines::kSteps);
    const auto step = std::min(static_cast<std::size_t>(place), BoxCosines::kSteps - 1);
    const float part = place - static_cast<float>(step);
    return withCosine(glm::mix(kCosines.values[step], kCosines.values[step + 1], part), uniform.y);
}

}  // namespace

// The finaliser of MurmurHash3 (Appleby).
std::uint32_t hashWithSeed(std::uint32_t value, std::uint32_t seed) {
    std::uint32_t h = value + seed * 0x9e3779b9u + 0x7f4a7c15u;
    for (int round = 0; round < 2; ++round) {
        h ^= h >> 16;
        h *= 0x85ebca6bu;
        h ^= h >> 13;
        h *= 0xc2b2ae35u;
        h ^= h >> 16;
        h += seed;
    }
    return h;
}

glm::vec2 scrambledSobol(std::uint32_t index, std::uint32_t seed) {
    const std::uint32_t shuffled = scramble(index, hashWithSeed(0, seed));
    return {toUnit(scramble(reverseBits(shuffled), hashWithSeed(1, seed))),
            toUnit(scramble(secondSobol(shuffled), hashWithSeed(2, seed)))};
}

void makeBasis(const glm::vec3& n, glm::vec3& u, glm::vec3& v) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    u = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    v = {b, sign + n.y * n.y * a, -n.y};
}

glm::vec3 cosineDirection(const glm::vec2& uniform) {
    const float radius = std::sqrt(uniform.x), angle = 2 * glm::pi<float>() * uniform.y;
    return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(0.0f, 1 - uniform.x))};
}

glm::vec3 sampleDirection(DirectionLaw law, const glm::vec2& uniform) {
    if (law == DirectionLaw::Uniform) return withCosine(1 - uniform.x, uniform.y);
    return law == DirectionLaw::Box ? boxDirection(uniform) : cosineDirection(uniform);
}

}  // namespace crevice
