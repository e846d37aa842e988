// Metallic-roughness materials in the words of Cocos' builtin-standard effect, and back.
#pragma once

#include "cocos/assets/Mtl.h"
#include "effect/EffectAsset.h"
#include "scene/Scene.h"

namespace crevice::cocos {

inline constexpr const char* kStandardEffect = "builtin-standard";

/// What the glTF importer of Cocos' editor writes: the same macros and values for every pass of the technique, of which
/// instantiate() leaves out what a pass does not know. Textures are references of the form "scene:INDEX".
Mtl makeStandardMtl(const SceneMaterial& material, const EffectAsset& standard);

/// Takes away the maps that are read with sets 2 and 3 of texture coordinates: the effect has two. Whether there were
/// any.
bool dropFurtherCoordinates(SceneMaterial& material);

/// The number in a reference that makeStandardMtl() wrote, or -1.
int sceneTextureOf(const AssetRef& ref);

/// The plain numbers of a .mtl for effects like builtin-standard: mainColor (squared: the run time's way from sRGB),
/// albedoScale, metallic, roughness, occlusion, emissive, alphaThreshold, the macro USE_ALPHA_TEST, techniques named
/// "transparent" or with the number 1, cullMode.
void readStandardMtl(const Mtl& mtl, SceneMaterial& material);

}  // namespace crevice::cocos
