// Spherical harmonics of order 2: what a diffuse surface needs to know of the light around it.
#pragma once

#include <array>

#include <glm/glm.hpp>

namespace crevice {

/// Nine coefficients, linear RGB, in the order (l,m) = 00, 1-1, 10, 11, 2-2, 2-1, 20, 21, 22.
using ShCoefficients = std::array<glm::vec3, 9>;

/// The real basis functions are these factors times 1, y, z, x, xy, yz, 3z² - 1, zx, x² - y² of a unit direction:
/// square roots of 1/(4 pi), 3/(4 pi), 15/(4 pi), 5/(16 pi), 15/(16 pi). Ramamoorthi and Hanrahan, "An Efficient
/// Representation for Irradiance Environment Maps", SIGGRAPH 2001, equation 3.
inline constexpr std::array<double, 9> kShNorm{0.28209479177387814, 0.4886025119029199, 0.4886025119029199,
                                               0.4886025119029199,  1.0925484305920792, 1.0925484305920792,
                                               0.31539156525252005, 1.0925484305920792, 0.5462742152960396};

/// Irradiance / pi of a surface with that unit normal, from the coefficients of radiance: equation 8 there (the bands
/// of the clamped cosine are pi, 2 pi / 3 and pi / 4). Exact for a uniform environment; of a single bright point at
/// angle t from the normal it is 1/4 + cos(t)/2 + 5 (3 cos²(t) - 1)/32 where a cosine is wanted. Never negative.
glm::vec3 shIrradiance(const ShCoefficients& radiance, const glm::vec3& normal);

/// The same as factors of those nine polynomials of the normal: what the shader evaluates.
ShCoefficients shIrradiancePolynomial(const ShCoefficients& radiance);

}  // namespace crevice
