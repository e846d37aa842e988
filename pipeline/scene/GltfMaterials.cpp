// glTF materials as SceneMaterials.
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

template <class Info>
TextureRef readTexture(const File& file, Images& images, std::size_t material, const char* member, const Info& info,
                       bool srgb) {
    if (info.index < 0) return {};
    const std::string user = fmt::format("materials[{}].{}", material, member);
    TextureRef ref{.texture = images.use(info.index, srgb, user), .texcoord = info.texCoord};
    if (ref.texcoord < 0 || ref.texcoord > 1) {
        file.warn("materials", material,
                  fmt::format("'{}.texCoord' is {}; only 0 and 1 are read, 0 is taken", member, info.texCoord));
        ref.texcoord = 0;
    }
    return ref;
}

float number(double value, double min, double max) { return float(std::clamp(value, min, max)); }

AlphaMode alphaMode(const File& file, std::size_t index, const std::string& name) {
    if (name == "OPAQUE") return AlphaMode::Opaque;
    if (name == "MASK") return AlphaMode::Mask;
    if (name == "BLEND") return AlphaMode::Blend;
    file.fail("materials", index, fmt::format("'alphaMode' is '{}'; it may be OPAQUE, MASK or BLEND", name));
}

float emissiveStrength(const tinygltf::Material& material) {
    const auto extension = material.extensions.find("KHR_materials_emissive_strength");
    if (extension == material.extensions.end() || !extension->second.Has("emissiveStrength")) return 1;
    return number(extension->second.Get("emissiveStrength").GetNumberAsDouble(), 0, 1e9);
}

SceneMaterial readMaterial(const File& file, Images& images, std::size_t index) {
    const tinygltf::Material& from = file.model.materials[index];
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    SceneMaterial to;
    to.name = from.name.empty() ? fmt::format("material {}", index) : from.name;
    for (std::size_t i = 0; i < 4 && pbr.baseColorFactor.size() == 4; ++i)
        to.baseColor[int(i)] = number(pbr.baseColorFactor[i], 0, 1);
    to.metallic = number(pbr.metallicFactor, 0, 1);
    to.roughness = number(pbr.roughnessFactor, 0, 1);
    for (std::size_t i = 0; i < 3 && from.emissiveFactor.size() == 3; ++i)
        to.emissive[int(i)] = number(from.emissiveFactor[i], 0, 1) * emissiveStrength(from);
    to.normalScale = number(from.normalTexture.scale, -1e3, 1e3);
    to.occlusionStrength = number(from.occlusionTexture.strength, 0, 1);

    to.baseColorMap = readTexture(file, images, index, "baseColorTexture", pbr.baseColorTexture, true);
    to.metallicRoughnessMap =
        readTexture(file, images, index, "metallicRoughnessTexture", pbr.metallicRoughnessTexture, false);
    to.normalMap = readTexture(file, images, index, "normalTexture", from.normalTexture, false);
    to.occlusionMap = readTexture(file, images, index, "occlusionTexture", from.occlusionTexture, false);
    to.emissiveMap = readTexture(file, images, index, "emissiveTexture", from.emissiveTexture, true);

    to.alphaMode = alphaMode(file, index, from.alphaMode);
    to.alphaCutoff = number(from.alphaCutoff, 0, 1e9);
    to.doubleSided = from.doubleSided;
    return to;
}

}  // namespace

std::vector<SceneMaterial> readMaterials(const File& file, Images& images) {
    std::vector<SceneMaterial> materials;
    bool unlit = false;
    for (std::size_t i = 0; i < file.model.materials.size(); ++i) {
        materials.push_back(readMaterial(file, images, i));
        unlit = unlit || file.model.materials[i].extensions.contains("KHR_materials_unlit");
    }
    if (unlit) file.note("materials with KHR_materials_unlit are drawn lit");
    return materials;
}

}  // namespace crevice::gltf
