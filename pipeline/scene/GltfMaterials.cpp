// glTF materials as SceneMaterials.
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

/// Reads one material. Texture coordinates are numbered by stream: the first four sets that its textures read.
class Reader {
public:
    Reader(const File& file, Images& images, std::size_t index)
        : file_(file), images_(images), index_(index), from_(file.item("materials", index)) {}

    SceneMaterial read(std::vector<SpecularGlossiness>& toConvert) {
        to_.name = nameIn(from_);
        if (to_.name.empty()) to_.name = fmt::format("material {}", index_);
        to_.doubleSided = flagOr(from_, "doubleSided");
        to_.alphaCutoff = float(numberOr(from_, "alphaCutoff", 0.5));
        readAlphaMode();
        collectSets(from_);
        orderSets();
        const bool unlit = extensionOf(from_, "KHR_materials_unlit") != nullptr;
        const Value* glossiness = unlit ? nullptr : extensionOf(from_, "KHR_materials_pbrSpecularGlossiness");
        readMetallicRoughness(unlit);
        if (glossiness && !hasOwnMetallicRoughness(*glossiness)) toConvert.push_back(readGlossiness(*glossiness));
        if (unlit)
            to_.unlit = true;  // every other property is for lit materials
        else
            readLit();
        return to_;
    }

    const std::vector<int>& sets() const { return sets_; }

private:
    static constexpr std::size_t kMostSets = 4;

    static int setOf(const Value& info) {
        const Value* transform = extensionOf(info, "KHR_texture_transform");
        return transform ? intOr(*transform, "texCoord", intOr(info, "texCoord", 0)) : intOr(info, "texCoord", 0);
    }

    // All textures of the material, wherever they stand in it.
    void collectSets(const Value& object) {
        for (const Member& member : object.members()) {
            if (!member.value.isObject()) continue;
            if (member.key.ends_with("Texture"))
                sets_.push_back(setOf(member.value));
            else
                collectSets(member.value);
        }
    }

    void orderSets() {
        std::sort(sets_.begin(), sets_.end());
        sets_.erase(std::unique(sets_.begin(), sets_.end()), sets_.end());
        if (sets_.empty() || sets_.back() <= 1) sets_ = {0, 1};
        if (sets_.size() > kMostSets) {
            file_.warn("materials", index_,
                       fmt::format("it reads {} sets of texture coordinates; the last ones are taken from set {}",
                                   sets_.size(), sets_[0]));
            sets_.resize(kMostSets);
        }
    }

    TextureRef readTexture(const Value* object, const char* key, bool srgb) {
        const Value* info = objectIn(object, key);
        if (!info) return {};
        TextureRef ref{.texture =
                           images_.use(intOr(*info, "index"), srgb, fmt::format("materials[{}].{}", index_, key))};
        const auto set = std::find(sets_.begin(), sets_.end(), setOf(*info));
        ref.texcoord = set == sets_.end() ? 0 : int(set - sets_.begin());
        if (const Value* transform = extensionOf(*info, "KHR_texture_transform")) {
            const auto pair = [&](const char* name, glm::vec2& to) {
                if (const auto v = floatsIn(*transform, name); v.size() == 2) to = {v[0], v[1]};
            };
            pair("offset", ref.transform.offset);
            pair("scale", ref.transform.scale);
            ref.transform.rotation = float(numberOr(*transform, "rotation", 0));
        }
        return ref;
    }

    void readAlphaMode() {
        const std::string mode = textOr(from_, "alphaMode", "OPAQUE");
        if (mode == "MASK") to_.alphaMode = AlphaMode::Mask;
        if (mode == "BLEND") to_.alphaMode = AlphaMode::Blend;
        if (mode != "MASK" && from_.find("alphaCutoff"))
            file_.note(fmt::format("materials[{}]: 'alphaCutoff' counts in mode MASK only", index_));
    }

    void readMetallicRoughness(bool unlit) {
        const Value none = Value::makeObject();
        const Value* pbr = objectIn(&from_, "pbrMetallicRoughness");
        if (!pbr) pbr = &none;
        if (const auto c = floatsIn(*pbr, "baseColorFactor"); c.size() == 4) to_.baseColor = {c[0], c[1], c[2], c[3]};
        to_.baseColorMap = readTexture(pbr, "baseColorTexture", true);
        if (unlit) return;
        to_.metallic = float(numberOr(*pbr, "metallicFactor", 1));
        to_.roughness = float(numberOr(*pbr, "roughnessFactor", 1));
        to_.metallicRoughnessMap = readTexture(pbr, "metallicRoughnessTexture", false);
    }

    void readLit() {
        double strength = 1;
        if (const Value* extension = extensionOf(from_, "KHR_materials_emissive_strength"))
            strength = std::min(numberOr(*extension, "emissiveStrength", 1), 1e6);
        if (const auto c = floatsIn(from_, "emissiveFactor"); c.size() == 3)
            to_.emissive = glm::vec3(c[0], c[1], c[2]) * float(strength);
        to_.normalMap = readTexture(&from_, "normalTexture", false);
        to_.occlusionMap = readTexture(&from_, "occlusionTexture", false);
        to_.emissiveMap = readTexture(&from_, "emissiveTexture", true);
        if (const Value* info = objectIn(&from_, "normalTexture"))
            to_.normalScale = float(std::clamp(numberOr(*info, "scale", 1), -10.0, 10.0));
        if (const Value* info = objectIn(&from_, "occlusionTexture"))
            to_.occlusionStrength = float(numberOr(*info, "strength", 1));
    }

    // A file with both was made for either: its own metallic-roughness is better than a conversion, unless it is a
    // makeshift without the textures or the file asks for the extension.
    bool hasOwnMetallicRoughness(const Value& glossiness) const {
        for (const Value& name : listIn(file_.json, "extensionsRequired"))
            if (name.isString() && name.string() == "KHR_materials_pbrSpecularGlossiness") return false;
        const Value* pbr = objectIn(&from_, "pbrMetallicRoughness");
        if (!pbr) return false;
        if (glossiness.find("diffuseTexture") && !pbr->find("baseColorTexture")) return false;
        if (glossiness.find("specularGlossinessTexture")) return pbr->find("metallicRoughnessTexture") != nullptr;
        return pbr->find("metallicRoughnessTexture") || pbr->find("metallicFactor") || pbr->find("roughnessFactor");
    }

    SpecularGlossiness readGlossiness(const Value& from) {
        SpecularGlossiness to{.material = index_};
        if (const auto c = floatsIn(from, "diffuseFactor"); c.size() == 4) to.diffuse = {c[0], c[1], c[2], c[3]};
        if (const auto c = floatsIn(from, "specularFactor"); c.size() == 3) to.specular = {c[0], c[1], c[2]};
        to.glossiness = float(numberOr(from, "glossinessFactor", 1));
        to.diffuseMap = readTexture(&from, "diffuseTexture", true);
        to.specularGlossinessMap = readTexture(&from, "specularGlossinessTexture", true);
        return to;
    }

    const File& file_;
    Images& images_;
    std::size_t index_;
    const Value& from_;
    SceneMaterial to_{};
    std::vector<int> sets_;
};

}  // namespace

Materials readMaterials(const File& file, Images& images) {
    Materials materials;
    const std::size_t count = listIn(file.json, "materials").size();
    for (std::size_t i = 0; i < count; ++i) {
        Reader reader(file, images, i);
        materials.scene.push_back(reader.read(materials.toConvert));
        materials.texcoords.push_back(reader.sets());
    }
    return materials;
}

}  // namespace crevice::gltf
