// A depth buffer as a surface between its texels: every texel is a piece of a plane.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "truth/DepthContinuity.h"
#include "truth/HeightfieldReference.h"

namespace crevice {

/// Places are in pixels from the upper left corner, positions in view space.
class DepthSurface {
public:
    explicit DepthSurface(const HeightfieldInput& input);

    struct Texel {
        float depth = 0, value = 0;  ///< value: linear on the screen for a plane, see DepthContinuity
        glm::vec2 slope{0};          ///< Of the value, per pixel.
    };
    struct Sample {
        float depth = 0;               ///< Linear, at the very place.
        glm::vec2 centre{0};           ///< Of the texel, pixels.
        const Texel* texel = nullptr;  ///< Null: sky.
    };
    /// The texel's plane there. The place must be on the screen, or is brought there.
    Sample at(const glm::vec2& pixel) const;
    /// Do the planes of two texels near each other meet where they touch?
    bool isContinuous(const Sample& a, const Sample& b) const;

    glm::vec3 position(const glm::vec2& pixel, float depth) const;
    /// View rays of the places pixel + s·step as seen in a plane through the view ray of `pixel`, whose axes are
    /// `across` and `up`: origin + s·originStep + depth·(direction + s·directionStep).
    struct Line {
        glm::vec2 originStep{0}, direction{0}, directionStep{0};
    };
    Line lineThrough(const glm::vec2& pixel, const glm::vec2& step, const glm::vec3& across, const glm::vec3& up) const;
    glm::vec2 project(const glm::vec3& direction) const;  ///< Perspective: of a direction with z < 0.
    bool isSky(std::size_t texel) const { return !(texels_[texel].depth < kSkyDepth); }
    float pixelsPerUnit() const { return pixelsPerUnit_; }  ///< Orthographic: everywhere. Perspective: at depth 1.
    /// From a place on the screen along a step of length 1.
    float pixelsToBorder(const glm::vec2& pixel, const glm::vec2& step) const;

private:
    static constexpr float kSkyDepth = 0.999e9f;  ///< Below kSkyViewDepth.

    std::size_t indexOf(const glm::ivec2& t) const {
        return std::size_t(t.y) * std::size_t(size_.x) + std::size_t(t.x);
    }
    static float valueAt(const Sample& sample, const glm::vec2& pixel) {
        return sample.texel->value + glm::dot(sample.texel->slope, pixel - sample.centre);
    }
    float slopeAlong(const glm::ivec2& texel, const glm::ivec2& step, const glm::vec3& normal) const;
    float slopeOfPlane(const glm::ivec2& texel, const glm::ivec2& step, const glm::vec3& normal) const;

    glm::ivec2 size_;
    DepthContinuity continuity_;
    float pixelsPerUnit_;
    glm::vec2 centre_;  ///< Pixel that the axis passes.
    std::vector<Texel> texels_;
};

}  // namespace crevice
