// Environment files: their header is judged before anything is decoded.
#include <fmt/format.h>

#include "core/Error.h"
#include "core/Exr.h"
#include "core/Hdr.h"
#include "core/LimitedFiles.h"
#include "scene/Environment.h"
#include "scene/PanoramaSize.h"

namespace crevice {

void checkPanoramaSize(std::uint64_t width, std::uint64_t height, const std::string& name, const Limits& limits) {
    checkPanoramaShape(width, height, name);
    constexpr std::uint64_t kBytesPerPixel = 16, kShareOfAllPictures = 8;
    const std::uint64_t most = limits.maxImageBytes / kShareOfAllPictures / kBytesPerPixel;
    if (width * height > most)
        throw Error(fmt::format("environment '{}' has {} x {} pixels, the limit is {}", name, width, height, most),
                    raiseLimit("image-bytes"));
}

Environment loadEnvironment(const std::filesystem::path& path, const Log& log, const Limits& limits) {
    const std::string name = path.string();
    const std::vector<std::byte> bytes = readBytesWithin(path, limits.maxFileBytes);
    if (looksLikeHdr(bytes)) {
        const HdrHeader header = readHdrHeader(bytes, name, limits);
        checkPanoramaSize(header.width, header.height, name, limits);
        return makeEnvironment(decodeHdr(bytes, name, limits), name, log);
    }
    if (looksLikeExr(bytes)) {
        const ExrSize size = exrSize(bytes, name, limits);
        checkPanoramaSize(size.width, size.height, name, limits);
        return makeEnvironment(decodeExr(bytes, name, limits), name, log);
    }
    throw Error(fmt::format("environment '{}' is neither a Radiance .hdr nor an EXR file", name),
                "environments hold radiance beyond 1: use a .hdr or .exr panorama");
}

}  // namespace crevice
