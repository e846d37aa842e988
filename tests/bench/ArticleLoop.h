// The article's ambient occlusion as a loop that a person vectorised by hand: the yardstick for
// effects/ssao-article.effect.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace crevice::bench {

struct ArticleInput {
    std::uint32_t width = 0, height = 0;   ///< Width divisible by 4, height by 2.
    std::span<const glm::vec4> positions;  ///< World space, rows top to bottom.
    std::span<const glm::vec4> normals;    ///< World space.
    std::span<const glm::vec4> kernel;     ///< Tangent space, xyz.
    glm::mat4 view{1}, projection{1};
    float far = 1, radius = 1;  ///< World units.
};

/// AVX2 and FMA are there, and this build has the loop.
bool hasArticleLoop();

/// Openness per pixel, 255 = open; one thread.
std::vector<std::uint8_t> articleLoop(const ArticleInput& input);

}  // namespace crevice::bench
