// The images that materials use, decoded in parallel, with the samplers they are read through.
#include <algorithm>
#include <atomic>
#include <thread>

#include <fmt/format.h>

#include "core/Picture.h"
#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

// Words of OpenGL, as in samplers.
constexpr int kNearest = 9728, kLinear = 9729, kNearestMipNearest = 9984, kLinearMipNearest = 9985;
constexpr int kNearestMipLinear = 9986, kClampToEdge = 33071, kMirroredRepeat = 33648;

Image white() {
    Image image(1, 1, Format::RGBA8);
    std::fill(image.pixels.begin(), image.pixels.end(), std::byte(255));
    return image;
}

/// A picture, or why there is none.
struct Picture {
    std::optional<Image> image{};
    std::string problem{};
};

std::string nameOf(const ImagePart& image, int index) {
    if (!image.name.empty()) return image.name;
    return image.uri.empty() || image.uri.starts_with("data:") ? fmt::format("image {}", index) : shortened(image.uri);
}

// What can be said before decoding: empty = fine. `bytesLeft` is the budget of decoded pixels, of which each texture
// has its own.
std::string refuse(const ImagePart& encoded, int index, const Limits& limits, std::size_t textures,
                   std::size_t& bytesLeft) {
    if (encoded.bytes.empty()) return "there is no picture";
    const auto header = readPictureHeader(encoded.bytes);
    if (!header) return "the picture is neither PNG, JPEG nor WebP, or broken";
    try {
        checkPictureSize(*header, encoded.bytes.size(), nameOf(encoded, index), limits);
    } catch (const Error& failure) {
        return failure.what();
    }
    const std::size_t bytes = std::size_t(4) * header->width * header->height;
    if (bytes > bytesLeft / textures) return "all pictures together are beyond the limit; " + raiseLimit("image-bytes");
    bytesLeft -= bytes * textures;
    return {};
}

Picture decodeOne(const ImagePart& encoded, const Limits& limits) {
    try {
        return {decodePicture(encoded.bytes, nameOf(encoded, 0), limits), {}};
    } catch (const std::exception& failure) {
        return {std::nullopt, failure.what()};
    }
}

SamplerDesc readSampler(const File& file, int index) {
    SamplerDesc to;
    if (index < 0) return to;
    const Value& from = file.item("samplers", std::size_t(index));
    const auto wrap = [&](const char* key) {
        const int mode = intOr(from, key);
        return mode == kClampToEdge      ? TextureWrap::Clamp
               : mode == kMirroredRepeat ? TextureWrap::Mirror
                                         : TextureWrap::Repeat;
    };
    to.wrapU = wrap("wrapS");
    to.wrapV = wrap("wrapT");
    to.linearMag = intOr(from, "magFilter") != kNearest;
    const int min = intOr(from, "minFilter");
    to.linearMin = min != kNearest && min != kNearestMipNearest && min != kNearestMipLinear;
    to.mipmaps = min != kNearest && min != kLinear;
    to.linearMip = min != kNearestMipNearest && min != kLinearMipNearest;
    return to;
}

void decodeAll(const File& file, std::vector<std::pair<const ImagePart*, Picture*>>& jobs) {
    std::atomic<std::size_t> next = 0;
    const auto takeOne = [&] {
        const std::size_t job = next++;
        if (job >= jobs.size()) return false;
        *jobs[job].second = decodeOne(*jobs[job].first, file.options.limits);
        return true;
    };
    std::vector<std::jthread> helpers;
    const std::size_t count = std::min<std::size_t>(jobs.size(), std::max(1u, std::thread::hardware_concurrency()));
    for (std::size_t i = 1; i < count; ++i)
        helpers.emplace_back([&] {
            while (takeOne()) {
            }
        });
    do {
        file.tell("decoding pictures", jobs.empty() ? 1 : double(next) / double(jobs.size()));
    } while (takeOne());
}

}  // namespace

Images::Images(const File& file) : file_(file), bytesLeft_(file.options.limits.maxImageBytes) {}

int Images::use(int texture, bool srgb, std::string_view user) {
    const TexturePart& from = file_.model.textures[std::size_t(texture)];
    // EXT_texture_webp: `source` is what those who cannot read WebP show.
    const int source = from.webp >= 0 ? from.webp : from.source;
    if (source < 0) {
        file_.warn("textures", std::size_t(texture),
                   fmt::format("has no PNG, JPEG or WebP 'source'; {} is left out", user));
        return -1;
    }
    // Images of the same bytes are one, or a small file could have a big picture decoded any number of times.
    const std::span<const std::byte> bytes = file_.model.images[std::size_t(source)].bytes;
    const int first =
        bytes.empty() ? source : sources_.emplace(std::pair(bytes.data(), bytes.size()), source).first->second;
    const Key key{first, samplerLike(from.sampler), srgb};
    const auto [entry, isNew] = indices_.emplace(key, int(keys_.size()));
    if (isNew) keys_.push_back(key);
    return entry->second;
}

// The first sampler that reads pictures in the same way: there are few ways.
int Images::samplerLike(int sampler) {
    const SamplerDesc wanted = readSampler(file_, sampler);
    for (const auto& [desc, index] : samplers_)
        if (desc == wanted) return index;
    samplers_.emplace_back(wanted, sampler);
    return sampler;
}

// Pictures that overlap in the file's bytes would be decoded far more often than it is long.
void Images::checkTotal() const {
    constexpr std::size_t kFree = std::size_t(1) << 20;
    const std::size_t most = kFree + 2 * file_.bytesHeld;
    std::size_t total = 0;
    for (const auto& [bytes, image] : sources_) {
        total += bytes.second;
        if (total > most)
            file_.fail("images", std::size_t(image),
                       "the pictures share their bytes, so that they are longer than all files",
                       "give each picture a buffer view of its own");
    }
}

std::vector<SceneTexture> Images::decode() {
    checkTotal();
    std::map<int, Picture> decoded;
    std::map<int, std::size_t> usesLeft;
    for (const Key& key : keys_) {
        decoded[std::get<0>(key)];
        ++usesLeft[std::get<0>(key)];
    }
    std::vector<std::pair<const ImagePart*, Picture*>> jobs;
    for (auto& [index, result] : decoded) {
        const ImagePart& image = file_.model.images[std::size_t(index)];
        result.problem = refuse(image, index, file_.options.limits, usesLeft[index], bytesLeft_);
        if (result.problem.empty()) jobs.emplace_back(&image, &result);
    }
    decodeAll(file_, jobs);

    for (const auto& [index, result] : decoded) {
        const ImagePart& image = file_.model.images[std::size_t(index)];
        const bool told = image.bytes.empty() && !image.uri.empty() && !image.uri.starts_with("data:");
        if (!result.image && !told) file_.lack("images", std::size_t(index), result.problem + ": shown white");
    }
    std::vector<SceneTexture> textures;
    for (const auto& [image, sampler, srgb] : keys_) {
        Picture& result = decoded.at(image);
        const bool isLast = --usesLeft[image] == 0;  // takes the pixels; others copy them
        if (!result.image) broken_.insert(int(textures.size()));
        textures.push_back({.name = nameOf(file_.model.images[std::size_t(image)], image),
                            .image = !result.image ? white()
                                     : isLast      ? std::move(*result.image)
                                                   : *result.image,
                            .srgb = srgb,
                            .sampler = readSampler(file_, sampler)});
    }
    return textures;
}

}  // namespace crevice::gltf
