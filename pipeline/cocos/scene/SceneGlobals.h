// Internal to the scene importer: what belongs to the whole scene.
#pragma once

#include <optional>

#include "cocos/assets/ObjectGraph.h"
#include "scene/Scene.h"

namespace crevice::cocos {

/// Without HDR the LDR strengths divided by `exposure`, so that the product is the same.
Ambient readAmbient(const Value& info, bool hdr, double exposure, Problems& problems);
/// What the ambient light's sky is scaled by, lux.
double readSkyIlluminance(const Value& info, bool hdr, double exposure, Problems& problems);

/// Cocos' fog colours are exposed; ours are divided by the exposure.
Fog readFog(const Value& info, double exposure, Problems& problems);

/// cc.ShadowsInfo.
struct ImportedShadows {
    bool maps = false;                  ///< Shadows are on, and are maps.
    bool planar = false;                ///< They are on, and are flattened onto a plane.
    std::optional<LightShadow> look{};  ///< Up to 3.3 lights have none of their own.
    glm::uvec2 size{0};                 ///< Texels of the map; 0 = it is not said.
};
ImportedShadows readShadows(const Value& info, Problems& problems);

/// cc.SkyboxInfo.
struct ImportedSky {
    bool enabled = false;
    bool lights = false;     ///< Its picture lights (_envLightingType, _useIBL); without, the ambient light alone.
    bool ownEffect = false;  ///< A material of the user's draws it.
    AssetRef picture{};      ///< Of the half that HDR or its absence asks for.
    double rotation = 0;     ///< Degrees about y.
};
ImportedSky readSkybox(const Value& info, bool hdr, Problems& problems);

}  // namespace crevice::cocos
