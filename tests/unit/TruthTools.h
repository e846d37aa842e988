// Scenes of exact ambient occlusion: large planes and spheres, points on them, and openness with its own noise.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/Primitives.h"
#include "tests/SceneObjects.h"
#include "truth/AmbientReference.h"

namespace crevice::test {

inline Scene whiteScene() {
    Scene scene;
    scene.materials.emplace_back();
    return scene;
}

/// Corners counter-clockwise seen from the front.
inline void addQuad(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d,
                    int material = 0) {
    Mesh mesh;
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const glm::vec2 uvs[] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    const glm::vec3 corners[] = {a, b, c, d};
    for (int i = 0; i < 4; ++i) mesh.vertices.push_back({.position = corners[i], .normal = normal, .uv0 = uvs[i]});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    addObject(scene, std::move(mesh), glm::mat4(1), material);
}

/// Floor y = 0 over [-size, size]².
inline void addFloor(Scene& scene, float size) {
    addQuad(scene, {-size, 0, size}, {size, 0, size}, {size, 0, -size}, {-size, 0, -size});
}
/// Wall in the plane x = `x`, from the floor up to `height`; which way it faces does not matter.
inline void addWallX(Scene& scene, float x, float height, float halfLength) {
    addQuad(scene, {x, 0, -halfLength}, {x, 0, halfLength}, {x, height, halfLength}, {x, height, -halfLength});
}
inline void addWallZ(Scene& scene, float z, float height, float halfLength) {
    addQuad(scene, {-halfLength, 0, z}, {halfLength, 0, z}, {halfLength, height, z}, {-halfLength, height, z});
}

inline SurfaceHit pointAt(const glm::vec3& position, const glm::vec3& normal) {
    SurfaceHit point;
    point.position = position;
    point.normal = point.geometricNormal = glm::normalize(normal);
    return point;
}

struct Estimate {
    double mean = 0, sigma = 0;  ///< Of the mean.
};

/// Mean of 32 independent estimates of 512 rays each, and its standard error from their spread.
inline Estimate estimateOpenness(const Scene& scene, const SurfaceHit& point, float radius,
                                 const char* falloff = "hard") {
    constexpr std::uint32_t kSets = 16;
    const RayScene rays(scene);
    const AmbientSettings settings{.terms = {{radius, findFalloff(falloff)}}, .samples = 1024};
    std::vector<double> values;
    for (std::uint32_t seed = 0; seed < kSets; ++seed) {
        const Openness openness = traceOpenness(rays, point, settings, seed).front();
        values.push_back(openness.first);
        values.push_back(openness.second);
    }
    Estimate result;
    const auto n = static_cast<double>(values.size());
    for (const double value : values) result.mean += value / n;
    for (const double value : values) result.sigma += (value - result.mean) * (value - result.mean);
    result.sigma = std::sqrt(result.sigma / (n * (n - 1)));
    return result;
}

/// Within three standard errors, and what the finite stand-in of the scene is off (`standIn`).
inline void expectOpenness(const Estimate& estimate, double exact, double standIn) {
    EXPECT_LE(std::abs(estimate.mean - exact), 3 * estimate.sigma + standIn)
        << "traced " << estimate.mean << " ± " << estimate.sigma << ", exact " << exact;
    EXPECT_LT(estimate.sigma, 2e-3) << "the noise hides errors";
}

/// Area of a unit disc's segment beyond the chord at distance k from the centre.
inline double segmentArea(double k) { return k < 1 ? std::acos(k) - k * std::sqrt(1 - k * k) : 0; }

/// Segments that two perpendicular chords cut off count their common part once.
inline double cornerOpenness(double k1, double k2) {
    const double common = k1 * k1 + k2 * k2 >= 1
                              ? 0
                              : k1 * k2 + 0.5 * (std::acos(k2) - std::asin(k1) - k1 * std::sqrt(1 - k1 * k1) -
                                                 k2 * std::sqrt(1 - k2 * k2));
    return 1 - (segmentArea(k1) + segmentArea(k2) - common) / glm::pi<double>();
}

/// Share of a cosine-weighted hemisphere that a cap of directions takes whose axis is `tilt` from the normal and whose
/// half-angle is `size`, below 90°: the part above the horizon alone when it sets.
inline double capFactor(double tilt, double size) {
    const double c = std::cos(tilt), h = 1 / (std::sin(size) * std::sin(size));
    if (c * c * h >= 1) return std::max(0.0, c) / h;
    const double k = std::sqrt(std::max(0.0, 1 - h * c * c)), root = std::sqrt(h - 1);
    return ((c * std::acos(std::clamp(-c * root / std::sqrt(1 - c * c), -1.0, 1.0)) - k * root) / h +
            std::atan2(k, root)) /
           glm::pi<double>();
}

/// Groove of an interior angle, hard radius 1, at a distance from its edge: the other face cuts a cap off the ball.
inline double grooveOpenness(double angle, double distance) {
    const double s = distance * std::sin(angle);
    return s >= 1 ? 1 : 1 - capFactor(angle, std::acos(s));
}

}  // namespace crevice::test
