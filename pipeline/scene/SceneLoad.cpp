// Scene files by their ending, and documents from disk.
#include <fmt/format.h>

#include "core/LimitedFiles.h"
#include "scene/SceneAsset.h"

namespace crevice {

namespace fs = std::filesystem;

Scene loadSceneAsset(const fs::path& path, const LoadOptions& options) {
    const Limits& limits = options.limits;
    const Value document = parseJson(
        readTextWithin(path, limits.maxFileBytes), path.string(),
        {.maxBytes = limits.maxFileBytes, .maxDepth = limits.maxDocumentDepth, .maxNodes = limits.maxDocumentValues});
    Scene scene = readSceneAsset(document, fs::absolute(path).parent_path(), options);
    if (scene.name.empty()) scene.name = path.stem().stem().string();
    return scene;
}

Scene loadScene(const fs::path& path, const LoadOptions& options) {
    const std::string extension = path.extension().string();
    if (extension == ".gltf" || extension == ".glb") return loadGltf(path, options);
    if (extension == ".json") return loadSceneAsset(path, options);
    throw Error(SourceLoc{path.string()}, fmt::format("a scene cannot end in '{}'", extension),
                "scenes are .gltf, .glb or .scene.json files");
}

}  // namespace crevice
