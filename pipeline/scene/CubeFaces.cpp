// Borders between faces, bilinear look-ups and halving.
#include "scene/CubeFaces.h"

#include <algorithm>
#include <cmath>

namespace crevice {

CubeLevel::CubeLevel(std::uint32_t size) : size_(size), texels_(std::size_t(kCubeFaces) * (size + 2) * (size + 2)) {}

void CubeLevel::fillBorder() {
    const int last = static_cast<int>(size_);
    const auto nearest = [&](float coordinate) {
        const float texel = (coordinate + 1) * 0.5f * static_cast<float>(size_);
        return std::clamp(static_cast<int>(texel), 0, last - 1);
    };
    const auto fill = [&](std::uint32_t face, int x, int y) {
        const glm::vec3 direction = cubeDirection(face, cubeCoordinate(static_cast<float>(x), size_),
                                                  cubeCoordinate(static_cast<float>(y), size_));
        const CubePoint point = cubePoint(direction);
        at(face, x, y) = at(point.face, nearest(point.s), nearest(point.t));
    };
    for (std::uint32_t face = 0; face < kCubeFaces; ++face) {
        for (int i = -1; i <= last; ++i) {
            for (const int end : {-1, last}) {
                fill(face, i, end);
                fill(face, end, i);
            }
        }
    }
}

glm::vec4 CubeLevel::sample(const CubePoint& point) const {
    const auto size = static_cast<float>(size_);
    const float x = (point.s + 1) * 0.5f * size - 0.5f, y = (point.t + 1) * 0.5f * size - 0.5f;
    const float left = std::floor(x), top = std::floor(y);
    const int last = static_cast<int>(size_) - 1;
    const int x0 = std::clamp(static_cast<int>(left), -1, last), y0 = std::clamp(static_cast<int>(top), -1, last);
    const float right = x - left, down = y - top;
    const std::size_t pitch = size_ + 2;
    const glm::vec4* upper = &texels_[index(point.face, x0, y0)];
    const glm::vec4* lower = upper + pitch;
    return (upper[0] * (1 - right) + upper[1] * right) * (1 - down) +
           (lower[0] * (1 - right) + lower[1] * right) * down;
}

CubeLevel halved(const CubeLevel& level) {
    CubeLevel half(std::max(level.size() / 2, 1u));
    const int size = static_cast<int>(half.size());
    for (std::uint32_t face = 0; face < kCubeFaces; ++face) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                half.at(face, x, y) = 0.25f * (level.at(face, 2 * x, 2 * y) + level.at(face, 2 * x + 1, 2 * y) +
                                               level.at(face, 2 * x, 2 * y + 1) + level.at(face, 2 * x + 1, 2 * y + 1));
            }
        }
    }
    half.fillBorder();
    return half;
}

}  // namespace crevice
