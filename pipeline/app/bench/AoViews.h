// What the occlusion benchmark looks at: scenes with cameras, radii and light, fixed in a document of their own.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/Files.h"
#include "core/Log.h"
#include "scene/Scene.h"

namespace crevice {

/// One camera.
struct AoView {
    std::string name;
    std::string set = "evaluation";  ///< "calibration": what techniques may be tuned on; "evaluation": the judge.
    Camera camera;
};

struct AoScene {
    std::string name;
    std::filesystem::path path;
    std::string kind = "room";  ///< "room", or "thin": occluders thinner than the radius.
    std::vector<Light> lights;  ///< Besides the file's own.
    std::optional<Ambient> ambient;
    std::vector<AoView> views;  ///< Empty: the cameras of the file, else one that frames it.
};

struct AoViewList {
    std::vector<double> radii;  ///< Shares of the diagonal of the scene's bounding box, ascending.
    std::vector<AoScene> scenes;
};

/// Scene files are looked up beside the document and in its "folders"; scenes that are not there are left out with a
/// note. Throws Error with all mistakes.
AoViewList readAoViews(const std::filesystem::path& path, const Log& log);

/// Keeps the scenes of the list that `wanted` names, in its order; what is no name is a scene file of its own, or the
/// name of a shipped scene. Empty: all. Throws Error.
void chooseScenes(AoViewList& list, const std::vector<std::string>& wanted, const AssetRoots& roots);

/// Reads the scene, adds the list's light and fills views in. Normal maps are taken off: the ray-traced truth is that
/// of the geometry. Throws Error.
Scene loadAoScene(AoScene& scene, const AssetRoots& roots, const Log& log);

}  // namespace crevice
