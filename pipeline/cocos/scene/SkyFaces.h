// Internal to the scene importer: skies that are six faces, in six pictures or in one.
#pragma once

#include <array>
#include <optional>

#include "cocos/files/MetaIndex.h"
#include "core/Image.h"
#include "core/Limits.h"

namespace crevice::cocos {

/// Where each face stands in a picture of all six: +X, -X, +Y, -Y, +Z, -Z, in faces from the upper left corner.
struct FaceLayout {
    std::uint32_t columns = 0, rows = 0;
    std::array<std::array<std::uint32_t, 2>, 6> places{};
};
/// That of a picture of this size: a cross (3 x 4, 4 x 3), a row (6 x 1) or a column (1 x 6); nothing for others.
/// Source: the table of the editor's importer of cube maps.
std::optional<FaceLayout> faceLayout(std::uint64_t width, std::uint64_t height);

/// Six squares of one size (RGBA32F, radiance) as a panorama of four times that width, as the environment takes it.
/// Faces are turned as graphics interfaces have them, which is how the engine looks them up.
Image panoramaOfFaces(const std::array<Image, 6>& faces);

/// The faces of a picture, each of `width / columns` texels a side.
std::array<Image, 6> cutFaces(const Image& picture, const FaceLayout& layout);

/// The six pictures of a cube map's meta (right, left, top, bottom, front, back), or nothing when it names none of
/// them. Throws Error naming a face that is missing.
std::optional<std::array<const MetaAsset*, 6>> facesOf(const MetaAsset& cube, const MetaIndex& metas);

}  // namespace crevice::cocos
