// One table row per texture of the metallic-roughness model: its sampler, the macro that turns it on, the macro of its
// UV set.
#include "flow/Surface.h"

#include <iterator>

namespace crevice {
namespace {

struct MapRow {
    TextureRef SceneMaterial::*ref;
    const char* sampler;
    const char* useMacro;
    const char* uvMacro;
};
constexpr MapRow kMaps[] = {
    {&SceneMaterial::baseColorMap, "baseColorMap", "USE_BASE_COLOR_MAP", "BASE_COLOR_UV"},
    {&SceneMaterial::metallicRoughnessMap, "metallicRoughnessMap", "USE_METALLIC_ROUGHNESS_MAP",
     "METALLIC_ROUGHNESS_UV"},
    {&SceneMaterial::normalMap, "normalMap", "USE_NORMAL_MAP", "NORMAL_UV"},
    {&SceneMaterial::occlusionMap, "occlusionMap", "USE_OCCLUSION_MAP", "OCCLUSION_UV"},
    {&SceneMaterial::emissiveMap, "emissiveMap", "USE_EMISSIVE_MAP", "EMISSIVE_UV"},
};

Value vectorValue(const float* components, int count) {
    Value value = Value::makeArray();
    for (int i = 0; i < count; ++i) value.items().push_back(Value::makeNumber(components[i]));
    return value;
}

Value propertiesOf(const SceneMaterial& material) {
    Value properties = Value::makeObject();
    properties.set("baseColor", vectorValue(&material.baseColor.x, 4));
    properties.set("metallic", Value::makeNumber(material.metallic));
    properties.set("roughness", Value::makeNumber(material.roughness));
    properties.set("emissive", vectorValue(&material.emissive.x, 3));
    properties.set("normalScale", Value::makeNumber(material.normalScale));
    properties.set("occlusionStrength", Value::makeNumber(material.occlusionStrength));
    properties.set("alphaCutoff", Value::makeNumber(material.alphaCutoff));
    return properties;
}

}  // namespace

SurfaceInputs surfaceInputs(const SceneMaterial& material, bool meshHasTangents) {
    SurfaceInputs inputs;
    for (const MapRow& row : kMaps) {
        const TextureRef& ref = material.*row.ref;
        inputs.defines[row.useMacro] = ref ? "1" : "0";
        if (!ref) continue;
        inputs.defines[row.uvMacro] = ref.texcoord == 1 ? "1" : "0";
        inputs.textures.emplace_back(row.sampler, ref);
    }
    inputs.defines["USE_ALPHA_TEST"] = material.alphaMode == AlphaMode::Mask ? "1" : "0";
    inputs.defines["USE_ALPHA_BLEND"] = material.alphaMode == AlphaMode::Blend ? "1" : "0";
    inputs.defines["USE_DOUBLE_SIDED"] = material.doubleSided ? "1" : "0";
    inputs.defines["HAS_TANGENTS"] = meshHasTangents ? "1" : "0";
    inputs.properties = propertiesOf(material);
    return inputs;
}

}  // namespace crevice
