// Decodes the images that materials use, in parallel, through tinygltf's image loader.
#include <algorithm>
#include <atomic>
#include <cstring>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

struct Size {
    std::uint32_t width = 0, height = 0;
};

std::uint32_t bigEndian(const std::vector<unsigned char>& bytes, std::size_t offset, int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) value = value << 8 | bytes[offset + i];
    return value;
}

// PNG specification (ISO 15948), 11.2.2 "IHDR": width and height follow the signature, the length and the name.
std::optional<Size> sizeOfPng(const std::vector<unsigned char>& bytes) {
    static constexpr unsigned char kSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    if (bytes.size() < 24 || std::memcmp(bytes.data(), kSignature, sizeof kSignature) != 0) return std::nullopt;
    return Size{bigEndian(bytes, 16, 4), bigEndian(bytes, 20, 4)};
}

// ITU-T T.81, B.2.2: a frame header SOF0 … SOF15 (not the tables 4, 8, 12) holds height and width.
std::optional<Size> sizeOfJpeg(const std::vector<unsigned char>& bytes) {
    if (bytes.size() < 4 || bytes[0] != 0xff || bytes[1] != 0xd8) return std::nullopt;
    for (std::size_t at = 2; at + 9 <= bytes.size();) {
        if (bytes[at] != 0xff) return std::nullopt;
        const unsigned marker = bytes[at + 1];
        if (marker == 0xff) {
            ++at;
            continue;
        }
        if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc)
            return Size{bigEndian(bytes, at + 7, 2), bigEndian(bytes, at + 5, 2)};
        at += 2 + bigEndian(bytes, at + 2, 2);
    }
    return std::nullopt;
}

std::optional<Size> sizeOfImage(const std::vector<unsigned char>& bytes) {
    const auto png = sizeOfPng(bytes);
    return png ? png : sizeOfJpeg(bytes);
}

// tinygltf gives four channels of 8 or 16 bits.
Image toRgba8(const tinygltf::Image& decoded) {
    Image image(decoded.width, decoded.height, Format::RGBA8);
    if (decoded.bits != 16) {
        std::memcpy(image.pixels.data(), decoded.image.data(), image.pixels.size());
        return image;
    }
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        std::uint16_t value;
        std::memcpy(&value, decoded.image.data() + 2 * i, sizeof value);
        image.pixels[i] = std::byte((value * 255u + 32767u) / 65535u);
    }
    return image;
}

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

Decoded decodeImage(const tinygltf::Image& encoded) {
    try {
        tinygltf::Image decoded;
        std::string errors, warnings;
        if (!tinygltf::LoadImageData(&decoded, 0, &errors, &warnings, 0, 0, encoded.image.data(),
                                     int(encoded.image.size()), nullptr) ||
            decoded.component != 4 || (decoded.bits != 8 && decoded.bits != 16))
            return {std::nullopt, "the picture is broken"};
        return {toRgba8(decoded), {}};
    } catch (const std::exception& failure) {
        return {std::nullopt, failure.what()};
    }
}

// What can be said before decoding: empty = fine. `bytesLeft` is the budget of decoded pixels.
std::string refuse(const tinygltf::Image& encoded, const LoadLimits& limits, std::size_t& bytesLeft) {
    if (encoded.image.empty()) return "there is no picture";
    const auto size = sizeOfImage(encoded.image);
    if (!size) return "the picture is neither PNG nor JPEG, or broken";
    if (size->width == 0 || size->height == 0 || size->width > limits.maxImageSide ||
        size->height > limits.maxImageSide)
        return fmt::format("{} x {} pixels are beyond the limit of {} a side", size->width, size->height,
                           limits.maxImageSide);
    const std::size_t bytes = std::size_t(4) * size->width * size->height;
    if (bytes > bytesLeft) return "all pictures together are beyond the limit";
    bytesLeft -= bytes;
    return {};
}

std::string nameOf(const tinygltf::Image& image, int index) {
    if (!image.name.empty()) return image.name;
    return image.uri.empty() || image.uri.starts_with("data:") ? fmt::format("image {}", index) : image.uri;
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
    std::vector<std::pair<const tinygltf::Image*, Decoded*>> jobs;
    std::size_t bytesLeft = file_.options.limits.maxImageBytes;
    for (const int index : used) {
        const tinygltf::Image& image = file_.model.images[index];
        Decoded& result = decoded[index];
        result.problem = refuse(image, file_.options.limits, bytesLeft);
        if (result.problem.empty()) jobs.emplace_back(&image, &result);
    }
    {
        std::atomic<std::size_t> next = 0;
        std::vector<std::jthread> workers;
        const std::size_t count = std::min<std::size_t>(jobs.size(), std::max(1u, std::thread::hardware_concurrency()));
        for (std::size_t i = 0; i < count; ++i)
            workers.emplace_back([&] {
                for (std::size_t job = next++; job < jobs.size(); job = next++)
                    *jobs[job].second = decodeImage(*jobs[job].first);
            });
    }

    std::vector<SceneTexture> textures;
    for (const auto& [index, result] : decoded)
        if (!result.image && !(file_.model.images[index].image.empty() && !file_.model.images[index].uri.empty()))
            file_.warn("images", index, result.problem + ": shown white");
    for (const auto& [image, sampler, srgb] : keys_) {
        const Decoded& result = decoded.at(image);
        textures.push_back({.name = nameOf(file_.model.images[image], image),
                            .image = result.image ? *result.image : white(),
                            .srgb = srgb,
                            .sampler = readSampler(file_, sampler)});
    }
    return textures;
}

}  // namespace crevice::gltf
