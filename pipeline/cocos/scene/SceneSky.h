// Internal to the scene importer: the picture of a sky as our environment.
#pragma once

#include <filesystem>

#include "cocos/assets/Project.h"
#include "core/Limits.h"
#include "core/Log.h"
#include "scene/Environment.h"

namespace crevice::cocos {

/// Whether its ending is one of those that readSky() knows.
bool isPanorama(const std::filesystem::path& path);

/// Whether it is a sky's picture, or a cube map of six pictures.
bool isSky(const MetaAsset& asset);

/// A panorama, twice as wide as high: .hdr and .exr hold radiance; the eight bits of .png, .jpg and .webp are squared,
/// as the engine does; where the meta says `isRGBE`, they are a mantissa each, and alpha is 128 more than the power
/// of 1.1 that they are times. A cross, row or column of six
/// faces, and a cube map whose meta names six pictures, become a panorama. Throws Error: no such picture, another
/// shape, more than `limits` allow.
Environment readSky(const MetaAsset& asset, const MetaIndex& metas, const Log& log, const Limits& limits);

}  // namespace crevice::cocos
