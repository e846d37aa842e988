// The numbers of set 0 that effects are compiled with when the command line asks for it.
#pragma once

#include <string>

#include "app/commands/PipelineOptions.h"
#include "effect/EffectLibrary.h"
#include "effect/ShaderInfo.h"

namespace crevice {

/// Those of a pipeline, or without one: Cocos' names and those of `ssao-deferred`.
BindingMap effectBindings(const std::string& pipeline, const PluginOptions& plugins, const Log& log);

/// Roots for a pipeline given by path, else the standard ones.
AssetRoots effectRoots(const std::string& pipeline);

/// "uniform block", "sampler"…
const char* kindName(ResourceKind kind);

}  // namespace crevice
