// Internal to the scene importer: the meshes that renderers name, each read once.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cocos/assets/Project.h"
#include "cocos/scene/GltfPrefab.h"
#include "cocos/scene/SceneMaterials.h"
#include "scene/GltfLoader.h"

namespace crevice::cocos {

/// A drawable part of a mesh in the scene.
struct ModelPart {
    int mesh = 0;
    int material = -1;  ///< The model's own; -1 = it has none.
};

class SceneModels {
public:
    SceneModels(Project& project, Scene& scene, SceneMaterials& materials, const LoadOptions& options,
                Problems& problems)
        : project_(project), scene_(scene), materials_(materials), options_(options), problems_(problems) {}

    /// The parts of a mesh asset; empty after errors and for kinds of files that are not read.
    std::vector<ModelPart> mesh(const AssetRef& ref, const std::string& what);
    /// The material of a glTF that a reference names, or -1.
    int material(const AssetRef& ref);
    /// Everything a glTF shows, below `world`.
    void placeModel(const MetaAsset& asset, const glm::mat4& world, const AssetRef& ref);
    /// The model as a prefab, for instances that change more than its root; null after errors, and where its renderers
    /// cannot be told apart.
    const ObjectGraph* prefab(const MetaAsset& asset, const AssetRef& ref);
    /// The parts that this node of a model shows.
    std::vector<ModelPart> partsOfNode(const MetaAsset& asset, int node, const AssetRef& ref);
    static bool isModel(const MetaAsset& asset);

private:
    /// A loaded glTF: where its lists begin in the scene's.
    struct Model {
        int meshBase = 0, materialBase = 0, textureBase = 0;
        std::vector<Instance> instances{};
        std::size_t materialCount = 0;
        bool good = false;
        std::unique_ptr<GltfPrefab> prefab{};
        std::map<int, std::vector<ModelPart>> nodes{};
    };
    bool findNodes(Model& model) const;
    int extracted(const MetaAsset& model, std::size_t material, const AssetRef& ref);
    Model& load(const MetaAsset& asset, const AssetRef& ref);

    Project& project_;
    Scene& scene_;
    SceneMaterials& materials_;
    const LoadOptions& options_;
    Problems& problems_;
    std::map<std::filesystem::path, Model> models_;
    std::map<std::string, std::vector<ModelPart>, std::less<>> shapes_;
};

}  // namespace crevice::cocos
