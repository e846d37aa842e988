// Internal to the scene importer: a glTF as the prefab that Cocos' editor makes of it, so that instances can change it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cocos/assets/ObjectGraph.h"
#include "cocos/files/MetaIndex.h"
#include "core/Limits.h"

namespace crevice::cocos {

/// The field of a renderer that says which node of the glTF it draws.
inline constexpr const char* kGltfNode = "__gltfNode__";

struct GltfPrefab {
    ObjectGraph graph;
    struct MeshNode {
        int node = 0, mesh = 0;
    };
    std::vector<MeshNode> meshNodes{};  ///< In the order in which loadGltf() adds their instances.
};

/// Nodes, and one renderer for each that has a mesh, with the fileIds that the editor gives them. `asset`: the model or
/// its part of kind "gltf-scene"; renderers name it as their mesh. `model`: the meta of the file itself.
/// Source of names and ids: the editor's importer of glTF. Throws Error: the file cannot be read, or nodes in a circle.
GltfPrefab makeGltfPrefab(const MetaAsset& asset, const MetaAsset& model, const Limits& limits);

}  // namespace crevice::cocos
