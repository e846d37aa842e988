// Ambient occlusion of the depth buffer alone, by brute force: what a screen can know. It splits the error of a
// technique into (technique - this), the estimator's, and (this - ray traced), information that is not on the screen.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/Camera.h"

namespace crevice {

/// Hard falloff. Every texel of the depth buffer is the front of a column of `thickness` along its own view ray;
/// columns are clipped to the ball of the radius; what is not on the screen does not occlude.
struct HeightfieldSettings {
    float radius = 1;  ///< World units.
    /// Of the columns, in radii. 1/2 has the smallest error of all constants over the views of docs/reference.md;
    /// infinity: the horizon of GTAO, texels beyond the radius ignored.
    float thickness = 0.5f;
    std::uint32_t slices = 64;  ///< Half-planes through the view ray, two sides each.
    std::uint32_t steps = 128;  ///< Most per side; one a pixel is enough.
    std::uint32_t seed = 1;
    unsigned threads = 0;                   ///< 0 = as many as the machine has. The result does not depend on it.
    std::function<void(float)> progress{};  ///< Share done, called from the calling thread.
    std::optional<std::filesystem::path> cache{};  ///< As AmbientSettings::cache.
};

/// Row by row from the top; sky is 1.
struct HeightfieldInput {
    glm::uvec2 size{0};
    Camera camera;                              ///< With near and far, as the depth was made.
    std::span<const float> viewDepth;           ///< Linear; sky = kSkyViewDepth.
    std::span<const glm::vec3> normal;          ///< World space, unit length; not read where the depth is sky.
    std::span<const std::uint8_t> isCounted{};  ///< 0: not asked for, gives 1; empty = all.
};
std::vector<float> traceHeightfield(const HeightfieldInput& input, const HeightfieldSettings& settings);

}  // namespace crevice
