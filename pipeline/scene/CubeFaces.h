// The six faces of a cube map as numbers: directions of texels, and look-ups that do not see the edges of faces.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace crevice {

inline constexpr std::uint32_t kCubeFaces = 6;

/// Direction of a point of a face, not unit length; s runs right and t down from -1 to 1. Faces are +X, -X, +Y, -Y, +Z,
/// -Z as Vulkan orders and turns them.
inline glm::vec3 cubeDirection(std::uint32_t face, float s, float t) {
    switch (face) {
        case 0:
            return {1, -t, -s};
        case 1:
            return {-1, -t, s};
        case 2:
            return {s, 1, t};
        case 3:
            return {s, -1, -t};
        case 4:
            return {s, -t, 1};
        default:
            return {-s, -t, -1};
    }
}

struct CubePoint {
    std::uint32_t face = 0;
    float s = 0, t = 0;
};
/// Where a direction (not 0) meets the cube.
inline CubePoint cubePoint(const glm::vec3& d) {
    const glm::vec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z) return {d.x > 0 ? 0u : 1u, (d.x > 0 ? -d.z : d.z) / a.x, -d.y / a.x};
    if (a.y >= a.z) return {d.y > 0 ? 2u : 3u, d.x / a.y, (d.y > 0 ? d.z : -d.z) / a.y};
    return {d.z > 0 ? 4u : 5u, (d.z > 0 ? d.x : -d.x) / a.z, -d.y / a.z};
}

/// Coordinate of a texel's centre on a face of `size` texels: -1 … 1.
inline float cubeCoordinate(float texel, std::uint32_t size) { return (2 * texel + 1) / static_cast<float>(size) - 1; }

/// One level of a cube map: texels of a face lie in rows from the top, with a border of one texel all around that
/// repeats what the neighbouring faces have there.
class CubeLevel {
public:
    explicit CubeLevel(std::uint32_t size);

    std::uint32_t size() const { return size_; }
    /// -1 and size() are the border.
    glm::vec4& at(std::uint32_t face, int x, int y) { return texels_[index(face, x, y)]; }
    const glm::vec4& at(std::uint32_t face, int x, int y) const { return texels_[index(face, x, y)]; }
    /// After all texels are set.
    void fillBorder();
    /// Bilinear.
    glm::vec4 sample(const CubePoint& point) const;

private:
    std::size_t index(std::uint32_t face, int x, int y) const {
        const std::size_t pitch = size_ + 2;
        return (face * pitch + std::size_t(y + 1)) * pitch + std::size_t(x + 1);
    }
    std::uint32_t size_;
    std::vector<glm::vec4> texels_;
};

/// The next level: means of 2 x 2 texels.
CubeLevel halved(const CubeLevel& level);

}  // namespace crevice
