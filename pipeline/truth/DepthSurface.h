// A depth buffer as a surface between its texels: every texel is a piece of a plane.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "truth/HeightfieldReference.h"

namespace crevice {

/// Places are in pixels from the upper left corner, positions in view space.
class DepthSurface {
public:
    explicit DepthSurface(const HeightfieldInput& input);

    struct Sample {
        float depth = 0;  ///< Linear, at the very place.
        glm::ivec2 texel{0};
        bool isSky = true;
    };
    /// The texel's plane there. The place must be on the screen, or is brought there.
    Sample at(const glm::vec2& pixel) const;
    /// Do the planes of two texels near each other meet where they touch?
    bool isContinuous(const Sample& a, const Sample& b) const;

    glm::vec3 position(const glm::vec2& pixel, float depth) const;
    glm::vec2 project(const glm::vec3& direction) const;  ///< Perspective: of a direction with z < 0.
    bool isSky(std::size_t texel) const { return !(depth_[texel] < farthest_); }
    float pixelsPerUnit() const { return pixelsPerUnit_; }  ///< Orthographic: everywhere. Perspective: at depth 1.
    /// From a place on the screen along a step of length 1.
    float pixelsToBorder(const glm::vec2& pixel, const glm::vec2& step) const;

private:
    /// Straight in 1/z under perspective, in z under parallel projection: what is linear on the screen for a plane.
    float toLinear(float depth) const { return orthographic_ ? depth : 1 / depth; }
    float valueAt(const glm::ivec2& texel, const glm::vec2& pixel) const;

    glm::ivec2 size_;
    bool orthographic_;
    float pixelsPerUnit_, farthest_;
    glm::vec2 centre_;  ///< Pixel that the axis passes.
    std::span<const float> depth_;
    std::vector<float> value_;      ///< toLinear()
    std::vector<glm::vec2> slope_;  ///< Of value_, per pixel.
};

}  // namespace crevice
