// What identifies a variant: the request for it, and all that it is compiled from.
#pragma once

#include "effect/EffectLibrary.h"
#include "effect/ShaderCompiler.h"

namespace crevice {

/// Everything of a request that can change the answer, as one text.
std::string requestKey(const VariantRequest& request, const BindingMap& bindings, std::uint64_t generation);

/// A hash over everything that a compiled pass is made of: the compiler's version, the texts with their places, and the
/// numbers of the names that the texts contain.
std::string contentKey(const std::vector<StageSource>& sources, const BindingMap& bindings);

/// "ssao|fullscreen-vs|ssao-fs"
std::string variantName(const std::string& effect, const EffectPass& pass);

}  // namespace crevice
