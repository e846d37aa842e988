// Pictures of skies are decoded as the engine's sky effect does.
#include "cocos/scene/SceneSky.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "cocos/scene/SkyFaces.h"
#include "core/Error.h"
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

/// Throws Error when the panorama of these faces would be too large.
void checkFaceSize(std::uint64_t side, const std::string& name, const Limits& limits) {
    checkPanoramaSize(4 * side, 2 * side, name, limits);
}

void checkSkySize(std::uint64_t width, std::uint64_t height, const std::string& name, const Limits& limits) {
    if (const auto layout = faceLayout(width, height)) return checkFaceSize(width / layout->columns, name, limits);
    checkPanoramaSize(width, height, name, limits);
}

/// Its size is judged by its header, before anything is decoded.
template <class CheckSize>
Image readSkyPicture(const std::filesystem::path& path, const Limits& limits, CheckSize check) {
    const std::string name = path.filename().string();
    const std::vector<std::byte> bytes = readBytesWithin(path, limits.maxFileBytes);
    const auto header = readPictureHeader(bytes);
    if (header) check(header->width, header->height, name, limits);
    Image image = header ? decodePicture(bytes, path.string(), limits) : readImage(path, limits);
    check(image.width, image.height, name, limits);
    return image;
}

Image radianceOf(const Image& stored, const std::filesystem::path& path, bool rgbe) {
    return isRadiance(endingOf(path)) ? stored : decoded(stored, rgbe);
}

Image readFaces(const MetaAsset& cube, const std::array<const MetaAsset*, 6>& assets, const Limits& limits) {
    const auto checkSquare = [](std::uint64_t width, std::uint64_t height, const std::string& name,
                                const Limits& most) {
        if (width != height || width == 0)
            throw Error(fmt::format("face '{}' of a sky has {} x {} pixels", name, width, height),
                        "faces are squares of one size");
        checkFaceSize(width, name, most);
    };
    std::array<Image, 6> faces;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const std::filesystem::path& path = assets[i]->path;
        faces[i] = radianceOf(readSkyPicture(path, limits, checkSquare), path, isPackedRgbe(cube));
        if (faces[i].width == faces[0].width) continue;
        throw Error(fmt::format("face '{}' of a sky has {} pixels a side, the first {}", path.filename().string(),
                                faces[i].width, faces[0].width),
                    "faces are squares of one size");
    }
    return panoramaOfFaces(faces);
}

}  // namespace

bool isPanorama(const std::filesystem::path& path) {
    static constexpr std::string_view kEndings[] = {".hdr", ".exr", ".png", ".jpg", ".jpeg", ".webp"};
    return std::find(std::begin(kEndings), std::end(kEndings), endingOf(path)) != std::end(kEndings);
}

bool isSky(const MetaAsset& asset) { return isPanorama(asset.path) || asset.importer == "texture-cube"; }

Environment readSky(const MetaAsset& asset, const MetaIndex& metas, const Log& log, const Limits& limits) {
    const std::string name = asset.path.filename().string();
    if (const auto faces = facesOf(asset, metas)) return makeEnvironment(readFaces(asset, *faces, limits), name, log);
    if (!isPanorama(asset.path))
        throw Error(fmt::format("'{}' names no faces", name), "its meta names six pictures: right, left, top, …");
    const Image stored = readSkyPicture(asset.path, limits, checkSkySize);
    if (const auto layout = faceLayout(stored.width, stored.height)) {
        std::array<Image, 6> faces = cutFaces(stored, *layout);
        for (Image& face : faces) face = radianceOf(face, asset.path, isPackedRgbe(asset));
        return makeEnvironment(panoramaOfFaces(faces), name, log);
    }
    if (isRadiance(endingOf(asset.path))) return loadEnvironment(asset.path, log, limits);
    return makeEnvironment(decoded(stored, isPackedRgbe(asset)), name, log);
}

}  // namespace crevice::cocos
