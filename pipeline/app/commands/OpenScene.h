// A scene for a pipeline: with a Cocos project in use, its materials are those of the project's effects.
#pragma once

#include <optional>

#include "app/commands/PipelineOptions.h"
#include "app/commands/SceneFiles.h"

namespace crevice {

struct OpenedScene {
    Scene scene{};
    std::optional<glm::vec4> background{};  ///< Clear colour of a Cocos scene's camera.
    std::vector<StageSet> sets{};           ///< What a Cocos scene says of a .rpp: the size of its shadow maps.
};

/// Reads any scene file, .scene of Cocos Creator too. Materials become effects of the project where the pipeline has a
/// Cocos profile. Throws Error.
OpenedScene openScene(const SceneFile& file, const PipelineChoice& pipeline, const Log& log,
                      const SceneOptions& options = {});

/// The scene of that name or path, or a plain box when the name is empty: whose materials a plan is made for.
Scene openSceneOrSample(const std::string& nameOrPath, const PipelineChoice& pipeline, const Log& log,
                        const SceneOptions& options);

}  // namespace crevice
