// Internal to the scene importer: ambient light, fog, shadows and the sky of a whole scene.
#pragma once

#include <map>
#include <string>

#include "cocos/assets/ObjectGraph.h"
#include "cocos/assets/Project.h"
#include "cocos/scene/SceneImport.h"

namespace crevice::cocos {

/// What nodes have said by then.
struct SceneFacts {
    bool hdr = true;
    double exposure = 1;    ///< Of the first camera.
    bool showsSky = true;   ///< It clears with the sky.
    bool cascades = false;  ///< A light asks for cascades of shadow maps.
};

/// Whether the scene's sky asks for HDR; without one it does.
bool isHdr(const ObjectGraph& graph, const Value* globals, Problems& problems);

/// Reads cc.SceneGlobals (null: there are none) into the scene, whose cameras and lights stand. What is left out is
/// counted in `skipped`.
void readSurroundings(const ObjectGraph& graph, const Value* globals, const SceneFacts& facts, Project& project,
                      const LoadOptions& options, ImportedScene& out, std::map<std::string, std::size_t>& skipped,
                      Problems& problems);

}  // namespace crevice::cocos
