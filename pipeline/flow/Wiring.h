// Names in a stage's shaders → targets and textures: who feeds which sampler of set 1, and what a shader therefore
// reads.
#pragma once

#include <vector>

#include "effect/Material.h"
#include "flow/FrameProgram.h"

namespace crevice {

/// What the wiring of one shader is made from.
struct WiringInputs {
    const PipelineDesc& pipeline;
    const StageDesc& stage;
    const EffectVariant& variant;
    const Material& material;
    const std::vector<TargetWrite>& writes;
    bool sceneTextures = false;  ///< Texture properties may be filled by the scene's material.
    const std::vector<std::pair<std::uint32_t, std::string>>* inputs = nullptr;  ///< Number in set 1 → target.
};

/// Wires every sampler and image of set 1: by the stage's "reads", else to the target of the same name, else to the
/// texture of the material's property; images that are written, to the stage's writes. Reports those bound to nothing.
/// In a Cocos profile: by "reads", to a private target of the same name, by number, to the property's texture, by the
/// fallback to the target of set 0 with its name (a warning each), else to the default texture.
std::vector<Wire> wireShader(const WiringInputs& inputs, Problems& problems);

/// Targets that the shader statically uses: set 0 by name, set 1 by wire.
std::vector<TargetRead> findReads(const PipelineDesc& pipeline, const EffectVariant& variant,
                                  const std::vector<Wire>& wires);

/// "name@2" → the level; -1 = all levels.
std::pair<std::string, int> splitTarget(const std::string& target);

}  // namespace crevice
