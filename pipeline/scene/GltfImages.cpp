// Decodes the images that materials use, in parallel.
#include <algorithm>
#include <atomic>
#include <set>
#include <span>
#include <thread>

#include <fmt/format.h>

#include "core/Picture.h"
#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

Image white() {
    Image image(1, 1, Format::RGBA8);
    std::fill(image.pixels.begin(), image.pixels.end(), std::byte(255));
    return image;
}

/// A picture, or why there is none.
struct Decoded {
    std::optional<Image> image;
    std::string problem;
};

std::span<const std::byte> bytesOf(const tinygltf::Image& encoded) { return std::as_bytes(std::span(encoded.image)); }

std::string nameOf(const tinygltf::Image& image, int index) {
    if (!image.name.empty()) return image.name;
    return image.uri.empty() || image.uri.starts_with("data:") ? fmt::format("image {}", index) : image.uri;
}

Decoded decodeImage(const tinygltf::Image& encoded, int index, const Limits& limits) {
    try {
        return {decodePicture(bytesOf(encoded), nameOf(encoded, index), limits), {}};
    } catch (const std::exception& failure) {
        return {std::nullopt, failure.what()};
    }
}

// What can be said before decoding: empty = fine. `bytesLeft` is the budget of decoded pixels.
std::string refuse(const tinygltf::Image& encoded, int index, const Limits& limits, std::size_t& bytesLeft) {
    if (encoded.image.empty()) return "there is no picture";
    const auto header = readPictureHeader(bytesOf(encoded));
    if (!header) return "the picture is neither PNG, JPEG nor WebP, or broken";
    try {
        checkPictureSize(*header, encoded.image.size(), nameOf(encoded, index), limits);
    } catch (const Error& failure) {
        return failure.what();
    }
    const std::size_t bytes = std::size_t(4) * header->width * header->height;
    if (bytes > bytesLeft) return "all pictures together are beyond the limit; " + raiseLimit("image-bytes");
    bytesLeft -= bytes;
    return {};
}

SamplerDesc readSampler(const File& file, int index) {
    SamplerDesc to;
    if (index < 0 || std::size_t(index) >= file.model.samplers.size()) return to;
    const tinygltf::Sampler& from = file.model.samplers[index];
    const auto wrap = [](int mode) {
        return mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? TextureWrap::Clamp
               : mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? TextureWrap::Mirror
                                                               : TextureWrap::Repeat;
    };
    to.wrapU = wrap(from.wrapS);
    to.wrapV = wrap(from.wrapT);
    to.linearMag = from.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
    const int min = from.minFilter;
    to.linearMin = min != TINYGLTF_TEXTURE_FILTER_NEAREST && min != TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST &&
                   min != TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
    to.mipmaps = min != TINYGLTF_TEXTURE_FILTER_NEAREST && min != TINYGLTF_TEXTURE_FILTER_LINEAR;
    to.linearMip =
        min != TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST && min != TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST;
    return to;
}

}  // namespace

int Images::use(int texture, bool srgb, std::string_view user) {
    if (std::size_t(texture) >= file_.model.textures.size())
        throw Error(SourceLoc{file_.name},
                    fmt::format("{}: names textures[{}], the file has {}", user, texture, file_.model.textures.size()),
                    "textures count from 0");
    const tinygltf::Texture& from = file_.model.textures[texture];
    if (from.source < 0) {
        file_.warn("textures", texture, fmt::format("has no PNG or JPEG 'source'; {} is left out", user));
        return -1;
    }
    if (std::size_t(from.source) >= file_.model.images.size())
        file_.fail("textures", texture,
                   fmt::format("'source' is {}, the file has {} images", from.source, file_.model.images.size()));
    const Key key{from.source, from.sampler, srgb};
    const auto [entry, isNew] = indices_.emplace(key, int(keys_.size()));
    if (isNew) keys_.push_back(key);
    return entry->second;
}

std::vector<SceneTexture> Images::decode() const {
    std::set<int> used;
    for (const Key& key : keys_) used.insert(std::get<0>(key));

    std::map<int, Decoded> decoded;
    std::vector<std::pair<int, Decoded*>> jobs;
    const Limits& limits = file_.options.limits;
    std::size_t bytesLeft = limits.maxImageBytes;
    for (const int index : used) {
        const tinygltf::Image& image = file_.model.images[index];
        Decoded& result = decoded[index];
        result.problem = refuse(image, index, limits, bytesLeft);
        if (result.problem.empty()) jobs.emplace_back(index, &result);
    }
    {
        std::atomic<std::size_t> next = 0;
        std::vector<std::jthread> workers;
        const std::size_t count = std::min<std::size_t>(jobs.size(), std::max(1u, std::thread::hardware_concurrency()));
        for (std::size_t i = 0; i < count; ++i)
            workers.emplace_back([&] {
                for (std::size_t job = next++; job < jobs.size(); job = next++)
                    *jobs[job].second = decodeImage(file_.model.images[jobs[job].first], jobs[job].first, limits);
            });
    }

    std::vector<SceneTexture> textures;
    for (const auto& [index, result] : decoded)
        if (!result.image && !(file_.model.images[index].image.empty() && !file_.model.images[index].uri.empty()))
            file_.warn("images", index, result.problem + ": shown white");
    std::map<int, std::size_t> usesLeft;
    for (const Key& key : keys_) ++usesLeft[std::get<0>(key)];
    for (const auto& [image, sampler, srgb] : keys_) {
        Decoded& result = decoded.at(image);
        const bool isLast = --usesLeft[image] == 0;  // takes the pixels; others copy them
        textures.push_back({.name = nameOf(file_.model.images[image], image),
                            .image = !result.image ? white()
                                     : isLast      ? std::move(*result.image)
                                                   : *result.image,
                            .srgb = srgb,
                            .sampler = readSampler(file_, sampler)});
    }
    return textures;
}

}  // namespace crevice::gltf
