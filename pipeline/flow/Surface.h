// How a scene's glTF material becomes macros, property values and textures of an effect such as `standard`.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/Document.h"
#include "effect/Defines.h"
#include "scene/Scene.h"

namespace crevice {

/// What an effect is given for one material on meshes of one kind.
struct SurfaceInputs {
    Defines defines;   ///< Offered: macros that the effect does not know are left out by the caller.
    Value properties;  ///< Likewise.
    std::vector<std::pair<std::string, TextureRef>> textures;  ///< Sampler name → texture of the scene.
};

SurfaceInputs surfaceInputs(const SceneMaterial& material, bool meshHasTangents);

}  // namespace crevice
