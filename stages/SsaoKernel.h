// Sample kernels of hemisphere SSAO: pure functions of a seed and a count.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <glm/glm.hpp>

namespace crevice {

inline constexpr int kSsaoMaxSamples = 64;

/// Article: box-shaped directions normalize(U[-1,1], U[-1,1], U[0,1] + 0.01), as the Cocos article draws them.
/// Stratified: cosine-weighted directions from the R2 sequence (M. Roberts 2018), shifted by the seed.
/// Both use the radius ladder lerp(0.1, 1, t²), generated for the given count: t = i/n, or (i + 1/2)/n when stratified.
enum class SsaoKernelKind { Article, Stratified };

/// Fills `samples` (x, y, z in tangent space, z > 0, length <= 1; w = 0); the size of the span is the count, 1 to 64.
void makeSsaoKernel(SsaoKernelKind kind, std::uint32_t seed, std::span<glm::vec4> samples);

/// The chunk `ssao-kernel`: the same samples as GLSL constants, exact to the bit.
std::string ssaoKernelChunk(std::span<const glm::vec4> samples);

}  // namespace crevice
