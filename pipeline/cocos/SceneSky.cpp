// Pictures of skies are decoded as the engine's sky effect does.
#include "cocos/SceneSky.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/Image.h"
#include "core/LimitedFiles.h"
#include "core/Picture.h"
#include "core/Text.h"
#include "scene/PanoramaSize.h"

namespace crevice::cocos {
namespace {

std::string endingOf(const std::filesystem::path& path) { return lowerCase(path.extension().string()); }

bool isRadiance(const std::string& ending) { return ending == ".hdr" || ending == ".exr"; }

bool isPackedRgbe(const MetaAsset& asset) {
    const Value* flag = asset.userData.isObject() ? asset.userData.find("isRGBE") : nullptr;
    return flag && flag->isBool() && flag->boolean();
}

/// Source of both rules: the engine's chunks (unpackRGBE, SRGBToLinear). Its exponents count powers of 1.1 for finer
/// steps; those of Radiance's .hdr are powers of 2.
Image decoded(const Image& stored, bool rgbe) {
    constexpr float kExponentBase = 1.1f, kExponentBias = 128;
    Image out(stored.width, stored.height, Format::RGBA32F);
    for (std::uint32_t y = 0; y < stored.height; ++y) {
        for (std::uint32_t x = 0; x < stored.width; ++x) {
            const glm::vec4 texel = stored.at(x, y);
            const glm::vec3 color(texel);
            const glm::vec3 radiance =
                rgbe ? color * std::pow(kExponentBase, texel.w * 255.0f - kExponentBias) : color * color;
            const float values[4] = {radiance.x, radiance.y, radiance.z, 1};
            std::memcpy(out.pixels.data() + (std::size_t(y) * stored.width + x) * sizeof values, values, sizeof values);
        }
    }
    return out;
}

/// Its size is judged by its header, before anything is decoded.
Image readPanorama(const std::filesystem::path& path, const Limits& limits) {
    const std::string name = path.filename().string();
    const std::vector<std::byte> bytes = readBytesWithin(path, limits.maxFileBytes);
    const auto header = readPictureHeader(bytes);
    if (header) checkPanoramaSize(header->width, header->height, name, limits);
    Image image = header ? decodePicture(bytes, path.string(), limits) : readImage(path, limits);
    checkPanoramaSize(image.width, image.height, name, limits);
    return image;
}

}  // namespace

bool isPanorama(const std::filesystem::path& path) {
    static constexpr std::string_view kEndings[] = {".hdr", ".exr", ".png", ".jpg", ".jpeg", ".webp"};
    return std::find(std::begin(kEndings), std::end(kEndings), endingOf(path)) != std::end(kEndings);
}

Environment readSky(const MetaAsset& asset, const Log& log, const Limits& limits) {
    if (isRadiance(endingOf(asset.path))) return loadEnvironment(asset.path, log, limits);
    const Image stored = readPanorama(asset.path, limits);
    return makeEnvironment(decoded(stored, isPackedRgbe(asset)), asset.path.filename().string(), log);
}

}  // namespace crevice::cocos
