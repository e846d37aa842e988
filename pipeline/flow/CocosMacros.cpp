// What is switched on follows from what the frame fills: a map, a cube, fog.
#include "flow/CocosMacros.h"

#include <fmt/format.h>

#include <algorithm>

#include "flow/CocosShadow.h"
#include "flow/ShadowView.h"

namespace crevice {
namespace {

std::string textOf(const Value& object, const char* key, const char* otherwise) {
    const Value* value = object.isObject() ? object.find(key) : nullptr;
    return value && value->isString() ? value->string() : otherwise;
}

template <class Match>
const StageDesc* findStage(const PipelineDesc& desc, Match&& matches) {
    for (const FlowDesc& flow : desc.flows)
        for (const StageDesc& stage : flow.stages)
            if (matches(stage)) return &stage;
    return nullptr;
}

std::string pcfOf(const PipelineDesc& desc, const Scene& scene) {
    const Light* main = mainLight(scene);
    if (main && main->shadow) return std::to_string(std::clamp(main->shadow->pcf, 0, 3));
    return std::to_string(shadowSettings(desc, false, glm::uvec2(1)).pcf);
}

const char* fogNumber(FogType type) {
    switch (type) {
        case FogType::None:
            break;
        case FogType::Linear:
            return "0";
        case FogType::Exp:
            return "1";
        case FogType::Exp2:
            return "2";
        case FogType::Layered:
            return "3";
    }
    return "4";
}

void addScene(const PipelineDesc& desc, const Scene& scene, Defines& macros) {
    macros["CC_USE_FOG"] = fogNumber(scene.fog.type);
    macros["SKY_ENVIRONMENT"] = scene.environment && scene.environment->visible ? "1" : "0";
    if (litByEnvironment(scene)) {
        macros["CC_USE_IBL"] = macros["CC_IBL_CONVOLUTED"] = "1";
        if (desc.profile == Profile::Cocos36) macros["CC_USE_DIFFUSEMAP"] = "1";
    }
    const bool directional = drawsShadows(desc, "directional"), spot = drawsShadows(desc, "spot");
    if (!directional && !spot) return;
    macros["CC_RECEIVE_SHADOW"] = "1";
    macros["CC_SHADOW_TYPE"] = "2";
    if (!directional) return;
    macros["CC_DIR_LIGHT_SHADOW_TYPE"] = "1";
    macros["CC_DIR_SHADOW_PCF_TYPE"] = pcfOf(desc, scene);
}

}  // namespace

std::string defineText(const Value& value, const std::string& name) {
    if (value.isBool()) return value.boolean() ? "1" : "0";
    if (value.isInteger()) return std::to_string(value.integer());
    if (value.isString()) return value.string();
    throw Error(value.where(),
                fmt::format("define '{}' must be a bool, an integer or a word, found {}", name, value.typeName()),
                "write true, false, 3 or \"word\"");
}

const StageDesc* shadowStage(const PipelineDesc& desc, std::string_view light) {
    return findStage(desc, [&](const StageDesc& stage) {
        return stage.stageClass == "ShadowStage" && stage.enabled &&
               textOf(stage.params, "light", "directional") == light;
    });
}

bool cocosHdr(const PipelineDesc& desc) {
    const Value* macro = desc.macros.isObject() ? desc.macros.find("CC_USE_HDR") : nullptr;
    if (!macro) return desc.profile == Profile::Cocos36;
    if (macro->isBool()) return macro->boolean();
    return macro->isNumber() ? macro->number() != 0 : macro->isString() && macro->string() != "0";
}

std::string_view shadowMapName(Profile profile, bool spot) {
    if (!spot) return "cc_shadowMap";
    return profile == Profile::Cocos36 ? "cc_spotShadowMap" : "cc_spotLightingMap";
}

bool drawsShadows(const PipelineDesc& desc, std::string_view light) {
    return shadowStage(desc, light) && desc.findTarget(shadowMapName(desc.profile, light == "spot"));
}

Defines pipelineMacros(const PipelineDesc& desc, const Scene* scene) {
    const bool deferred =
        findStage(desc, [](const StageDesc& stage) { return stage.stageClass == "GbufferStage"; }) != nullptr;
    Defines macros{{"CC_PIPELINE_TYPE", deferred ? "1" : "0"},
                   {"CC_USE_HDR", cocosHdr(desc) ? "1" : "0"},
                   {"CC_USE_FOG", "4"},
                   {"CC_USE_IBL", "0"},
                   {"CC_RECEIVE_SHADOW", "0"},
                   {"CC_SHADOW_TYPE", "0"}};
    if (scene) addScene(desc, *scene, macros);
    if (desc.macros.isObject())
        for (const Member& member : desc.macros.members()) macros[member.key] = defineText(member.value, member.key);
    return macros;
}

}  // namespace crevice
