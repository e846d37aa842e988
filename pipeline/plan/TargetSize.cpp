// How large a target is at a frame size.
#include "plan/TargetSize.h"

#include <algorithm>
#include <cmath>

#include "core/Format.h"
#include "plan/PipelineDesc.h"

namespace crevice {
namespace {

constexpr double kFloatNoisePixels = 0.01;

std::uint32_t scaled(std::uint32_t pixels, float scale) {
    const double exact = static_cast<double>(pixels) * static_cast<double>(scale);
    return static_cast<std::uint32_t>(std::max(1.0, std::ceil(exact - kFloatNoisePixels)));
}

std::uint32_t level(std::uint32_t pixels, std::uint32_t mip) { return mip < 32 ? std::max(1u, pixels >> mip) : 1u; }

}  // namespace

glm::uvec3 targetExtent(const TargetDesc& target, std::uint32_t width, std::uint32_t height, std::uint32_t mip) {
    const glm::uvec2 top =
        target.size ? *target.size : glm::uvec2(scaled(width, target.scale), scaled(height, target.scale));
    return {level(top.x, mip), level(top.y, mip), std::max(1u, target.layers)};
}

std::uint64_t targetBytes(const TargetDesc& target, std::uint32_t width, std::uint32_t height) {
    std::uint64_t pixels = 0;
    for (std::uint32_t mip = 0; mip < target.mips; ++mip) {
        const glm::uvec3 extent = targetExtent(target, width, height, mip);
        pixels += std::uint64_t(extent.x) * extent.y * extent.z;
    }
    return pixels * static_cast<std::uint64_t>(formatInfo(target.format).bytesPerPixel);
}

}  // namespace crevice
