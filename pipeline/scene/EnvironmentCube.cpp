// From a panorama to blurred cube levels: shrink, project, importance-sample GGX with filtered samples.
#include "scene/EnvironmentCube.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

#include <glm/gtc/packing.hpp>

#include "core/Parallel.h"
#include "scene/CubeFaces.h"
#include "scene/GgxSampling.h"

namespace crevice {
namespace {

constexpr float kPi = 3.14159265358979f;
constexpr float kLargestHalf = 65504.0f;
// Samples of level 1; each further level has four times fewer texels and gets twice as many.
constexpr std::uint32_t kFirstSamples = 64;
// Added to a sample's level: more hides that samples are few, and blurs.
constexpr float kLevelBias = 0.5f;

/// The source cells that a target cell covers, and the share of each; shares sum to 1.
struct Overlap {
    std::uint32_t first = 0;
    std::vector<double> weights;
};

/// Cell `target` of `to` equal ones over `from` equal ones. `edge` is the ascending measure of a place from 0 to 1.
template <class Edge>
Overlap overlapOf(std::uint32_t target, std::uint32_t to, std::uint32_t from, Edge edge) {
    Overlap overlap;
    overlap.first = static_cast<std::uint32_t>(std::uint64_t(target) * from / to);
    const auto end = static_cast<std::uint32_t>((std::uint64_t(target + 1) * from + to - 1) / to);
    const double begins = double(target) / to, ends = double(target + 1) / to;
    double total = 0;
    for (std::uint32_t i = overlap.first; i < end; ++i) {
        const double share = edge(std::min(double(i + 1) / from, ends)) - edge(std::max(double(i) / from, begins));
        overlap.weights.push_back(share);
        total += share;
    }
    for (double& weight : overlap.weights) weight /= total;
    return overlap;
}

/// A smaller panorama that keeps the light of every part of the sphere: texels are weighted by solid angle.
Image shrunk(const Image& source, std::uint32_t width, unsigned threads) {
    const std::uint32_t height = width / 2;
    std::vector<Overlap> columns;
    for (std::uint32_t x = 0; x < width; ++x)
        columns.push_back(overlapOf(x, width, source.width, [](double place) { return place; }));
    Image result(width, height, Format::RGBA32F);
    forEachRow(height, threads, [&](std::uint32_t y) {
        const Overlap rows =
            overlapOf(y, height, source.height, [](double place) { return -std::cos(double(kPi) * place); });
        auto* out = reinterpret_cast<glm::vec4*>(result.pixel(0, y));
        for (std::uint32_t x = 0; x < width; ++x) {
            glm::dvec4 sum(0);
            for (std::size_t j = 0; j < rows.weights.size(); ++j) {
                const auto* in = reinterpret_cast<const glm::vec4*>(
                    source.pixel(columns[x].first, rows.first + static_cast<std::uint32_t>(j)));
                for (std::size_t i = 0; i < columns[x].weights.size(); ++i)
                    sum += glm::dvec4(in[i]) * (rows.weights[j] * columns[x].weights[i]);
            }
            out[x] = glm::vec4(sum);
        }
    });
    return result;
}

/// Places along each side of a cube texel that are looked up: as many as see every texel of a panorama `density` times
/// as fine at the equator; at the poles its columns draw near.
int placesFor(const glm::vec3& direction, float density) {
    constexpr float kLeastSine = 1.0f / 16;
    const float sine = std::hypot(direction.x, direction.z) / glm::length(direction);
    return std::clamp(static_cast<int>(std::ceil(2 * density / std::max(sine, kLeastSine))), 2, 32);
}

CubeLevel project(const Image& equirect, std::uint32_t size, unsigned threads) {
    CubeLevel level(size);
    const float density = static_cast<float>(equirect.width) / static_cast<float>(4 * size);
    forEachRow(kCubeFaces * size, threads, [&](std::uint32_t row) {
        const std::uint32_t face = row / size, y = row % size;
        for (std::uint32_t x = 0; x < size; ++x) {
            const auto place = [&](float right, float down) {
                return cubeDirection(face, cubeCoordinate(static_cast<float>(x) + right, size),
                                     cubeCoordinate(static_cast<float>(y) + down, size));
            };
            const int places = placesFor(place(0, 0), density);
            const auto offset = [&](int i) {
                return (static_cast<float>(i) + 0.5f) / static_cast<float>(places) - 0.5f;
            };
            glm::vec3 sum(0);
            for (int i = 0; i < places; ++i)
                for (int j = 0; j < places; ++j) sum += sampleEquirect(equirect, place(offset(j), offset(i)));
            level.at(face, static_cast<int>(x), static_cast<int>(y)) =
                glm::vec4(sum / static_cast<float>(places * places), 1);
        }
    });
    level.fillBorder();
    return level;
}

/// A direction that a surface with normal z mirrors to a viewer above it, with its weight and the level at which one
/// texel covers what one sample stands for.
struct LobeSample {
    glm::vec3 toLight{0, 0, 1};
    float weight = 0;
    std::uint32_t level = 0;  ///< The finer of two.
    float next = 0;           ///< Share of the coarser.
};

/// J. Křivánek, M. Colbert, "Real-time Shading with Filtered Importance Sampling", 2008: level = 1/2 log2 of the
/// sample's solid angle over a texel's, and a bias.
std::vector<LobeSample> lobeOf(float roughness, std::uint32_t count, const std::vector<CubeLevel>& source) {
    const float alpha = roughness * roughness;
    const float texelAngle = 4 * kPi / static_cast<float>(kCubeFaces * source[0].size() * source[0].size());
    std::vector<LobeSample> lobe;
    float total = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 half = sampleGgxHalf(hammersley(i, count), alpha);
        // Normal, viewer and mirrored direction are taken as one, as the split sum does.
        const glm::vec3 toLight(2 * half.z * half.x, 2 * half.z * half.y, 2 * half.z * half.z - 1);
        if (toLight.z <= 0) continue;
        const float density = ggxDensity(alpha, half.z) / 4;  // of toLight, per steradian
        const float level = 0.5f * std::log2(1 / (static_cast<float>(count) * density * texelAngle)) + kLevelBias;
        const float clamped = std::clamp(level, 0.0f, static_cast<float>(source.size() - 1));
        const auto finer = std::min(static_cast<std::uint32_t>(clamped), static_cast<std::uint32_t>(source.size() - 2));
        lobe.push_back({toLight, toLight.z, finer, clamped - static_cast<float>(finer)});
        total += toLight.z;
    }
    for (LobeSample& sample : lobe) sample.weight /= total;
    return lobe;
}

glm::vec4 gather(const std::vector<CubeLevel>& source, const std::vector<LobeSample>& lobe, const glm::vec3& normal) {
    const glm::mat3 frame = frameAround(normal);
    glm::vec4 sum(0);
    for (const LobeSample& sample : lobe) {
        const CubePoint point = cubePoint(frame * sample.toLight);
        const glm::vec4 finer = source[sample.level].sample(point), coarser = source[sample.level + 1].sample(point);
        sum += sample.weight * (finer + sample.next * (coarser - finer));
    }
    return sum;
}

void storeHalves(std::byte* pixel, const glm::vec4& color) {
    const glm::vec4 kept(glm::min(glm::vec3(color), glm::vec3(kLargestHalf)), 1);
    const std::uint64_t halves = glm::packHalf4x16(kept);
    std::memcpy(pixel, &halves, sizeof halves);
}

/// `texel(face, x, y)` for every texel of a level.
template <class Texel>
std::vector<Image> makeFaces(std::uint32_t size, unsigned threads, Texel texel) {
    std::vector<Image> faces(kCubeFaces, Image(size, size, Format::RGBA16F));
    forEachRow(kCubeFaces * size, threads, [&](std::uint32_t row) {
        const std::uint32_t face = row / size, y = row % size;
        for (std::uint32_t x = 0; x < size; ++x) storeHalves(faces[face].pixel(x, y), texel(face, x, y));
    });
    return faces;
}

}  // namespace

