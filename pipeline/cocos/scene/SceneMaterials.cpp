// A material that cannot be read costs one error; its renderers then take the default one.
#include "cocos/scene/SceneMaterials.h"

#include <fmt/format.h>

#include "cocos/assets/StandardMaterial.h"
#include "cocos/assets/TexturePicture.h"
#include "cocos/assets/TextureSampler.h"
#include "cocos/scene/GltfJson.h"
#include "cocos/scene/Tangents.h"

namespace crevice::cocos {
namespace {

const TypedValue* textureOf(const Mtl& mtl, std::string_view name) {
    for (const MtlPass& pass : mtl.passes)
        for (const MtlProperty& property : pass.properties)
            if (property.name == name && property.value.kind == TypedValue::Kind::Asset) return &property.value;
    return nullptr;
}

Image readPicture(const MetaAsset& picture) {
    if (picture.importer != "gltf-embeded-image") return readImage(picture.path);  // the editor spells it so
    const Value* index = picture.userData.isObject() ? picture.userData.find("gltfIndex") : nullptr;
    const bool small = index && index->isInteger() && index->integer() >= 0 && index->integer() < 1'000'000;
    return readEmbeddedPicture(picture.path, small ? int(index->integer()) : -1, {});
}

}  // namespace

int SceneMaterials::add(const AssetRef& material, const std::string& what) {
    const auto known = materials_.find(material.uuid);
    if (known != materials_.end()) return known->second;
    int& index = materials_[material.uuid];
    index = -1;
    const Mtl* mtl = project_.material(material, what, problems_);
    if (!mtl) return -1;
    SceneMaterial out;
    readStandardMtl(*mtl, out);
    if (form_ == MaterialForm::Plain) {
        setPlain(out, *mtl);
    } else {
        const MetaAsset* effect = project_.effectFile(*mtl, problems_);
        if (!effect) return -1;
        setEffect(out, *mtl, effect->path);
    }
    scene_.materials.push_back(std::move(out));
    return index = int(scene_.materials.size()) - 1;
}

int SceneMaterials::addDefault() {
    if (default_ >= 0) return default_;
    Mtl mtl;
    mtl.name = "default material";
    SceneMaterial out;
    readStandardMtl(mtl, out);
    if (form_ == MaterialForm::Effects) {
        if (const auto effect = project_.findEffect(kStandardEffect)) setEffect(out, mtl, *effect);
    }
    scene_.materials.push_back(std::move(out));
    return default_ = int(scene_.materials.size()) - 1;
}

void SceneMaterials::setEffect(SceneMaterial& out, const Mtl& mtl, const std::filesystem::path& effect) {
    const EffectAsset* asset = project_.effect(effect, problems_);
    if (!asset) return;
    const auto textures = [this](const AssetRef& texture, const EffectProperty&) {
        const int index = sceneTextureOf(texture);
        return index >= 0 ? Value::makeInteger(index) : useTexture(texture, false);
    };
    out.effect = instantiate(mtl, *asset, project_.effectName(effect), textures, problems_);
}

void SceneMaterials::setPlain(SceneMaterial& out, const Mtl& mtl) {
    const auto use = [&](const char* name, bool srgb, TextureRef& ref) {
        const TypedValue* texture = textureOf(mtl, name);
        const Value index = texture ? useTexture(texture->asset, srgb) : Value();
        if (index.isInteger()) ref.texture = int(index.integer());
    };
    use("mainTexture", true, out.baseColorMap);
    if (!out.baseColorMap) use("albedoMap", true, out.baseColorMap);
    use("normalMap", false, out.normalMap);
    use("metallicRoughnessMap", false, out.metallicRoughnessMap);
    use("occlusionMap", false, out.occlusionMap);
    use("emissiveMap", true, out.emissiveMap);
}

void SceneMaterials::translate(SceneMaterial& material) {
    if (form_ != MaterialForm::Effects || material.effect) return;
    const auto path = project_.findEffect(kStandardEffect);
    const EffectAsset* asset = path ? project_.effect(*path, problems_) : nullptr;
    if (!asset) {
        if (!notedStandard_ && !path)
            problems_.warning({}, fmt::format("no effect '{}' for the materials of glTF", kStandardEffect),
                              "name the engine's folder: --engine DIR");
        notedStandard_ = true;
        return;
    }
    if (dropFurtherCoordinates(material) && !notedCoordinates_) {
        problems_.warning({},
                          fmt::format("material '{}' loses the maps of its third and fourth set of texture "
                                      "coordinates, and so may others",
                                      material.name),
                          fmt::format("'{}' reads two sets: use no more for each material", kStandardEffect));
        notedCoordinates_ = true;
    }
    setEffect(material, makeStandardMtl(material, *asset), *path);
    for (const TextureRef* ref : {&material.baseColorMap, &material.emissiveMap}) {
        if (*ref) scene_.textures[std::size_t(ref->texture)].srgb = false;
    }
}

Value SceneMaterials::useTexture(const AssetRef& texture, bool srgb) {
    const auto [known, isNew] = textures_.emplace(std::make_pair(texture.uuid, srgb), -1);
    if (!isNew) return known->second < 0 ? Value() : Value::makeInteger(known->second);
    const MetaAsset* asset = project_.find(texture, "a texture", problems_);
    if (!asset) return {};
    const MetaAsset& picture = pictureOf(*asset, project_);
    SceneTexture out{.name = picture.path.filename().string(),
                     .image = {},
                     .srgb = srgb,
                     .sampler = samplerOf(*asset, project_.metas())};
    try {
        out.image = readPicture(picture);
        if (out.image.format != Format::RGBA8) out.image = toEightBit(out.image, PngMapping::Clamp);
    } catch (const Error& error) {
        problems_.warning(texture.where,
                          fmt::format("texture '{}' is left out: {}", out.name, error.problems().front().message),
                          "pictures must be PNG, JPEG, WebP or EXR");
        return {};
    }
    scene_.textures.push_back(std::move(out));
    known->second = int(scene_.textures.size()) - 1;
    return Value::makeInteger(known->second);
}

void translateMaterials(Scene& scene, Project& project, Problems& problems) {
    SceneMaterials materials(project, scene, MaterialForm::Effects, problems);
    for (SceneMaterial& material : scene.materials) materials.translate(material);
    for (const Instance& instance : scene.instances) {
        addTangentsFor(scene.materials[std::size_t(instance.material)], scene.meshes[std::size_t(instance.mesh)]);
    }
}

}  // namespace crevice::cocos
