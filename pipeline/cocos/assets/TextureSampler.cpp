// Words are those of the editor's importer of textures.
#include "cocos/assets/TextureSampler.h"

namespace crevice::cocos {
namespace {

TextureWrap wrapOf(const Value& userData, const char* key) {
    const Value* word = userData.isObject() ? userData.find(key) : nullptr;
    if (!word || !word->isString()) return TextureWrap::Repeat;
    if (word->string() == "clamp-to-edge" || word->string() == "clamp-to-border") return TextureWrap::Clamp;
    return word->string() == "mirrored-repeat" ? TextureWrap::Mirror : TextureWrap::Repeat;
}

std::string filterOf(const Value& userData, const char* key, const char* otherwise) {
    const Value* word = userData.isObject() ? userData.find(key) : nullptr;
    return word && word->isString() ? word->string() : otherwise;
}

}  // namespace

SamplerDesc samplerOf(const MetaAsset& asset, const MetaIndex& metas) {
    // A picture's own sampler stands in its part of kind "texture".
    const MetaAsset* texture = &asset;
    if (!asset.isSubAsset()) {
        const auto parts = metas.parts(asset.uuid, "texture");
        if (!parts.empty()) texture = parts.front();
    }
    const Value& words = texture->userData;
    const std::string mip = filterOf(words, "mipfilter", "none");
    return {.wrapU = wrapOf(words, "wrapModeS"),
            .wrapV = wrapOf(words, "wrapModeT"),
            .linearMag = filterOf(words, "magfilter", "linear") != "nearest",
            .linearMin = filterOf(words, "minfilter", "linear") != "nearest",
            .mipmaps = mip != "none",
            .linearMip = mip == "linear"};
}

std::string samplerWords(const SamplerDesc& sampler) {
    std::string words;
    const auto add = [&](std::string_view word) { words.append(words.empty() ? "#" : ",").append(word); };
    if (!sampler.linearMin && !sampler.linearMag)
        add("nearest");
    else if (!sampler.linearMin || !sampler.linearMag)
        add(sampler.linearMin ? "nearest-mag" : "nearest-min");
    const auto wrap = [&](TextureWrap mode, const char* side) {
        if (mode != TextureWrap::Repeat) add(std::string(mode == TextureWrap::Clamp ? "clamp" : "mirror") + side);
    };
    if (sampler.wrapU == sampler.wrapV) {
        wrap(sampler.wrapU, "");
    } else {
        wrap(sampler.wrapU, "-u");
        wrap(sampler.wrapV, "-v");
    }
    return words;
}

}  // namespace crevice::cocos
