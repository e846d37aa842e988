// Points of a plane and half vectors of GGX: how integrals over a lobe are sampled.
#pragma once

#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

namespace crevice {

/// Point i of n of the Hammersley set, in [0, 1).
inline glm::vec2 hammersley(std::uint32_t i, std::uint32_t n) {
    std::uint32_t bits = i;
    bits = (bits << 16) | (bits >> 16);
    bits = ((bits & 0x00ff00ffu) << 8) | ((bits & 0xff00ff00u) >> 8);
    bits = ((bits & 0x0f0f0f0fu) << 4) | ((bits & 0xf0f0f0f0u) >> 4);
    bits = ((bits & 0x33333333u) << 2) | ((bits & 0xccccccccu) >> 2);
    bits = ((bits & 0x55555555u) << 1) | ((bits & 0xaaaaaaaau) >> 1);
    return {(static_cast<float>(i) + 0.5f) / static_cast<float>(n),
            static_cast<float>(bits >> 8) * (1.0f / 16777216.0f)};
}

/// Trowbridge-Reitz's D at a cosine of the angle between normal and half vector; alpha = roughness squared. Half
/// vectors have the density D · cos per steradian, directions that are mirrored head-on D / 4.
inline float ggxDensity(float alpha, float cosine) {
    const float alpha2 = alpha * alpha;
    const float f = (cosine * alpha2 - cosine) * cosine + 1;
    return alpha2 / (3.14159265358979f * f * f);
}

/// A half vector around +z with density D · cos.
inline glm::vec3 sampleGgxHalf(const glm::vec2& point, float alpha) {
    const float cosine2 = (1 - point.x) / (1 + (alpha * alpha - 1) * point.x);
    const float sine = std::sqrt(std::fmax(1 - cosine2, 0.0f));
    const float azimuth = 6.28318530717959f * point.y;
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), std::sqrt(cosine2)};
}

/// A half vector among those that a viewer in a unit direction sees: E. Heitz, "Sampling the GGX Distribution of
/// Visible Normals", JCGT 2018.
inline glm::vec3 sampleVisibleHalf(const glm::vec2& point, float alpha, const glm::vec3& toViewer) {
    const glm::vec3 v = glm::normalize(glm::vec3(alpha * toViewer.x, alpha * toViewer.y, toViewer.z));
    const float length2 = v.x * v.x + v.y * v.y;
    const glm::vec3 right = length2 > 0 ? glm::vec3(-v.y, v.x, 0) / std::sqrt(length2) : glm::vec3(1, 0, 0);
    const glm::vec3 up = glm::cross(v, right);
    const float radius = std::sqrt(point.x), azimuth = 6.28318530717959f * point.y;
    const float x = radius * std::cos(azimuth), share = 0.5f * (1 + v.z);
    const float y = (1 - share) * std::sqrt(std::fmax(1 - x * x, 0.0f)) + share * radius * std::sin(azimuth);
    const glm::vec3 half = x * right + y * up + std::sqrt(std::fmax(1 - x * x - y * y, 0.0f)) * v;
    return glm::normalize(glm::vec3(alpha * half.x, alpha * half.y, std::fmax(half.z, 1e-6f)));
}

/// Columns: two tangents and the unit normal. T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
inline glm::mat3 frameAround(const glm::vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

}  // namespace crevice
