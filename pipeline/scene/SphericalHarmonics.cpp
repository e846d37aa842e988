// The basis of order 2 and its convolution with a cosine.
#include "scene/SphericalHarmonics.h"

namespace crevice {
namespace {

/// Band factors of the clamped cosine, over pi.
constexpr std::array<double, 9> kCosine{1.0, 2.0 / 3, 2.0 / 3, 2.0 / 3, 0.25, 0.25, 0.25, 0.25, 0.25};

std::array<double, 9> polynomials(const glm::dvec3& d) {
    return {1.0, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3 * d.z * d.z - 1, d.z * d.x, d.x * d.x - d.y * d.y};
}

}  // namespace

ShCoefficients shIrradiancePolynomial(const ShCoefficients& radiance) {
    ShCoefficients factors;
    for (std::size_t i = 0; i < factors.size(); ++i)
        factors[i] = radiance[i] * static_cast<float>(kShNorm[i] * kCosine[i]);
    return factors;
}

glm::vec3 shIrradiance(const ShCoefficients& radiance, const glm::vec3& normal) {
    const ShCoefficients factors = shIrradiancePolynomial(radiance);
    const std::array<double, 9> values = polynomials(normal);
    glm::vec3 sum(0);
    for (std::size_t i = 0; i < factors.size(); ++i) sum += factors[i] * static_cast<float>(values[i]);
    return glm::max(sum, glm::vec3(0));
}

}  // namespace crevice
