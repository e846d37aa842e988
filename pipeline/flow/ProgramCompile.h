// Compiles a stage's draws and a queue's surfaces: effect + macros + material → variants, values and wires.
#pragma once

#include "flow/FrameProgram.h"
#include "flow/SceneDefines.h"

namespace crevice {

class ProgramCompiler {
public:
    /// `sceneDefines`: see frameDefines(). Those of our own dialect are offered to every effect; under a Cocos profile
    /// they are over what stages and materials say.
    ProgramCompiler(const PipelineDesc& desc, EffectLibrary& library, const GlobalLayout& globals,
                    Defines sceneDefines);

    void compileDraws(StageProgram& stage, Problems& problems);
    /// Every material of the scene that the queue's phase and order take.
    void compileQueue(const StageProgram& stage, QueueProgram& queue, const Scene& scene, Problems& problems);

private:
    struct PassChoice {
        std::size_t technique = 0, pass = 0;
    };

    const EffectVariant& compile(const StageProgram& stage, const std::string& effect, PassChoice choice,
                                 const Defines& offered);
    SurfaceProgram compileSurface(const StageProgram& stage, const QueueDeclaration& queue,
                                  const SceneMaterial& material, bool hasTangents, Problems& problems);
    SurfaceProgram compileEffectSurface(const StageProgram& stage, const QueueDeclaration& queue,
                                        const MaterialEffect& material, Problems& problems);
    const EffectTechnique& techniqueOf(const StageProgram& stage, const MaterialEffect& material);
    bool choosePass(const StageProgram& stage, const QueueDeclaration& queue, AlphaMode mode, PassChoice& choice);
    void checkNumbers(const StageProgram& stage, const EffectVariant& variant, Problems& problems) const;
    void checkBlocks(const StageProgram& stage, const EffectVariant& variant, Problems& problems) const;

    const PipelineDesc& desc_;
    EffectLibrary& library_;
    const GlobalLayout& globals_;
    Defines macros_;  ///< The pipeline's own, over those of stages and materials.
    Defines sceneDefines_;
};

/// Macros that follow from the pipeline, the shadow maps it fills, and the scene (null: none).
Defines frameDefines(const PipelineDesc& desc, const Scene* scene, ShadowMaps maps);

}  // namespace crevice
