// How large a target is at a frame size: the one place that rounds, used by everyone who makes, plans or prints images.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace crevice {

struct TargetDesc;

/// Width, height and layers of level `mip` of a target, each at least 1. A scaled size is rounded up, so that a
/// half-size target covers the last column of an odd frame (a hundredth of a pixel too much is taken for float noise:
/// 0.1 × 1280 is 128). Levels halve and round down, as Vulkan's do.
glm::uvec3 targetExtent(const TargetDesc& target, std::uint32_t width, std::uint32_t height, std::uint32_t mip = 0);

/// Pixels that a guard of `percent` of the frame's height adds on each side, rounded up to a multiple of 4: a target of
/// half or a quarter of the frame's size, and noise in tiles of 4, keep their places in the frame.
std::uint32_t guardPixels(double percent, std::uint32_t height);

/// The part of a target that shows the frame, in pixels of level 0.
struct FrameCrop {
    glm::uvec2 offset{0}, extent{0};
};
/// Where the frame of width x height lies in a target that is made with `guard` pixels on each side. A target of a
/// fixed size has no border: all of it.
FrameCrop frameCrop(const TargetDesc& target, std::uint32_t width, std::uint32_t height, std::uint32_t guard);

/// Bytes of all levels and layers, without what a driver adds.
std::uint64_t targetBytes(const TargetDesc& target, std::uint32_t width, std::uint32_t height);

}  // namespace crevice
