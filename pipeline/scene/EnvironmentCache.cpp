// Blurred cubes on disk, named by the content of the panorama.
#include <span>
#include <string>
#include <utility>

#include "core/CacheFile.h"
#include "core/Files.h"
#include "scene/CubeFaces.h"
#include "scene/EnvironmentCube.h"

namespace crevice {
namespace {

constexpr std::string_view kMagic = "CREVICE ENVIRONMENT 1\n";  // raised whenever the filter gives other texels

/// A cube of the right shape, without content.
EnvironmentCube emptyCube(std::uint32_t size) {
    EnvironmentCube cube{.size = size, .levels = {}, .brdf = Image(kBrdfTableSize, kBrdfTableSize, Format::RG16F)};
    for (std::uint32_t side = size; side >= kLastCubeSize; side /= 2)
        cube.levels.emplace_back(kCubeFaces, Image(side, side, Format::RGBA16F));
    return cube;
}

template <class Byte, class Cube>
std::vector<std::span<Byte>> arraysOf(Cube& cube) {
    std::vector<std::span<Byte>> arrays;
    for (auto& level : cube.levels)
        for (auto& face : level) arrays.emplace_back(face.pixels);
    arrays.emplace_back(cube.brdf.pixels);
    return arrays;
}

}  // namespace

std::string environmentKey(const Image& equirect) {
    std::string text(kMagic);
    text += std::to_string(equirect.width) + " " + std::to_string(kMinCubeSize) + " " + std::to_string(kMaxCubeSize) +
            " " + std::to_string(kLastCubeSize) + " ";
    text += contentHash({reinterpret_cast<const char*>(equirect.pixels.data()), equirect.pixels.size()});
    return contentHash(text);
}

std::shared_ptr<const EnvironmentCube> cachedEnvironmentCube(const Image& equirect,
                                                             const std::optional<std::filesystem::path>& cache) {
    if (!cache) return std::make_shared<EnvironmentCube>(filterEnvironment(equirect));
    const std::filesystem::path file = *cache / (environmentKey(equirect) + ".cube");
    auto cube = std::make_shared<EnvironmentCube>(emptyCube(cubeSizeFor(equirect.width)));
    if (loadArrays(file, kMagic, arraysOf<std::byte>(*cube))) return cube;
    *cube = filterEnvironment(equirect);
    storeArrays(file, kMagic, arraysOf<const std::byte>(std::as_const(*cube)));
    return cube;
}

}  // namespace crevice
