// A .scene (or .prefab) of Cocos Creator as one of our scenes: cameras, lights, mesh renderers, ambient light and fog.
#pragma once

#include <filesystem>
#include <optional>

#include "cocos/assets/Project.h"
#include "cocos/scene/SceneMaterials.h"
#include "scene/GltfLoader.h"
#include "scene/Scene.h"

namespace crevice::cocos {

struct ImportedScene {
    Scene scene{};
    std::optional<glm::vec4> background{};  ///< Clear colour of the first camera, where it clears colour.
    std::optional<glm::uvec2> shadowMap{};  ///< Texels of the maps, where shadows are maps and the scene says them.
};

/// Units: illuminance in lux, candela = luminance x pi x size² for sphere and spot lights, exposure from aperture,
/// shutter and ISO of the first camera. What is not read is one note a kind. Errors are collected, each once: the scene
/// is to be used only when there are none.
ImportedScene importScene(const std::filesystem::path& path, Project& project, MaterialForm form,
                          const LoadOptions& options, Problems& problems);

}  // namespace crevice::cocos