float environmentRoughness(float level) { return 1 - std::sqrt(std::max(1 - level, 0.0f)); }
float environmentLevel(float roughness) { return roughness * (2 - roughness); }

std::uint32_t cubeSizeFor(std::uint32_t panoramaWidth) {
    return std::clamp(std::bit_ceil(panoramaWidth / 4), kMinCubeSize, kMaxCubeSize);
}

EnvironmentCube filterEnvironment(const Image& equirect, unsigned threads) {
    assert(equirect.format == Format::RGBA32F && equirect.width == 2 * equirect.height);
    EnvironmentCube cube;
    cube.size = cubeSizeFor(equirect.width);
    cube.brdf = makeBrdfTable(threads);
    const bool shrinks = equirect.width > 4 * cube.size;
    std::vector<CubeLevel> source;
    source.push_back(project(shrinks ? shrunk(equirect, 4 * cube.size, threads) : equirect, cube.size, threads));
    while (source.back().size() > 1) source.push_back(halved(source.back()));

    const auto last = static_cast<std::uint32_t>(std::bit_width(cube.size / kLastCubeSize)) - 1;
    for (std::uint32_t level = 0; level <= last; ++level) {
        const std::uint32_t size = cube.size >> level;
        if (level == 0) {
            cube.levels.push_back(makeFaces(size, threads, [&](std::uint32_t face, std::uint32_t x, std::uint32_t y) {
                return source[0].at(face, static_cast<int>(x), static_cast<int>(y));
            }));
            continue;
        }
        const float roughness = environmentRoughness(static_cast<float>(level) / static_cast<float>(last));
        const std::vector<LobeSample> lobe = lobeOf(roughness, kFirstSamples << (level - 1), source);
        cube.levels.push_back(makeFaces(size, threads, [&](std::uint32_t face, std::uint32_t x, std::uint32_t y) {
            return gather(source, lobe,
                          glm::normalize(cubeDirection(face, cubeCoordinate(static_cast<float>(x), size),
                                                       cubeCoordinate(static_cast<float>(y), size))));
        }));
    }
    return cube;
}

}  // namespace crevice
