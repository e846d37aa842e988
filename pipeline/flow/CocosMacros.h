// Macros that a Cocos pipeline and its scene give every effect.
#pragma once

#include <string>
#include <string_view>

#include "effect/Defines.h"
#include "plan/PipelineDesc.h"
#include "scene/Scene.h"

namespace crevice {

/// The document's macro CC_USE_HDR; without one, off for 3.3 (its lighting tone-maps) and on for 3.6.
bool cocosHdr(const PipelineDesc& desc);

/// The enabled ShadowStage for this light ("directional" or "spot"), or null.
const StageDesc* shadowStage(const PipelineDesc& desc, std::string_view light);
/// Whether it has a map to draw into.
bool drawsShadows(const PipelineDesc& desc, std::string_view light);
/// Names of the maps, and of the depth buffers that a document keeps beside them.
std::string_view shadowMapName(Profile profile, bool spot);
inline std::string_view shadowDepthName(bool spot) { return spot ? "spotShadowDepth" : "shadowDepth"; }

/// Over the materials': CC_PIPELINE_TYPE, CC_USE_HDR; fog, environment and shadows as the scene has them (null: none of
/// them); then the document's own "macros".
Defines pipelineMacros(const PipelineDesc& desc, const Scene* scene);

/// A macro's value in a document as text. Throws Error for what is no bool, integer or word.
std::string defineText(const Value& value, const std::string& name);

}  // namespace crevice
