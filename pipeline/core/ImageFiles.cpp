// Images from and to files: what is read is told by its content, what is written by its ending.
#include <fmt/format.h>

#include "core/Exr.h"
#include "core/Files.h"
#include "core/Hdr.h"
#include "core/Image.h"
#include "core/LimitedFiles.h"
#include "core/Picture.h"
#include "core/Text.h"

namespace crevice {

Image readImage(const std::filesystem::path& path) { return readImage(path, Limits{}); }

Image readImage(const std::filesystem::path& path, const Limits& limits) {
    const std::vector<std::byte> bytes = readBytesWithin(path, limits.maxFileBytes);
    if (readPictureHeader(bytes)) return decodePicture(bytes, path.string(), limits);
    if (looksLikeExr(bytes)) return decodeExr(bytes, path.string(), limits);
    if (looksLikeHdr(bytes)) return decodeHdr(bytes, path.string(), limits);
    throw Error(fmt::format("'{}' is no PNG, JPEG, WebP or EXR image, or is cut off", path.string()),
                "convert it to PNG or EXR, or fetch it again");
}

void writeImage(const std::filesystem::path& path, const Image& image, PngMapping mapping, float far) {
    const std::string ending = lowerCase(path.extension().string());
    if (ending == ".png") {
        writeFileAtomically(path, encodePng(toEightBit(image, mapping, far)));
    } else if (ending == ".exr") {
        writeFileAtomically(path, encodeExr(image));
    } else {
        throw Error(fmt::format("'{}' does not end in .png or .exr", path.string()),
                    "name the picture .png (8 bits) or .exr (full floats)");
    }
}

}  // namespace crevice
