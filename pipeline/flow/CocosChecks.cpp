// Compares what queues take with what materials offer.
#include "flow/CocosChecks.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/Text.h"
#include "flow/RenderStage.h"

namespace crevice {
namespace {

std::set<std::string> phasesOf(const SceneMaterial& material, EffectLibrary& library) {
    std::set<std::string> phases;
    const EffectAsset& asset = library.asset(material.effect->effect);
    if (material.effect->technique >= asset.techniques.size()) return phases;  // reported where queues are compiled
    for (const EffectPass& pass : asset.techniques[material.effect->technique].passes) phases.insert(pass.phase);
    return phases;
}

std::string quoted(const std::set<std::string>& words) {
    return "'" + join(std::vector<std::string>(words.begin(), words.end()), "', '") + "'";
}

std::set<int> usedMaterials(const Scene& scene) {
    std::set<int> used;
    for (const Instance& instance : scene.instances)
        if (scene.materials[std::size_t(instance.material)].effect) used.insert(instance.material);
    return used;
}

void reportQueues(const std::vector<StageProgram>& stages, const std::set<std::string>& phases, Problems& problems) {
    for (const StageProgram& stage : stages) {
        for (const QueueProgram& queue : stage.queues) {
            const QueueDesc& desc = queue.declaration.queue;
            const std::set<std::string> wanted(desc.phases.begin(), desc.phases.end());
            const bool known =
                std::any_of(wanted.begin(), wanted.end(), [&](const auto& phase) { return phases.contains(phase); });
            // Scenes without casters, and lights that are all drawn at once, are common.
            if (known || !stage.desc->enabled || queue.declaration.casters || queue.declaration.perLight) continue;
            problems.warning(
                desc.where.line ? desc.where : stage.desc->where,
                fmt::format("the queue of stage '{}' takes the phases {}, and no material of the scene has "
                            "a pass of such a phase: it draws nothing",
                            stage.desc->name, quoted(wanted)),
                "the materials' passes have the phases " + quoted(phases));
        }
    }
}

bool isDrawn(const std::vector<StageProgram>& stages, int material) {
    for (const StageProgram& stage : stages)
        for (const QueueProgram& queue : stage.queues)
            for (std::size_t kind = 0; kind < kSurfaceKinds; ++kind)
                if (stage.desc->enabled && queue.surfaces[std::size_t(material) * kSurfaceKinds + kind].variant)
                    return true;
    return false;
}

}  // namespace

void reportUndrawn(const PipelineDesc& desc, const std::vector<StageProgram>& stages, const Scene& scene,
                   EffectLibrary& library, Problems& problems) {
    const std::set<int> used = usedMaterials(scene);
    std::set<std::string> phases;
    for (const int material : used) phases.merge(phasesOf(scene.materials[std::size_t(material)], library));
    if (used.empty()) return;
    reportQueues(stages, phases, problems);
    for (const int material : used) {
        if (isDrawn(stages, material)) continue;
        const SceneMaterial& undrawn = scene.materials[std::size_t(material)];
        problems.warning({},
                         fmt::format("material '{}' is drawn by no queue of pipeline '{}'", undrawn.name, desc.name),
                         fmt::format("its effect '{}' has passes of the phases {}", undrawn.effect->effect,
                                     quoted(phasesOf(undrawn, library))));
    }
}

}  // namespace crevice
