// How a texture of a Cocos project is sampled: the words of its meta.
#pragma once

#include <string>

#include "cocos/files/MetaIndex.h"
#include "scene/Scene.h"

namespace crevice::cocos {

/// Of a texture, or of the part of kind "texture" that a picture has. Without words: repeated, linear, no mips.
SamplerDesc samplerOf(const MetaAsset& asset, const MetaIndex& metas);

/// What stands behind a picture's name in a document, "#nearest,clamp-u"; empty for linear and repeated ones. Mips are
/// not said.
std::string samplerWords(const SamplerDesc& sampler);

}  // namespace crevice::cocos
