// Our own scene documents, `.scene.json`: a glTF and/or primitives, with cameras, lights, sky and fog.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/Document.h"
#include "core/Params.h"
#include "scene/GltfLoader.h"
#include "scene/Scene.h"

namespace crevice {

/// Reads a document. All mistakes found are in one Error, each with file:line:col.
Scene loadSceneAsset(const std::filesystem::path& path, const LoadOptions& options);

/// The same from a parsed document; `folder` is where relative paths start.
Scene readSceneAsset(const Value& document, const std::filesystem::path& folder, const LoadOptions& options);

/// Any scene file: .gltf, .glb or .scene.json. Throws Error for another extension.
Scene loadScene(const std::filesystem::path& path, const LoadOptions& options);

/// The fields of one kind of object in a scene document, for docs and schemas.
struct SceneFieldTable {
    std::string name;  ///< "camera", "primitive box", …
    std::vector<ParamRow> rows;
    Value schema;
};
std::vector<SceneFieldTable> sceneFieldTables();

}  // namespace crevice
