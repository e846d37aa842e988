// A glTF is loaded whole and its lists are appended to the scene's; renderers then pick parts of it.
#include "cocos/scene/SceneModels.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "cocos/files/Uuid.h"
#include "cocos/scene/Shapes.h"
#include "cocos/scene/Tangents.h"

namespace crevice::cocos {
namespace {

void shift(TextureRef& ref, int by) {
    if (ref) ref.texture += by;
}

int gltfIndexOf(const MetaAsset& asset) {
    const Value* index = asset.userData.isObject() ? asset.userData.find("gltfIndex") : nullptr;
    const bool small = index && index->isInteger() && index->integer() >= 0 && index->integer() < 1'000'000;
    return small ? int(index->integer()) : -1;
}

/// `tangents` of a model's meta: 0 leaves them out, 1 takes what the file has, 2 and 3 make them; 2 without the word. A
/// material of the scene may bring the normal map that asks for them.
bool requiresTangents(const MetaAsset& model) {
    const Value* setting = model.userData.isObject() ? model.userData.find("tangents") : nullptr;
    return !setting || !setting->isInteger() || setting->integer() >= 2;
}

}  // namespace

bool SceneModels::isModel(const MetaAsset& asset) {
    const std::string ending = asset.path.extension().string();
    return ending == ".gltf" || ending == ".glb";
}

SceneModels::Model& SceneModels::load(const MetaAsset& asset, const AssetRef& ref) {
    const auto [known, isNew] = models_.try_emplace(asset.path);
    Model& model = known->second;
    if (!isNew) return model;
    Scene loaded;
    try {
        loaded = loadGltf(asset.path, options_);
    } catch (const Error& error) {
        problems_.error(ref.where, fmt::format("model '{}' cannot be read", asset.path.string()), "see below");
        problems_.add(error);
        return model;
    }
    model.good = true;
    model.meshBase = int(scene_.meshes.size());
    model.materialBase = int(scene_.materials.size());
    model.textureBase = int(scene_.textures.size());
    model.materialCount = loaded.materials.size();
    std::move(loaded.textures.begin(), loaded.textures.end(), std::back_inserter(scene_.textures));
    for (SceneMaterial& material : loaded.materials) {
        for (TextureRef* texture : {&material.baseColorMap, &material.metallicRoughnessMap, &material.normalMap,
                                    &material.occlusionMap, &material.emissiveMap})
            shift(*texture, model.textureBase);
        materials_.translate(material);
    }
    const MetaAsset* file = project_.metas().find(parentUuid(asset.uuid));
    for (const Instance& instance : loaded.instances)
        addTangentsFor(loaded.materials[std::size_t(instance.material)], loaded.meshes[std::size_t(instance.mesh)],
                       !file || requiresTangents(*file));
    std::move(loaded.materials.begin(), loaded.materials.end(), std::back_inserter(scene_.materials));
    std::move(loaded.meshes.begin(), loaded.meshes.end(), std::back_inserter(scene_.meshes));
    for (Instance instance : loaded.instances) {
        const int own = file ? extracted(*file, std::size_t(instance.material), ref) : -1;
        instance.mesh += model.meshBase;
        instance.material = own >= 0 ? own : instance.material + model.materialBase;
        model.instances.push_back(std::move(instance));
    }
    return model;
}

/// The .mtl that the editor made of a model's material ("extract materials"), or -1.
int SceneModels::extracted(const MetaAsset& model, std::size_t material, const AssetRef& ref) {
    const Value* finder = model.userData.isObject() ? model.userData.find("assetFinder") : nullptr;
    const Value* list = finder && finder->isObject() ? finder->find("materials") : nullptr;
    if (!list || !list->isArray() || material >= list->items().size()) return -1;
    const Value& uuid = list->items()[material];
    const MetaAsset* asset = uuid.isString() ? project_.metas().find(uuid.string()) : nullptr;
    if (!asset || asset->path.extension() != ".mtl") return -1;
    return materials_.add({.uuid = asset->uuid, .where = ref.where}, "a material of a model");
}

/// Instances of a node follow each other in the order of nodes; a mesh has as many parts wherever it is shown.
bool SceneModels::findNodes(Model& model) const {
    std::map<int, std::size_t> shown, drawn;
    for (const auto& [node, mesh] : model.prefab->meshNodes) ++shown[mesh];
    for (const Instance& instance : model.instances) ++drawn[instance.sourceMesh];
    std::size_t next = 0;
    for (const auto& [node, mesh] : model.prefab->meshNodes) {
        if (drawn[mesh] % shown[mesh] != 0) return false;
        for (std::size_t i = 0; i < drawn[mesh] / shown[mesh]; ++i, ++next) {
            if (next >= model.instances.size() || model.instances[next].sourceMesh != mesh) return false;
            model.nodes[node].push_back({model.instances[next].mesh, model.instances[next].material});
        }
    }
    return next == model.instances.size();
}

const ObjectGraph* SceneModels::prefab(const MetaAsset& asset, const AssetRef& ref) {
    Model& model = load(asset, ref);
    if (!model.good) return nullptr;
    if (!model.prefab) {
        const MetaAsset* file = project_.metas().find(parentUuid(asset.uuid));
        model.prefab = std::make_unique<GltfPrefab>(makeGltfPrefab(asset, file ? *file : asset, options_.limits));
        if (!findNodes(model)) model.nodes.clear();
    }
    return model.nodes.empty() ? nullptr : &model.prefab->graph;
}

std::vector<ModelPart> SceneModels::partsOfNode(const MetaAsset& asset, int node, const AssetRef& ref) {
    const Model& model = load(asset, ref);
    const auto found = model.nodes.find(node);
    return found == model.nodes.end() ? std::vector<ModelPart>{} : found->second;
}

std::vector<ModelPart> SceneModels::mesh(const AssetRef& ref, const std::string& what) {
    const auto uuid = normalizeUuid(ref.uuid);
    if (uuid && parentUuid(*uuid) == kPrimitivesUuid) {
        const auto [known, isNew] = shapes_.try_emplace(*uuid);
        if (isNew) {
            if (auto shape = makeShape(shapeName(uuid->substr(kPrimitivesUuid.size() + 1)))) {
                scene_.meshes.push_back(std::move(*shape));
                known->second = {{int(scene_.meshes.size()) - 1, -1}};
            } else {
                problems_.error(ref.where, fmt::format("'{}' is none of the built-in meshes", ref.uuid),
                                "box, sphere, capsule, cylinder, cone, torus, plane and quad are known");
            }
        }
        return known->second;
    }
    const MetaAsset* asset = project_.find(ref, what, problems_);
    if (!asset) return {};
    if (!isModel(*asset)) {
        problems_.warning(ref.where, fmt::format("model '{}' is left out", asset->path.filename().string()),
                          "models must be .gltf or .glb");
        return {};
    }
    const int index = gltfIndexOf(*asset);
    const Model& model = load(*asset, ref);
    std::vector<ModelPart> parts;
    std::set<int> taken;
    for (const Instance& instance : model.instances) {
        if (instance.sourceMesh == index && taken.insert(instance.mesh).second)
            parts.push_back({instance.mesh, instance.material});
    }
    if (parts.empty() && model.good)
        problems_.warning(ref.where, fmt::format("mesh {} of '{}' is shown by no node of it and left out", index,
                                                 asset->path.filename().string()));
    return parts;
}

int SceneModels::material(const AssetRef& ref) {
    const MetaAsset* asset = project_.metas().find(ref.uuid);
    if (!asset || !isModel(*asset)) return -1;
    const Model& model = load(*asset, ref);
    const int index = gltfIndexOf(*asset);
    return index >= 0 && std::size_t(index) < model.materialCount ? model.materialBase + index : -1;
}

void SceneModels::placeModel(const MetaAsset& asset, const glm::mat4& world, const AssetRef& ref) {
    for (Instance instance : load(asset, ref).instances) {
        instance.world = world * instance.world;
        instance.castsShadow = false;  // as the importer leaves its renderers
        instance.flipped = glm::determinant(glm::mat3(instance.world)) < 0;
        scene_.instances.push_back(std::move(instance));
    }
}

}  // namespace crevice::cocos
