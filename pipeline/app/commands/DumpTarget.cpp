// Tells distances from colours: a one-channel float target cleared to more than 1 holds distances, a depth target of
// the frame's size belongs to the camera (a shadow map has a size of its own).
#include "app/commands/DumpTarget.h"

#include <cstring>

namespace crevice {
namespace {

/// Fragment depth in [0, 1] → distance along the view, from the camera's projection (aspect does not matter).
Image toDistances(const Image& depth, const Camera& camera) {
    const glm::mat4 projection = camera.projection(1);
    Image distances(depth.width, depth.height, Format::R32F);
    for (std::uint32_t y = 0; y < depth.height; ++y) {
        for (std::uint32_t x = 0; x < depth.width; ++x) {
            const float d = depth.at(x, y).r;
            // Perspective: d = (p22 z + p32) / -z. Parallel: d = p22 z + p32. Distance = -z.
            const float distance = camera.orthographic ? (projection[3][2] - d) / projection[2][2]
                                                       : projection[3][2] / (d + projection[2][2]);
            std::memcpy(distances.pixel(x, y), &distance, sizeof distance);
        }
    }
    return distances;
}

bool holdsNegative(const Image& image) {
    if (!formatInfo(image.format).isFloat) return false;
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const glm::vec4 value = image.at(x, y);
            if (value.r < 0 || value.g < 0 || value.b < 0) return true;
        }
    }
    return false;
}

}  // namespace

void addDump(OutputFiles& files, const std::filesystem::path& path, const Image& image, const TargetDesc& target,
             const Camera& camera) {
    const FormatInfo& format = formatInfo(image.format);
    if (path.extension() != ".png") {
        files.add(path, image);
    } else if (format.isDepth && !target.size) {
        files.add(path, toDistances(image, camera), PngMapping::DepthByFar, camera.far);
    } else if (format.isFloat && format.channels == 1 && target.clear.x > 1) {
        files.add(path, image, PngMapping::DepthByFar, camera.far);
    } else {
        files.add(path, image, holdsNegative(image) ? PngMapping::Signed : PngMapping::Clamp);
    }
}

}  // namespace crevice
