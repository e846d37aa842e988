// Scenes as the command line names them: files, or names of shipped scenes.
#pragma once

#include <filesystem>
#include <string>

#include "core/Files.h"
#include "core/Log.h"
#include "scene/Scene.h"

namespace crevice {

struct SceneFile {
    std::filesystem::path path;
    std::string name;  ///< Of the file, without ending: names pictures.
};

/// Throws Error with near names when it is neither a scene file nor the name of a shipped scene.
SceneFile findScene(const AssetRoots& roots, const std::string& argument);
Scene loadSceneFile(const SceneFile& file, const AssetRoots& roots, const Log& log, bool allowOutside = false);

/// A box with a plain material: what pipelines are checked with when no scene is given, so that the effects that draw
/// scenes are compiled too.
Scene makeSampleScene();

}  // namespace crevice
