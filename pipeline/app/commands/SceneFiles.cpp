// A name is looked up below the asset roots; whatever ends like a scene file is a path.
#include "app/commands/SceneFiles.h"

#include <system_error>

#include <fmt/format.h>

#include "core/Error.h"
#include "core/Text.h"
#include "scene/Primitives.h"
#include "scene/SceneAsset.h"

namespace crevice {

SceneFile findScene(const AssetRoots& roots, const std::string& argument) {
    const std::filesystem::path path = argument;
    for (const std::string ending : {".scene.json", ".gltf", ".glb"}) {
        const std::string file = path.filename().string();
        if (!file.ends_with(ending) || file == ending) continue;
        std::error_code failed;
        if (!std::filesystem::exists(path, failed)) {
            throw Error(fmt::format("scene '{}' does not exist", argument), "check the path");
        }
        return {path, file.substr(0, file.size() - ending.size())};
    }
    if (const auto found = roots.find(AssetKind::Scene, argument)) return {*found, path.filename().string()};
    std::error_code failed;
    if (std::filesystem::exists(path, failed)) {
        throw Error(fmt::format("'{}' is not a scene that can be read", argument),
                    "scenes end in .gltf, .glb or .scene.json");
    }
    throw Error(fmt::format("no scene named '{}'", argument),
                didYouMean(argument, roots.list(AssetKind::Scene), "shipped scenes") +
                    "; files end in .gltf, .glb or .scene.json");
}

Scene loadSceneFile(const SceneFile& file, const AssetRoots& roots, const Log& log, bool allowOutside) {
    return loadScene(file.path, {.log = log, .allowedRoots = roots.roots(), .allowOutside = allowOutside});
}

Scene makeSampleScene() {
    Scene scene;
    scene.name = "sample";
    scene.meshes.push_back(makeBox({1, 1, 1}));
    scene.materials.emplace_back();
    scene.instances.emplace_back();
    addDefaultLight(scene);
    return scene;
}

}  // namespace crevice
