// The project decides how materials are written, the file's ending who reads it.
#include "app/commands/OpenScene.h"

#include <fmt/format.h>

#include "cocos/scene/SceneImport.h"

namespace crevice {
namespace {

/// A document has sizes of its own; a .rpp leaves them to the scene.
std::vector<StageSet> setsOf(const PipelineChoice& pipeline, const std::optional<glm::uvec2>& shadowMap) {
    std::vector<StageSet> sets;
    if (!shadowMap || !pipeline.request().text) return sets;
    for (const char* target :
         {"cc_shadowMap", "shadowDepth", "cc_spotShadowMap", "cc_spotLightingMap", "spotShadowDepth"})
        if (pipeline.desc().findTarget(target))
            sets.push_back({fmt::format("{}.size", target), fmt::format("[{}, {}]", shadowMap->x, shadowMap->y)});
    return sets;
}

}  // namespace

OpenedScene openScene(const SceneFile& file, const PipelineChoice& pipeline, const Log& log,
                      const SceneOptions& options) {
    const bool profile = isCocos(pipeline.desc().profile);
    OpenedScene opened;
    Problems problems;
    if (isCocosScene(file.path.string())) {
        const LoadOptions load = makeLoadOptions(pipeline.roots(), log, options);
        const auto form = profile ? cocos::MaterialForm::Effects : cocos::MaterialForm::Plain;
        auto imported = cocos::importScene(file.path, pipeline.cocos()->assets(log), form, load, problems);
        opened = {std::move(imported.scene), imported.background, setsOf(pipeline, imported.shadowMap)};
    } else {
        opened.scene = loadSceneFile(file, pipeline.roots(), log, options);
        if (profile && pipeline.cocos())
            cocos::translateMaterials(opened.scene, pipeline.cocos()->assets(log), problems);
    }
    problems.throwIfErrors();
    log.write(problems);
    return opened;
}

Scene openSceneOrSample(const std::string& nameOrPath, const PipelineChoice& pipeline, const Log& log,
                        const SceneOptions& options) {
    if (nameOrPath.empty()) return makeSampleScene();
    return openScene(findScene(pipeline.roots(), nameOrPath), pipeline, log, options).scene;
}

}  // namespace crevice
