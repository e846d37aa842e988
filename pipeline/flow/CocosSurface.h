// How a material that names its effect meets a queue of a Cocos profile: which passes are drawn, with which macros,
// states and values.
#pragma once

#include <string>
#include <vector>

#include "effect/Defines.h"
#include "effect/Material.h"
#include "plan/PipelineDesc.h"
#include "scene/Scene.h"

namespace crevice {

/// A pass of a material that a queue takes.
struct ChosenPass {
    std::size_t pass = 0;  ///< In the technique.
    RenderState state;
    std::uint32_t order = 0;  ///< Cocos' sort key: priority << 16 | sub-model's priority << 8 | pass.
};

/// The passes with one of the queue's phases whose first blend target blends as the queue's order says; those that
/// belong to a render graph or whose `switch` macro is off are not drawn. Several passes of one material all draw.
std::vector<ChosenPass> choosePasses(const EffectTechnique& technique, const MaterialEffect& material,
                                     const QueueDesc& queue, Problems& problems);

/// Macros of a material's pass as text; bools are 1 and 0.
Defines materialDefines(const MaterialEffect& material, std::size_t pass);

/// What a material says of one pass, as the effect's properties take it: textures of the scene apart, values of
/// `linear` properties squared (Cocos' conversion from sRGB), names that the pass does not have left out.
struct PassValues {
    Value numbers;                                             ///< And keywords of textures.
    std::vector<std::pair<std::string, TextureRef>> textures;  ///< Sampler → texture of the scene.
};
PassValues passValues(const Value& properties, const EffectPass& pass);

}  // namespace crevice
