// Where one surface ends and another begins in a depth buffer: the rule that edges and slopes share.
#pragma once

#include <algorithm>
#include <cmath>

#include "scene/Camera.h"

namespace crevice {

/// Works on what is linear on the screen for a plane: 1/z under perspective, z under parallel projection.
class DepthContinuity {
public:
    /// Of the depth; of the view's height under parallel projection.
    static constexpr float kTolerance = 0.02f;

    explicit DepthContinuity(const Camera& camera)
        : orthographic_(camera.orthographic), tolerance_(kTolerance * (orthographic_ ? camera.orthoHeight : 1.0f)) {}

    float toLinear(float depth) const { return orthographic_ ? depth : 1 / depth; }
    float toDepth(float value) const { return orthographic_ ? value : 1 / value; }
    bool orthographic() const { return orthographic_; }

    bool meets(float a, float b) const {
        return std::abs(a - b) <= tolerance_ * (orthographic_ ? 1.0f : std::max(a, b));
    }
    /// Of four values in a row: does the surface break between the second and the third? Neither of the two, continued
    /// straight, meets the other.
    bool breaks(float before, float a, float b, float after) const {
        return !meets(a, b) && !meets(2 * a - before, b) && !meets(2 * b - after, a);
    }

private:
    bool orthographic_;
    float tolerance_;
};

}  // namespace crevice
