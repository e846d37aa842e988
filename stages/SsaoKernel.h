// Sample kernels of hemisphere and sphere SSAO: pure functions of a seed and a count.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <glm/glm.hpp>

namespace crevice {

inline constexpr int kSsaoMaxSamples = 64;

/// Which technique's directions and lengths; U are independent uniform numbers, i the index of n samples.
/// Article: normalize(U[-1,1], U[-1,1], U[0,1] + 0.01), lengths lerp(0.1, 1, (i/n)²): the Cocos article.
/// Stratified: cosine-weighted directions from the R2 sequence (M. Roberts 2018), shifted by the seed; the same ladder
/// at (i + 1/2)/n.
/// Crytek: uniform in the whole unit ball, below the surface too: the spherical kernel of 2007.
/// LearnOpenGl: normalize(U[-1,1], U[-1,1], U[0,1]), lengths U · lerp(0.1, 1, (i/n)²).
/// Songjihu: the same directions, lengths lerp(0.01, 1, (i/n)²).
enum class SsaoKernelKind { Article, Stratified, Crytek, LearnOpenGl, Songjihu };

/// Fills `samples` (x, y, z in tangent space, length <= 1; w = 0; z > 0 but for Crytek); the size of the span is the
/// count, 1 to 64.
void makeSsaoKernel(SsaoKernelKind kind, std::uint32_t seed, std::span<glm::vec4> samples);

/// Rays instead of points: every `pointsPerRay` samples that follow each other lie on one ray. Directions are
/// cosine-weighted, evenly spread in elevation and, by the golden ratio, in azimuth; the lengths follow
/// ssaoRayLength(). The size of the span is a multiple of `pointsPerRay`.
void makeSsaoRays(SsaoKernelKind kind, std::uint32_t seed, std::size_t pointsPerRay, std::span<glm::vec4> samples);

/// One or the other: rays where `pointsPerRay` is above 0, of which as many fit as `room` has place for. Returns the
/// part of `room` that was filled.
std::span<const glm::vec4> makeSsaoSamples(SsaoKernelKind kind, std::uint32_t seed, std::size_t pointsPerRay,
                                           std::span<glm::vec4> room);

/// Length of a ray's point, by the share `x` of the samples that are shorter. Article, Stratified, Songjihu: their
/// ladder. Crytek: cbrt x, as in a ball. LearnOpenGl: x², as dense near the surface as its own lengths but up to the
/// whole radius, which few of those reach.
double ssaoRayLength(SsaoKernelKind kind, double x);

/// The chunk `ssao-kernel`: the same samples as GLSL constants, exact to the bit.
std::string ssaoKernelChunk(std::span<const glm::vec4> samples);

}  // namespace crevice
