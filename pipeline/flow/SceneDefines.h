// Macros that every effect is offered because of the scene: what it does not have costs nothing.
#pragma once

#include <string_view>

#include "effect/Defines.h"
#include "scene/Scene.h"

namespace crevice {

/// Shadow maps that some enabled stage of a pipeline fills.
struct ShadowMaps {
    bool main = false;  ///< CCShadow, of the main light.
    bool spot = false;  ///< CCSpotShadow.
};

/// `CC_USE_IBL`: there is an environment to light with. `SKY_ENVIRONMENT`: it is also the background. `CC_MAIN_SHADOW`:
/// the main light casts a shadow. `CC_LIGHTS`: 0 none but the main one, 1 more, 2 and one of them with a shadow map.
/// `CC_FOG`. Null: no scene; all that a scene may have, but for environments.
Defines sceneDefines(const Scene* scene, ShadowMaps maps);

/// True of targets that effects read only for scenes that need them.
bool isReadForSomeScenes(std::string_view target);

}  // namespace crevice
