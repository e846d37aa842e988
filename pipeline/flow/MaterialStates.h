// Fixed-function states that a material lays over those of its effect's pass.
#pragma once

#include "core/Document.h"
#include "core/RenderState.h"

namespace crevice {

/// `states`: null, or an object with the keys of an effect's pass (rasterizerState, depthStencilState, blendState,
/// primitive, priority); enums by name, or by Cocos' number as in .mtl files. Keys it does not draw with are skipped;
/// blend targets are merged one by one. Reports unknown words.
RenderState withStates(RenderState state, const Value& states, Problems& problems);
/// The material's own priority, or the pass'.
int priorityOf(int passPriority, const Value& states);

}  // namespace crevice
