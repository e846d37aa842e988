// The kernels of SsaoStage: on the hemisphere, dense near the origin, spread for their count, the same for ever.
#include "stages/SsaoKernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace crevice {
namespace {

constexpr SsaoKernelKind kKinds[] = {SsaoKernelKind::Article, SsaoKernelKind::Stratified};
constexpr std::size_t kCounts[] = {1, 8, 16, 32, 64};
constexpr float kTwoPi = 6.2831853f;

std::vector<glm::vec4> kernelOf(SsaoKernelKind kind, std::uint32_t seed, std::size_t count) {
    std::vector<glm::vec4> samples(count, glm::vec4(99));
    makeSsaoKernel(kind, seed, samples);
    return samples;
}

std::vector<float> sortedLengths(const std::vector<glm::vec4>& samples) {
    std::vector<float> lengths;
    for (const glm::vec4& s : samples) lengths.push_back(glm::length(glm::vec3(s)));
    std::sort(lengths.begin(), lengths.end());
    return lengths;
}

/// FNV-1a of the samples' bytes.
std::uint64_t hashOf(const std::vector<glm::vec4>& samples) {
    std::uint64_t hash = 14695981039346656037ull;
    std::vector<unsigned char> bytes(samples.size() * sizeof(glm::vec4));
    std::memcpy(bytes.data(), samples.data(), bytes.size());
    for (unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ull;
    return hash;
}

/// Most and fewest samples in a cell when the directions are sorted into 4 x 4 cells of equal cosine-weighted area.
std::pair<int, int> cellCounts(const std::vector<glm::vec4>& samples) {
    std::array<int, 16> cells{};
    for (const glm::vec4& s : samples) {
        const glm::vec3 d = glm::normalize(glm::vec3(s));
        const float turn = std::atan2(d.y, d.x) / kTwoPi + 0.5f;
        const int u = std::min(3, static_cast<int>((d.x * d.x + d.y * d.y) * 4));
        const int v = std::min(3, static_cast<int>(turn * 4));
        ++cells[u * 4 + v];
    }
    const auto [fewest, most] = std::minmax_element(cells.begin(), cells.end());
    return {*fewest, *most};
}

/// Share of samples behind a wall at distance `k` (the largest sample may reach 1), averaged over turns about the
/// normal.
double behindWall(const std::vector<glm::vec4>& samples, float k) {
    constexpr int kTurns = 256;
    int behind = 0;
    for (int turn = 0; turn < kTurns; ++turn) {
        const float angle = kTwoPi * static_cast<float>(turn) / kTurns;
        for (const glm::vec4& s : samples) behind += s.x * std::cos(angle) + s.y * std::sin(angle) > k;
    }
    return behind / static_cast<double>(kTurns * samples.size());
}

TEST(SsaoKernel, SamplesLieInTheUnitHemisphere) {
    for (SsaoKernelKind kind : kKinds) {
        for (std::size_t count : kCounts) {
            for (std::uint32_t seed = 0; seed < 20; ++seed) {
                for (const glm::vec4& s : kernelOf(kind, seed, count)) {
                    ASSERT_GT(s.z, 0);
                    ASSERT_LE(glm::length(glm::vec3(s)), 1);
                    ASSERT_EQ(s.w, 0);
                }
            }
        }
    }
}

TEST(SsaoKernel, IsDenserNearTheOrigin) {
    for (SsaoKernelKind kind : kKinds) {
        for (std::size_t count : {8, 16, 32, 64}) {
            const std::vector<float> lengths = sortedLengths(kernelOf(kind, 1, count));
            EXPECT_LT(lengths[count / 2], 0.5f * lengths.back()) << count;
            EXPECT_GE(lengths.front(), 0.0999f) << count;
        }
    }
}

TEST(SsaoKernel, LadderIsMadeForTheCount) {
    const float of64 = sortedLengths(kernelOf(SsaoKernelKind::Stratified, 1, 64)).back();
    for (std::size_t count : {8, 16, 32})
        EXPECT_NEAR(sortedLengths(kernelOf(SsaoKernelKind::Stratified, 1, count)).back(), of64, 0.12f) << count;
    // The article's ladder ends at (n - 1) / n: .79 for eight samples, where the first eight of 64 would end at .11.
    EXPECT_GT(sortedLengths(kernelOf(SsaoKernelKind::Article, 1, 8)).back(), 0.78f);
    const std::vector<glm::vec4> all = kernelOf(SsaoKernelKind::Stratified, 1, 64);
    const std::vector<glm::vec4> few = kernelOf(SsaoKernelKind::Stratified, 1, 8);
    EXPECT_FALSE(std::equal(few.begin(), few.end(), all.begin()));
}

TEST(SsaoKernel, SeedDecidesEverything) {
    for (SsaoKernelKind kind : kKinds) {
        EXPECT_EQ(kernelOf(kind, 5, 64), kernelOf(kind, 5, 64));
        EXPECT_NE(kernelOf(kind, 5, 64), kernelOf(kind, 6, 64));
    }
}

TEST(SsaoKernel, BytesAreFrozen) {
    // Pictures made with a seed stay what they are: a change here is a change of every picture.
    EXPECT_EQ(hashOf(kernelOf(SsaoKernelKind::Article, 1, 64)), 11997948194581473241ull);
    EXPECT_EQ(hashOf(kernelOf(SsaoKernelKind::Article, 7, 16)), 13675107175192183325ull);
    EXPECT_EQ(hashOf(kernelOf(SsaoKernelKind::Stratified, 1, 64)), 2542186525031153928ull);
    EXPECT_EQ(hashOf(kernelOf(SsaoKernelKind::Stratified, 7, 16)), 4004063144296646336ull);
    EXPECT_EQ(hashOf(kernelOf(SsaoKernelKind::Crytek, 7, 64)), 3646443352606652630ull);
    EXPECT_EQ(hashOf(kernelOf(SsaoKernelKind::LearnOpenGl, 7, 64)), 18126837649639204673ull);
    EXPECT_EQ(hashOf(kernelOf(SsaoKernelKind::Songjihu, 7, 64)), 8072696973824854593ull);
    std::vector<glm::vec4> rays(32);
    makeSsaoRays(SsaoKernelKind::Article, 7, 8, rays);
    EXPECT_EQ(hashOf(rays), 7523578548423495265ull);
}

TEST(SsaoKernel, StratifiedDirectionsFillEveryCell) {
    int articleWorst = 0;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        // 64 directions in 16 cells of equal weight: 4 each, give or take 2.
        const auto [fewest, most] = cellCounts(kernelOf(SsaoKernelKind::Stratified, seed, 64));
        EXPECT_GE(fewest, 2) << seed;
        EXPECT_LE(most, 6) << seed;
        articleWorst = std::max(articleWorst, cellCounts(kernelOf(SsaoKernelKind::Article, seed, 64)).second);
    }
    EXPECT_GT(articleWorst, 8);
}

TEST(SsaoKernel, FewSamplesSeeTheWallThatManySee) {
    for (float k : {0.1f, 0.2f, 0.3f}) {
        const double of64 = behindWall(kernelOf(SsaoKernelKind::Stratified, 7, 64), k);
        EXPECT_GT(of64, 0.05);
        for (std::size_t count : {8, 16, 32})
            EXPECT_NEAR(behindWall(kernelOf(SsaoKernelKind::Stratified, 7, count), k), of64, 0.04)
                << count << " at " << k;
    }
}

TEST(SsaoKernel, BallIsFilledEvenly) {
    // Shares of a ball: below the middle plane 1/2, within r of the middle r³.
    int below = 0, inner = 0, all = 0;
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        for (const glm::vec4& s : kernelOf(SsaoKernelKind::Crytek, seed, 64)) {
            ASSERT_LE(glm::length(glm::vec3(s)), 1);
            below += s.z < 0, inner += glm::length(glm::vec3(s)) < 0.8f, ++all;
        }
    }
    EXPECT_NEAR(below / double(all), 0.5, 0.03);
    EXPECT_NEAR(inner / double(all), 0.512, 0.03);
}

