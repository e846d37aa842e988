// Names of fields changed between versions: the newer one counts.
#include "cocos/scene/SceneGlobals.h"

#include <algorithm>

#include "cocos/scene/SceneComponents.h"

namespace crevice::cocos {
namespace {

constexpr std::int64_t kShadowMaps = 1;  // ShadowType; 0 is planar
constexpr double kUsualAttenuation = 5;
constexpr float kOwnAttenuation = 4;  // with it Cocos' exponents are density x distance, as ours are

}  // namespace

double readSkyIlluminance(const Value& info, bool hdr, double exposure, Problems& problems) {
    const FieldReader fields(info, problems);
    return hdr ? fields.number(fields.firstOf({"_skyIllumHDR", "_skyIllum"}), 20000)
               : fields.number("_skyIllumLDR", 0.5208) / exposure;
}

Ambient readAmbient(const Value& info, bool hdr, double exposure, Problems& problems) {
    const FieldReader fields(info, problems);
    const glm::vec4 sky(0.2f, 0.5f, 0.8f, 1), ground(0.2f, 0.2f, 0.2f, 1);
    const auto strength = float(readSkyIlluminance(info, hdr, exposure, problems));
    const auto color = [&](std::string_view key, const glm::vec4& otherwise) {
        return glm::vec3(readVector(info, key, otherwise, problems)) * strength;
    };
    if (!hdr) return {color("_skyColorLDR", sky), color("_groundAlbedoLDR", ground)};
    return {color(fields.firstOf({"_skyColorHDR", "_skyColor"}), sky),
            color(fields.firstOf({"_groundAlbedoHDR", "_groundAlbedo"}), ground)};
}

Fog readFog(const Value& info, double exposure, Problems& problems) {
    const FieldReader fields(info, problems);
    Fog fog;
    if (!fields.boolean("_enabled", false)) return fog;
    constexpr FogType kTypes[] = {FogType::Linear, FogType::Exp, FogType::Exp2, FogType::Layered};
    const std::int64_t type = fields.integer("_type", 0);
    if (type < 0 || type >= std::ssize(kTypes)) return fog;  // 4 is FOG_TYPE_NONE of old scenes
    fog.type = kTypes[type];
    // The engine squares colours where it makes them linear.
    const glm::vec3 color(readVector(info, "_fogColor", {0.78f, 0.78f, 0.78f, 1}, problems));
    fog.color = color * color / float(exposure);
    fog.start = float(fields.number("_fogStart", 0.5));
    fog.end = float(fields.number("_fogEnd", 300));
    fog.density = float(fields.number("_fogDensity", 0.3));
    fog.top = float(fields.number("_fogTop", 1.5));
    fog.range = float(fields.number("_fogRange", 1.2));
    fog.attenuation = float(std::max(fields.number("_fogAtten", kUsualAttenuation), 1e-3));
    if (fog.type == FogType::Exp || fog.type == FogType::Exp2) {
        fog.density *= kOwnAttenuation / fog.attenuation;
        fog.attenuation = kOwnAttenuation;
    }
    return fog;
}

ImportedShadows readShadows(const Value& info, Problems& problems) {
    const FieldReader fields(info, problems);
    ImportedShadows out;
    if (!fields.boolean("_enabled", false)) return out;
    out.maps = fields.integer("_type", 0) == kShadowMaps;
    out.planar = !out.maps;
    constexpr float kLargest = 8192;
    const std::string_view key = fields.firstOf({"_size", "_shadowMapSize"});
    const Value* written = fields.find(key);
    if (written && written->isObject()) {  // early versions have one number for lists of sizes
        const glm::vec4 size = readVector(info, key, glm::vec4(0), problems);
        if (size.x >= 1 && size.y >= 1 && size.x <= kLargest && size.y <= kLargest) out.size = glm::uvec2(size);
    }
    if (!fields.find("_bias") && !fields.find("_pcf")) return out;
    const LightShadow usual;
    out.look = LightShadow{.bias = float(fields.number("_bias", double(usual.bias))),
                           .normalBias = float(fields.number("_normalBias", 0)),
                           .pcf = int(std::clamp<std::int64_t>(fields.integer("_pcf", 0), 0, 3)),
                           .saturation = float(std::clamp(fields.number("_saturation", 1), 0.0, 1.0))};
    return out;
}

ImportedSky readSkybox(const Value& info, bool hdr, Problems& problems) {
    const FieldReader fields(info, problems);
    ImportedSky sky;
    sky.enabled = fields.boolean("_enabled", false);
    sky.lights = fields.integer("_envLightingType", fields.boolean("_useIBL", false) ? 1 : 0) != 0;
    sky.picture = fields.asset(fields.firstOf({hdr ? "_envmapHDR" : "_envmapLDR", "_envmap"}));
    const Value* material = fields.find(fields.firstOf({"_editableMaterial", "_skyboxMaterial"}));
    sky.ownEffect = material && !material->isNull();
    sky.rotation = fields.number("_rotationAngle", 0);
    return sky;
}

}  // namespace crevice::cocos
