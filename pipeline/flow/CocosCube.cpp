// Resamples the blurred cube: Cocos spends its levels evenly on roughness, and its shaders know no rotation.
#include "flow/CocosCube.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/Format.h"
#include "scene/CubeFaces.h"

namespace crevice {
namespace {

constexpr std::uint32_t kDiffuseSize = 16;
constexpr float kLargestHalf = 65504.0f;

CubeLevel decoded(const std::vector<Image>& faces) {
    CubeLevel level(faces[0].width);
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        for (std::uint32_t y = 0; y < level.size(); ++y)
            for (std::uint32_t x = 0; x < level.size(); ++x) level.at(face, int(x), int(y)) = faces[face].at(x, y);
    level.fillBorder();
    return level;
}

/// Faces whose texels are `radiance` of their directions, as square roots.
template <class Radiance>
std::vector<Image> encoded(std::uint32_t size, Radiance&& radiance) {
    std::vector<Image> faces;
    for (std::uint32_t face = 0; face < kCubeFaces; ++face) {
        Image image(size, size, Format::RGBA16F);
        for (std::uint32_t y = 0; y < size; ++y) {
            for (std::uint32_t x = 0; x < size; ++x) {
                const glm::vec3 direction =
                    glm::normalize(cubeDirection(face, cubeCoordinate(float(x), size), cubeCoordinate(float(y), size)));
                const glm::vec3 root = glm::sqrt(glm::max(radiance(direction), glm::vec3(0)));
                const std::uint64_t halves = glm::packHalf4x16(glm::vec4(glm::min(root, glm::vec3(kLargestHalf)), 1));
                std::memcpy(image.pixels.data() + (std::size_t(y) * size + x) * sizeof halves, &halves, sizeof halves);
            }
        }
        faces.push_back(std::move(image));
    }
    return faces;
}

}  // namespace

CocosCubes cocosCubes(const Environment& environment, const EnvironmentCube& cube, float scale) {
    std::vector<CubeLevel> levels;
    for (const std::vector<Image>& faces : cube.levels) levels.push_back(decoded(faces));
    const float c = std::cos(environment.rotation), s = std::sin(environment.rotation);
    const float factor = environment.intensity / scale;
    const float last = static_cast<float>(levels.size() - 1);
    CocosCubes out;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const float from = last > 0 ? environmentLevel(float(l) / last) * last : 0;
        const auto low = std::min(static_cast<std::size_t>(from), levels.size() - 1);
        const std::size_t high = std::min(low + 1, levels.size() - 1);
        const float share = from - static_cast<float>(low);
        out.mirrored.push_back(encoded(levels[l].size(), [&](const glm::vec3& d) {
            const CubePoint point = cubePoint({c * d.x - s * d.z, d.y, s * d.x + c * d.z});
            return glm::vec3(glm::mix(levels[low].sample(point), levels[high].sample(point), share)) * factor;
        }));
    }
    out.diffuse.push_back(encoded(kDiffuseSize, [&](const glm::vec3& d) { return environment.diffuse(d) / scale; }));
    return out;
}

}  // namespace crevice
