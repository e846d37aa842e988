// The signed error of a map as colours.
#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "core/Image.h"

namespace crevice {

/// Errors from here on have the full colour.
inline constexpr float kHeatRange = 0.5f;

/// sRGB bytes of an error e = map - truth: near white for none, blue too dark, red too bright, full from `range` on.
/// Lightness falls evenly with |e|, alike on both sides (straight lines in Oklab: Ottosson 2020; why such maps:
/// Moreland, "Diverging Color Maps for Scientific Visualization", 2009).
glm::u8vec3 heatColor(float error, float range = kHeatRange);

/// Picture (RGBA8) of map - truth; values row by row from the top. Where `isCounted` is 0 (empty: nowhere) it is grey,
/// as nothing else is. What is not finite in the map counts as 0, as in measureMap().
Image errorHeat(const glm::uvec2& size, std::span<const float> map, std::span<const float> truth,
                std::span<const std::uint8_t> isCounted = {}, float range = kHeatRange);

}  // namespace crevice