TEST(SsaoKernel, LengthsFollowTheArticles) {
    // P(U (0.1 + 0.9 V²) > x) of the LearnOpenGL chapter; songjihu's ladder has no chance in it.
    constexpr std::pair<float, double> kLonger[] = {{0.1f, 0.584}, {0.2f, 0.357}, {0.3f, 0.236}, {0.5f, 0.097}};
    for (const auto& [length, share] : kLonger) {
        int longer = 0, all = 0;
        for (std::uint32_t seed = 0; seed < 80; ++seed)
            for (const glm::vec4& s : kernelOf(SsaoKernelKind::LearnOpenGl, seed, 64))
                longer += glm::length(glm::vec3(s)) > length, ++all;
        EXPECT_NEAR(longer / double(all), share, 0.02) << length;
    }
    const std::vector<glm::vec4> ladder = kernelOf(SsaoKernelKind::Songjihu, 3, 64);
    for (std::size_t i = 0; i < 64; ++i) {
        const float t = static_cast<float>(i) / 64;
        EXPECT_NEAR(glm::length(glm::vec3(ladder[i])), 0.01f + 0.99f * t * t, 1e-5f);
    }
}

TEST(SsaoKernel, RaysAreStraightLongAndCosineWeighted) {
    for (SsaoKernelKind kind : {SsaoKernelKind::Article, SsaoKernelKind::Crytek, SsaoKernelKind::LearnOpenGl}) {
        for (std::size_t perRay : {4, 8}) {
            std::vector<glm::vec4> samples(64, glm::vec4(99));
            makeSsaoRays(kind, 7, perRay, samples);
            double height = 0;
            float longest = 0;
            for (std::size_t first = 0; first < 64; first += perRay) {
                const glm::vec3 direction = glm::normalize(glm::vec3(samples[first + perRay - 1]));
                float before = 0;
                for (std::size_t i = first; i < first + perRay; ++i) {
                    const float length = glm::length(glm::vec3(samples[i]));
                    ASSERT_GT(samples[i].z, 0);
                    ASSERT_GT(length, before);
                    ASSERT_LE(length, 1);
                    if (length > 0.05f) {
                        ASSERT_GT(glm::dot(glm::vec3(samples[i]) / length, direction), 0.99999f);
                    }
                    before = length;
                }
                longest = std::max(longest, before);
                height += direction.z * static_cast<double>(perRay) / 64;
            }
            EXPECT_GT(longest, 0.9f);
            // Mean cosine of a cosine-weighted hemisphere: 2/3.
            EXPECT_NEAR(height, 2.0 / 3, 0.01);
        }
    }
}

TEST(SsaoKernel, ChunkHoldsEveryBit) {
    const std::vector<glm::vec4> samples = kernelOf(SsaoKernelKind::Stratified, 3, 16);
    const std::string chunk = ssaoKernelChunk(samples);
    EXPECT_EQ(chunk.rfind("const vec3 kSsaoKernel[16] = vec3[](", 0), 0u);
    std::size_t at = 0;
    for (const glm::vec4& s : samples) {
        at = chunk.find("  vec3(", at) + 7;
        float x = 0, y = 0, z = 0;
        ASSERT_EQ(std::sscanf(chunk.c_str() + at, "%f, %f, %f)", &x, &y, &z), 3);
        EXPECT_EQ(glm::vec3(x, y, z), glm::vec3(s));
    }
}

}  // namespace
}  // namespace crevice
