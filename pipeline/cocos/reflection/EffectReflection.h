// A whole effect in Cocos' terms, as the engine loads it: techniques with passes, and the shaders they name.
#pragma once

#include "cocos/CocosEffects.h"
#include "cocos/reflection/Reflection.h"

namespace crevice::cocos {

/// `{ name, techniques: [ { name, passes } ], shaders }`. Passes with the same programs share a shader. A pass whose
/// programs cannot be read leaves its shader out and its mistakes in `problems`.
Value reflectEffect(CocosEffects& effects, const EffectAsset& effect, Problems& problems);

/// `effect|vertex|fragment` or `effect|compute`: the engine's name of a pass' shader.
std::string shaderName(const EffectAsset& effect, const EffectPass& pass);

}  // namespace crevice::cocos
