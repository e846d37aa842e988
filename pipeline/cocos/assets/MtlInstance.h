// A material made ready for its effect: Cocos' rules of merging passes, macros, states and properties.
#pragma once

#include <functional>
#include <string>

#include "cocos/assets/Mtl.h"
#include "effect/EffectAsset.h"
#include "scene/Scene.h"

namespace crevice::cocos {

/// Turns a texture reference into what a property holds: the index of a scene texture, the name of a built-in one, or
/// null = the property keeps its default. `property` is the one it feeds.
using TextureUser = std::function<Value(const AssetRef& texture, const EffectProperty& property)>;

/// What Material._createPasses and _update of the engine do, by the pass' number in the technique:
///  - macros: the pass' own, over them those of the pass that `propertyIndex` names, over them `embeddedMacros` (these
///    are left out of the result: the effect has them);
///  - states as written, to go over those of the effect;
///  - properties: the pass' own, over them those of the `propertyIndex` pass; null and unknown names are left out; a
///    name may also be the uniform that properties feed. Colours keep the numbers of the file, / 255: squaring those of
///    `linear` properties is the material's business.
/// Values longer than their uniform are cut, shorter ones padded with 0. Errors name the place in the .mtl.
MaterialEffect instantiate(const Mtl& mtl, const EffectAsset& asset, const std::string& effectName,
                           const TextureUser& textures, Problems& problems);

/// JavaScript's truth: false, 0, "" and null are not.
bool isTruthy(const Value& value);
/// A pass with `switch` is drawn only when that macro is truthy, its embedded macros counted.
bool isDropped(const EffectPass& pass, const Value& defines);

}  // namespace crevice::cocos
