// The directional reflectance of GGX, integrated once per texel.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/gtc/packing.hpp>

#include "core/Parallel.h"
#include "scene/EnvironmentCube.h"
#include "scene/GgxSampling.h"

namespace crevice {
namespace {

constexpr std::uint32_t kSamples = 512;
constexpr float kMinRoughness = 0.045f;  // as in brdf.chunk
constexpr float kMinCosine = 1e-3f;

/// Smith's shadowing of the light where the viewer sees the facet, height-correlated (Heitz 2014): G2 / G1. The same G2
/// as visibilitySmith() of brdf.chunk.
float shadowing(float alpha, float nDotL, float nDotV) {
    const float alpha2 = alpha * alpha;
    const float view = std::sqrt(nDotV * nDotV * (1 - alpha2) + alpha2);
    const float light = std::sqrt(nDotL * nDotL * (1 - alpha2) + alpha2);
    return nDotL * (nDotV + view) / (nDotL * view + nDotV * light);
}

/// Factor and addend of F0: Karis 2013, over the facets that the viewer sees.
glm::vec2 reflectance(float nDotV, float roughness) {
    const float alpha = std::max(roughness, kMinRoughness) * std::max(roughness, kMinRoughness);
    const glm::vec3 toViewer(std::sqrt(1 - nDotV * nDotV), 0, nDotV);
    glm::dvec2 sum(0);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const glm::vec3 half = sampleVisibleHalf(hammersley(i, kSamples), alpha, toViewer);
        const float vDotH = glm::clamp(glm::dot(toViewer, half), 0.0f, 1.0f);
        const float nDotL = 2 * vDotH * half.z - toViewer.z;
        if (nDotL <= 0) continue;
        const float share = shadowing(alpha, nDotL, nDotV);
        const float grazing = std::pow(1 - vDotH, 5.0f);
        sum += glm::dvec2((1 - grazing) * share, grazing * share);
    }
    return glm::vec2(sum / double(kSamples));
}

}  // namespace

Image makeBrdfTable(unsigned threads) {
    Image table(kBrdfTableSize, kBrdfTableSize, Format::RG16F);
    forEachRow(kBrdfTableSize, threads, [&](std::uint32_t y) {
        constexpr float kLast = kBrdfTableSize - 1;
        for (std::uint32_t x = 0; x < kBrdfTableSize; ++x) {
            const float nDotV = std::max(static_cast<float>(x) / kLast, kMinCosine);
            const std::uint32_t halves = glm::packHalf2x16(reflectance(nDotV, static_cast<float>(y) / kLast));
            std::memcpy(table.pixel(x, y), &halves, sizeof halves);
        }
    });
    return table;
}

}  // namespace crevice
