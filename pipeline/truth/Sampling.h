// Well-spread pseudo-random points and directions that depend on a seed alone: the same on every machine.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "truth/Falloff.h"

namespace crevice {

/// Mixes a number with a seed; neighbouring numbers end far apart.
std::uint32_t hashWithSeed(std::uint32_t value, std::uint32_t seed);

/// Point `index` of a 2D Sobol' sequence in [0, 1)², Owen-scrambled by the seed. Every seed is an independent unbiased
/// set; counts that are powers of two are spread best.
glm::vec2 scrambledSobol(std::uint32_t index, std::uint32_t seed);

/// Two unit vectors perpendicular to the unit vector n and to each other.
void makeBasis(const glm::vec3& n, glm::vec3& u, glm::vec3& v);

/// Direction around +z with density cos / pi (Malley's method: uniform on the disc, lifted to the hemisphere).
glm::vec3 cosineDirection(const glm::vec2& uniform);

/// Direction around +z by a law.
glm::vec3 sampleDirection(DirectionLaw law, const glm::vec2& uniform);

}  // namespace crevice
