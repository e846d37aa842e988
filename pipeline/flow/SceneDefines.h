// Macros that every effect is offered because of the scene: what it does not have costs nothing.
#pragma once

#include "effect/Defines.h"
#include "scene/Scene.h"

namespace crevice {

/// `CC_USE_IBL`: there is an environment to light with. `SKY_ENVIRONMENT`: it is also the background. Null: no scene.
inline Defines sceneDefines(const Scene* scene) {
    const bool lights = scene && scene->environment;
    return {{"CC_USE_IBL", lights ? "1" : "0"}, {"SKY_ENVIRONMENT", lights && scene->environment->visible ? "1" : "0"}};
}

}  // namespace crevice
