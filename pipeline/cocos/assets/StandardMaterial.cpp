// Names are those of the effect's properties from 3.0 to 3.8; a name that one version lacks is left out later.
#include "cocos/assets/StandardMaterial.h"

#include <charconv>

#include <fmt/format.h>

namespace crevice::cocos {
namespace {

constexpr const char* kScenePrefix = "scene:";

TypedValue number(double value) {
    TypedValue typed;
    typed.kind = TypedValue::Kind::Number;
    typed.plain = Value::makeNumber(value);
    return typed;
}

TypedValue numbers(std::initializer_list<float> values) {
    TypedValue typed;
    typed.kind = TypedValue::Kind::Numbers;
    typed.plain = Value::makeArray();
    for (const float value : values) typed.plain.items().push_back(Value::makeNumber(value));
    return typed;
}

TypedValue texture(const TextureRef& ref) {
    TypedValue typed;
    typed.kind = TypedValue::Kind::Asset;
    typed.asset.uuid = kScenePrefix + std::to_string(ref.texture);
    return typed;
}

/// Collects one pass.
struct PassWriter {
    MtlPass pass{.defines = Value::makeObject(), .states = Value::makeObject()};

    void define(const char* name) { pass.defines.set(name, Value::makeBool(true)); }
    void set(const char* name, TypedValue value) { pass.properties.push_back({name, std::move(value), {}}); }
    /// A texture with its macro and its set of coordinates.
    void map(const TextureRef& ref, const char* property, const char* macro, const char* uvMacro) {
        if (!ref) return;
        define(macro);
        set(property, texture(ref));
        if (ref.texcoord == 0) return;
        pass.defines.set(uvMacro, Value::makeString("v_uv1"));
        define("HAS_SECOND_UV");
    }
};

const MtlProperty* findProperty(const Mtl& mtl, std::string_view name) {
    for (const MtlPass& pass : mtl.passes)
        for (const MtlProperty& property : pass.properties)
            if (property.name == name) return &property;
    return nullptr;
}

float numberOf(const Mtl& mtl, std::string_view name, float otherwise) {
    const MtlProperty* property = findProperty(mtl, name);
    return property && property->value.kind == TypedValue::Kind::Number ? float(property->value.plain.number())
                                                                        : otherwise;
}

glm::vec4 colorOf(const Mtl& mtl, std::string_view name, glm::vec4 otherwise) {
    const MtlProperty* property = findProperty(mtl, name);
    if (!property || property->value.kind != TypedValue::Kind::Numbers) return otherwise;
    const std::vector<Value>& items = property->value.plain.items();
    for (std::size_t i = 0; i < items.size() && i < 4; ++i) otherwise[int(i)] = float(items[i].number());
    return otherwise;
}

bool hasDefine(const Mtl& mtl, std::string_view name) {
    for (const MtlPass& pass : mtl.passes) {
        const Value* value = pass.defines.isObject() ? pass.defines.find(name) : nullptr;
        if (value && value->isBool() && value->boolean()) return true;
    }
    return false;
}

std::size_t transparentTechnique(const EffectAsset& standard) {
    for (std::size_t i = 0; i < standard.techniques.size(); ++i) {
        if (standard.techniques[i].name == "transparent") return i;
    }
    return standard.techniques.size() > 1 ? 1 : 0;
}

}  // namespace

int sceneTextureOf(const AssetRef& ref) {
    int index = -1;
    const std::string_view text = ref.uuid;
    if (text.starts_with(kScenePrefix)) std::from_chars(text.data() + 6, text.data() + text.size(), index);
    return index;
}

bool dropFurtherCoordinates(SceneMaterial& material) {
    bool any = false;
    for (TextureRef* map : {&material.baseColorMap, &material.metallicRoughnessMap, &material.normalMap,
                            &material.occlusionMap, &material.emissiveMap}) {
        if (!*map || map->texcoord < 2) continue;
        *map = {};
        any = true;
    }
    return any;
}

Mtl makeStandardMtl(const SceneMaterial& material, const EffectAsset& standard) {
    PassWriter writer;
    // Linear numbers go where nothing squares them; mainColor, which is squared, keeps white.
    writer.set("mainColor", numbers({1, 1, 1, material.baseColor.a}));
    writer.set("albedoScale", numbers({material.baseColor.r, material.baseColor.g, material.baseColor.b}));
    writer.set("metallic", number(material.metallic));
    writer.set("roughness", number(material.roughness));
    writer.set("occlusion", number(material.occlusionStrength));
    writer.set("normalStrenth", number(material.normalScale));  // the effect spells it so
    writer.set("emissive", numbers({1, 1, 1, 1}));
    writer.set("emissiveScale", numbers({material.emissive.r, material.emissive.g, material.emissive.b}));
    writer.map(material.baseColorMap, "mainTexture", "USE_ALBEDO_MAP", "ALBEDO_UV");
    writer.map(material.metallicRoughnessMap, "metallicRoughnessMap", "USE_METALLIC_ROUGHNESS_MAP", "PBR_UV");
    writer.map(material.normalMap, "normalMap", "USE_NORMAL_MAP", "NORMAL_UV");
    writer.map(material.occlusionMap, "occlusionMap", "USE_OCCLUSION_MAP", "PBR_UV");
    writer.map(material.emissiveMap, "emissiveMap", "USE_EMISSIVE_MAP", "EMISSIVE_UV");
    if (material.alphaMode == AlphaMode::Mask) {
        writer.define("USE_ALPHA_TEST");
        writer.set("alphaThreshold", number(material.alphaCutoff));
    }
    if (material.doubleSided) {
        writer.define("USE_TWOSIDE");
        Value raster = Value::makeObject();
        raster.set("cullMode", Value::makeInteger(0));
        writer.pass.states.set("rasterizerState", std::move(raster));
    }
    Mtl mtl;
    mtl.name = material.name;
    mtl.technique = material.alphaMode == AlphaMode::Blend ? transparentTechnique(standard) : 0;
    if (mtl.technique < standard.techniques.size())
        mtl.passes.assign(standard.techniques[mtl.technique].passes.size(), writer.pass);
    return mtl;
}

void readStandardMtl(const Mtl& mtl, SceneMaterial& material) {
    material.name = mtl.name;
    const glm::vec4 color = colorOf(mtl, "mainColor", colorOf(mtl, "albedo", glm::vec4(1)));
    const glm::vec4 scale = colorOf(mtl, "albedoScale", glm::vec4(1));
    material.baseColor = {glm::vec3(color * color * scale), color.a};
    material.metallic = numberOf(mtl, "metallic", 0.6f);
    material.roughness = numberOf(mtl, "roughness", 0.8f);
    material.occlusionStrength = numberOf(mtl, "occlusion", 1);
    material.normalScale = numberOf(mtl, "normalStrenth", 1);
    const glm::vec4 emissive = colorOf(mtl, "emissive", glm::vec4(0));
    material.emissive = glm::vec3(emissive * emissive * colorOf(mtl, "emissiveScale", glm::vec4(1)));
    material.alphaCutoff = numberOf(mtl, "alphaThreshold", 0.5f);
    if (hasDefine(mtl, "USE_ALPHA_TEST")) material.alphaMode = AlphaMode::Mask;
    if (mtl.technique == 1) material.alphaMode = AlphaMode::Blend;
    for (const MtlPass& pass : mtl.passes) {
        const Value* raster = pass.states.isObject() ? pass.states.find("rasterizerState") : nullptr;
        const Value* cull = raster && raster->isObject() ? raster->find("cullMode") : nullptr;
        if (cull && cull->isInteger() && cull->integer() == 0) material.doubleSided = true;
    }
}

}  // namespace crevice::cocos
