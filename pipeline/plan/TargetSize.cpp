// How large a target is at a frame size.
#include "plan/TargetSize.h"

#include <algorithm>
#include <cmath>

#include "core/Format.h"
#include "plan/PipelineDesc.h"

namespace crevice {
namespace {

constexpr double kFloatNoisePixels = 0.01;
constexpr std::uint32_t kGuardStep = 4;

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

std::uint32_t guardPixels(double percent, std::uint32_t height) {
    const double steps = percent * 0.01 * static_cast<double>(height) / kGuardStep;
    return static_cast<std::uint32_t>(std::ceil(steps - kFloatNoisePixels)) * kGuardStep;
}

FrameCrop frameCrop(const TargetDesc& target, std::uint32_t width, std::uint32_t height, std::uint32_t guard) {
    const glm::uvec2 extent = targetExtent(target, width, height);
    if (target.size) return {{0, 0}, extent};
    // Whole for scales of 1/4, 1/2, 1 and above; else the nearest pixel, as far as the target reaches.
    const auto border = static_cast<std::uint32_t>(std::lround(static_cast<double>(guard) * target.scale));
    const glm::uvec2 whole = targetExtent(target, width + 2 * guard, height + 2 * guard);
    return {glm::min(glm::uvec2(border), whole - extent), extent};
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
