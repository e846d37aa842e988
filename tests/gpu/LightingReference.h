// What a metallic-roughness surface sends to the viewer, in double precision, written from glTF 2.0 appendix B and
// KHR_lights_punctual rather than from the shaders.
#pragma once

#include <algorithm>
#include <cmath>

#include "scene/Scene.h"

namespace crevice {

struct ReferencePoint {
    glm::dvec3 position{0}, normal{0, 0, 1}, toViewer{0, 0, 1};
    glm::dvec3 baseColor{1};
    double metallic = 0, roughness = 1;
};

inline constexpr double kReferencePi = 3.14159265358979323846;

/// Appendix B.2 and B.3: dielectric and metal mixed by metallic, times n·l.
inline glm::dvec3 referenceBrdf(const ReferencePoint& p, const glm::dvec3& toLight) {
    const double nl = glm::dot(p.normal, toLight);
    if (nl <= 0) return glm::dvec3(0);
    const double nv = glm::dot(p.normal, p.toViewer);
    const glm::dvec3 h = glm::normalize(toLight + p.toViewer);
    const double nh = glm::dot(p.normal, h);
    const double vh = glm::dot(p.toViewer, h);
    const double a2 = std::pow(p.roughness, 4);
    const double d = a2 / (kReferencePi * std::pow(nh * nh * (a2 - 1) + 1, 2));
    // Height-correlated Smith over 4 (n·l) (n·v): Heitz 2014, equation 99.
    const double lambdaV = nl * std::sqrt(nv * nv * (1 - a2) + a2);
    const double lambdaL = nv * std::sqrt(nl * nl * (1 - a2) + a2);
    const double v = 0.5 / (lambdaV + lambdaL);
    const glm::dvec3 diffuse = p.baseColor / kReferencePi;
    const glm::dvec3 specular(d * v);
    const double grazing = std::pow(1 - vh, 5);
    const double dielectricFresnel = 0.04 + (1 - 0.04) * grazing;
    const glm::dvec3 dielectric = diffuse * (1 - dielectricFresnel) + specular * dielectricFresnel;
    const glm::dvec3 metal = specular * (p.baseColor + (glm::dvec3(1) - p.baseColor) * grazing);
    return (dielectric * (1 - p.metallic) + metal * p.metallic) * nl;
}

inline glm::dvec3 referenceLight(const ReferencePoint& p, const Light& light) {
    const glm::dvec3 color = glm::dvec3(light.color) * double(light.intensity);
    if (light.type == LightType::Directional) return referenceBrdf(p, -glm::dvec3(light.direction)) * color;
    const glm::dvec3 offset = glm::dvec3(light.position) - p.position;
    const double distance = glm::length(offset);
    const glm::dvec3 toLight = offset / distance;
    double attenuation = 1 / (distance * distance);
    if (light.range > 0) attenuation *= std::clamp(1 - std::pow(distance / double(light.range), 4), 0.0, 1.0);
    if (light.type == LightType::Spot) {
        const double cosOuter = std::cos(double(light.outerAngle));
        const double scale = 1 / std::max(0.001, std::cos(double(light.innerAngle)) - cosOuter);
        const double along = glm::dot(glm::dvec3(light.direction), -toLight);
        const double cone = std::clamp((along - cosOuter) * scale, 0.0, 1.0);
        attenuation *= cone * cone;
    }
    return referenceBrdf(p, toLight) * color * attenuation;
}

inline glm::dvec3 referenceRadiance(const ReferencePoint& p, const Scene& scene) {
    glm::dvec3 sum(0);
    for (const Light& light : scene.lights) sum += referenceLight(p, light);
    return sum;
}

}  // namespace crevice
