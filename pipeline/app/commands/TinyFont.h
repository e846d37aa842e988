// Letters of 5×7 dots, for labels in pictures that the program puts together.
#pragma once

#include <string_view>

#include <glm/glm.hpp>

#include "core/Image.h"

namespace crevice {

/// Pixels that a text takes; each dot is `scale` pixels wide and high.
glm::uvec2 textSize(std::string_view text, std::uint32_t scale);
/// Writes capitals, digits, "-", "_" and "." into an RGBA8 image, top left at (x, y); other bytes are drawn as "-".
/// What lies outside the image is left out.
void drawText(Image& image, std::uint32_t x, std::uint32_t y, std::string_view text, std::uint32_t scale,
              glm::u8vec4 color);

}  // namespace crevice
