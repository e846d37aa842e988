// Which uniform a property feeds, and which of its components: "tilingOffset.zw" in an effect's header.
#pragma once

#include <string>

#include "effect/EffectAsset.h"

namespace crevice {

/// The target without the swizzle, else the property's own name.
std::string uniformOf(const EffectProperty& property);
/// "zw"; empty for all components.
std::string swizzleOf(const EffectProperty& property);
/// The first component of a run such as "yz" or "gb": 1. 0 for an empty one, -1 when it is none.
int firstComponent(const std::string& swizzle);

}  // namespace crevice
