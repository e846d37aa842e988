// Reads and uploads on first use.
#include "flow/FileTextures.h"

#include <filesystem>

#include <fmt/format.h>

#include "core/Image.h"
#include "gfx/Device.h"
#include "gfx/Readback.h"

namespace crevice {
namespace {

void apply(std::string_view word, const std::string& texture, SamplerKey& key) {
    const auto wrap = [&](std::string_view name, SamplerWrap to) {
        if (!word.starts_with(name)) return false;
        const std::string_view rest = word.substr(name.size());
        if (rest.empty() || rest == "-u") key.wrapU = to;
        if (rest.empty() || rest == "-v") key.wrapV = to;
        return rest.empty() || rest == "-u" || rest == "-v";
    };
    if (word == "nearest" || word == "nearest-min") key.minFilter = Filter::Nearest;
    if (word == "nearest" || word == "nearest-mag") key.magFilter = Filter::Nearest;
    const bool filter = word == "linear" || word == "nearest" || word == "nearest-min" || word == "nearest-mag";
    const bool known = filter || wrap("repeat", SamplerWrap::Repeat) || wrap("clamp", SamplerWrap::Clamp) ||
                       wrap("mirror", SamplerWrap::Mirror);
    if (!known)
        throw Error(fmt::format("'{}' behind picture '{}' says nothing of how it is sampled", word, texture),
                    "words: nearest, linear, repeat, clamp, mirror, and clamp-u, nearest-min, …");
}

}  // namespace

PictureName readPictureName(const std::string& texture) {
    PictureName name{texture,
                     {.minFilter = Filter::Linear,
                      .magFilter = Filter::Linear,
                      .wrapU = SamplerWrap::Repeat,
                      .wrapV = SamplerWrap::Repeat}};
    const std::size_t mark = texture.rfind('#');
    std::error_code failed;
    // Behind a mark in a folder's or a file's own name stands a slash or an ending, which no word has.
    const bool ofName = mark != std::string::npos && texture.find_first_of("/.", mark) != std::string::npos;
    if (mark == std::string::npos || ofName || std::filesystem::exists(texture, failed)) return name;
    name.file = texture.substr(0, mark);
    std::string_view words = std::string_view(texture).substr(mark + 1);
    while (!words.empty()) {
        const std::string_view word = words.substr(0, words.find(','));
        apply(word, name.file, name.sampler);
        words.remove_prefix(std::min(words.size(), word.size() + 1));
    }
    return name;
}

bool isPictureFile(const std::string& texture) { return std::filesystem::path(texture).has_extension(); }

const GpuTexture& FileTextures::get(const std::string& texture) {
    const std::string path = readPictureName(texture).file;
    const auto known = textures_.find(path);
    if (known != textures_.end()) return known->second;
    return textures_.emplace(path, makeTexture(device_, readImage(path), false, path)).first->second;
}

}  // namespace crevice
