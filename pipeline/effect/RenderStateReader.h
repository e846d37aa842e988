// Reads the fixed-function states of a pass: primitive, rasterizerState, depthStencilState, blendState.
#pragma once

#include "core/RenderState.h"
#include "effect/EffectHeader.h"

namespace crevice {

/// Takes the state keys from a pass. States that Crevice does not draw with are accepted at Cocos' defaults only.
RenderState readRenderState(KeyReader& pass);

}  // namespace crevice
