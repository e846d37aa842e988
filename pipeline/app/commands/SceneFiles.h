// Scenes as the command line names them: files, or names of shipped scenes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/Files.h"
#include "core/Log.h"
#include "scene/GltfLoader.h"
#include "scene/Scene.h"

namespace CLI {
class App;
}

namespace crevice {

/// Which part of a scene file is shown, how strictly it is read and what it may do. As given; empty = not given.
struct SceneOptions {
    std::string scene, animation, time;     ///< --scene, --animation, --time
    bool strict = false;                    ///< --strict
    bool allowOutside = false;              ///< --allow-outside
    std::vector<std::string> allowedPaths;  ///< --allow-path DIR
    std::vector<std::string> limits;        ///< --limit NAME=VALUE
    float aspect = 0;                       ///< Of the pictures, as LoadOptions has it.
    LoadProgress progress{};
};
void addSceneOptions(CLI::App& command, SceneOptions& options);

struct SceneFile {
    std::filesystem::path path;
    std::string name;  ///< Of the file, without ending: names pictures.
};

/// Throws Error with near names when it is neither a scene file nor the name of a shipped scene.
SceneFile findScene(const AssetRoots& roots, const std::string& argument);
/// `log` must outlive what is made. Throws Error for an --allow-path that is no folder and a --limit that does not
/// exist.
LoadOptions makeLoadOptions(const AssetRoots& roots, const Log& log, const SceneOptions& options);
/// Throws Error, as makeLoadOptions() does, too.
Scene loadSceneFile(const SceneFile& file, const AssetRoots& roots, const Log& log, const SceneOptions& options = {});

/// A box with a plain material: what pipelines are checked with when no scene is given, so that the effects that draw
/// scenes are compiled too.
Scene makeSampleScene();

}  // namespace crevice
