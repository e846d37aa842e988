// Every texel of the panorama looks up its direction in the cube.
#include "cocos/scene/SkyFaces.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/Error.h"
#include "scene/CubeFaces.h"
#include "scene/Environment.h"

namespace crevice::cocos {
namespace {

constexpr std::array<const char*, 6> kFaceNames = {"right", "left", "top", "bottom", "front", "back"};

constexpr FaceLayout kLayouts[] = {
    {3, 4, {{{1, 1}, {1, 3}, {1, 0}, {1, 2}, {0, 1}, {2, 1}}}},
    {4, 3, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}}},
    {6, 1, {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}}},
    {1, 6, {{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}}},
};

}  // namespace

std::optional<FaceLayout> faceLayout(std::uint64_t width, std::uint64_t height) {
    for (const FaceLayout& layout : kLayouts) {
        const std::uint64_t side = width / layout.columns;
        if (side > 0 && side * layout.columns == width && side * layout.rows == height) return layout;
    }
    return std::nullopt;
}

std::array<Image, 6> cutFaces(const Image& picture, const FaceLayout& layout) {
    const std::uint32_t side = picture.width / layout.columns;
    std::array<Image, 6> faces;
    for (std::size_t i = 0; i < faces.size(); ++i)
        faces[i] = cropped(picture, {layout.places[i][0] * side, layout.places[i][1] * side}, {side, side});
    return faces;
}

Image panoramaOfFaces(const std::array<Image, 6>& faces) {
    const std::uint32_t side = faces.front().width;
    CubeLevel cube(side);
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) cube.at(face, int(x), int(y)) = faces[face].at(x, y);
    cube.fillBorder();
    Image panorama(4 * side, 2 * side, Format::RGBA32F);
    for (std::uint32_t y = 0; y < panorama.height; ++y) {
        auto* row = reinterpret_cast<glm::vec4*>(panorama.pixel(0, y));
        for (std::uint32_t x = 0; x < panorama.width; ++x) {
            const glm::vec3 direction(equirectDirection(x, y, panorama.width, panorama.height));
            row[x] = glm::vec4(glm::vec3(cube.sample(cubePoint(direction))), 1);
        }
    }
    return panorama;
}

std::optional<std::array<const MetaAsset*, 6>> facesOf(const MetaAsset& cube, const MetaIndex& metas) {
    if (!cube.userData.isObject()) return std::nullopt;
    std::array<const MetaAsset*, 6> faces{};
    std::size_t named = 0;
    for (const char* name : kFaceNames) named += cube.userData.find(name) != nullptr;
    if (named == 0) return std::nullopt;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const Value* uuid = cube.userData.find(kFaceNames[i]);
        if (uuid && uuid->isString()) faces[i] = metas.findNearest(uuid->string());
        if (faces[i]) continue;
        throw Error(
            uuid ? uuid->where() : cube.userData.where(),
            fmt::format("face '{}' of '{}' is no picture of the project", kFaceNames[i], cube.path.filename().string()),
            "name the uuid of a picture in its meta");
    }
    return faces;
}

}  // namespace crevice::cocos
