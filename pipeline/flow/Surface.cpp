// One table row per texture of the metallic-roughness model: its sampler, the macro that turns it on, the macro of its
// UV set.
#include "flow/Surface.h"

#include <string>

namespace crevice {
namespace {

struct MapRow {
    TextureRef SceneMaterial::*ref;
    const char* sampler;
    const char* useMacro;
    const char* uvMacro;
    const char* row0;  ///< Properties of its UvTransform.
    const char* row1;
};
constexpr MapRow kMaps[] = {
    {&SceneMaterial::baseColorMap, "baseColorMap", "USE_BASE_COLOR_MAP", "BASE_COLOR_UV", "baseColorUvRow0",
     "baseColorUvRow1"},
    {&SceneMaterial::metallicRoughnessMap, "metallicRoughnessMap", "USE_METALLIC_ROUGHNESS_MAP",
     "METALLIC_ROUGHNESS_UV", "metallicRoughnessUvRow0", "metallicRoughnessUvRow1"},
    {&SceneMaterial::normalMap, "normalMap", "USE_NORMAL_MAP", "NORMAL_UV", "normalUvRow0", "normalUvRow1"},
    {&SceneMaterial::occlusionMap, "occlusionMap", "USE_OCCLUSION_MAP", "OCCLUSION_UV", "occlusionUvRow0",
     "occlusionUvRow1"},
    {&SceneMaterial::emissiveMap, "emissiveMap", "USE_EMISSIVE_MAP", "EMISSIVE_UV", "emissiveUvRow0", "emissiveUvRow1"},
};

Value vectorValue(const float* components, int count) {
    Value value = Value::makeArray();
    for (int i = 0; i < count; ++i) value.items().push_back(Value::makeNumber(components[i]));
    return value;
}

Value rowValue(const UvTransform& transform, int index) {
    const glm::vec3 row = transform.row(index);
    return vectorValue(&row.x, 3);
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
    inputs.properties = propertiesOf(material);
    bool transformed = false;
    for (const MapRow& row : kMaps) {
        const TextureRef& ref = material.*row.ref;
        inputs.defines[row.useMacro] = ref ? "1" : "0";
        if (!ref) continue;
        inputs.defines[row.uvMacro] = std::to_string(ref.texcoord);
        inputs.textures.emplace_back(row.sampler, ref);
        if (ref.transform.isIdentity()) continue;
        transformed = true;
        inputs.properties.set(row.row0, rowValue(ref.transform, 0));
        inputs.properties.set(row.row1, rowValue(ref.transform, 1));
    }
    inputs.defines["USE_TEXTURE_TRANSFORM"] = transformed ? "1" : "0";
    inputs.defines["USE_UNLIT"] = material.unlit ? "1" : "0";
    inputs.defines["USE_ALPHA_TEST"] = material.alphaMode == AlphaMode::Mask ? "1" : "0";
    inputs.defines["USE_ALPHA_BLEND"] = material.alphaMode == AlphaMode::Blend ? "1" : "0";
    inputs.defines["USE_DOUBLE_SIDED"] = material.doubleSided ? "1" : "0";
    inputs.defines["HAS_TANGENTS"] = meshHasTangents ? "1" : "0";
    return inputs;
}

}  // namespace crevice
