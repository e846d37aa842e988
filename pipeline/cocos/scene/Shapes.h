// The built-in meshes of Cocos' internal database, made here in the sizes that Cocos documents.
#pragma once

#include <optional>
#include <string_view>

#include "scene/Scene.h"

namespace crevice::cocos {

/// The asset that holds them, internal/primitives.fbx.
inline constexpr std::string_view kPrimitivesUuid = "1263d74c-8167-4928-91a6-4e2672411f47";

/// box 1x1x1; sphere, radius 0.5; capsule, radius 0.5, height 2; cylinder, radius 0.5, height 2; cone, radius 0.5,
/// height 1; torus in the xz plane, radius 0.4, tube 0.1; plane 10x10, facing +y; quad 1x1, facing +z. Texture
/// coordinates span 0 to 1 once over each shape (each side of the box). Nothing for another name.
std::optional<Mesh> makeShape(std::string_view name);

/// "sphere" for the sub-asset id "17020"; "" for ids that are none of its meshes.
std::string_view shapeName(std::string_view subId);

}  // namespace crevice::cocos
