// Counts the lights as flow/FrameData.h packs them, and looks for shadows as flow/ShadowView.h does.
#include "flow/SceneDefines.h"

#include "flow/ShadowView.h"

namespace crevice {
namespace {

std::string lightsMacro(const Scene& scene, ShadowMaps maps) {
    const Light* main = mainLight(scene);
    bool any = false, shadowed = false;
    for (const Light& light : scene.lights) {
        if (&light == main) continue;
        any = true;
        shadowed = shadowed || (maps.spot && light.type == LightType::Spot && light.castsShadow);
    }
    return shadowed ? "2" : any ? "1" : "0";
}

}  // namespace

Defines sceneDefines(const Scene* scene, ShadowMaps maps) {
    if (!scene)
        return {{"CC_USE_IBL", "0"},
                {"SKY_ENVIRONMENT", "0"},
                {"CC_MAIN_SHADOW", "1"},
                {"CC_LIGHTS", "2"},
                {"CC_FOG", "1"}};
    const auto text = [](bool value) { return std::string(value ? "1" : "0"); };
    const Light* main = mainLight(*scene);
    return {{"CC_USE_IBL", text(litByEnvironment(*scene))},
            {"SKY_ENVIRONMENT", text(scene->environment && scene->environment->visible)},
            {"CC_MAIN_SHADOW", text(maps.main && main && main->castsShadow)},
            {"CC_LIGHTS", lightsMacro(*scene, maps)},
            {"CC_FOG", text(scene->fog.type != FogType::None)}};
}

bool isReadForSomeScenes(std::string_view target) { return target == "cc_shadowMap" || target == "cc_spotLightingMap"; }

}  // namespace crevice
