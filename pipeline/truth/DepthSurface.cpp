// The slope of a texel is the smaller of the differences to both sides, so that edges do not tilt it.
#include "truth/DepthSurface.h"

#include <algorithm>
#include <cmath>

#include "truth/AmbientReference.h"

namespace crevice {
namespace {

constexpr float kSkyShare = 0.999f;      // of kSkyViewDepth
constexpr float kMeetTolerance = 0.02f;  // of the depth; of the view's height under parallel projection

float smaller(float a, float b) { return std::abs(a) < std::abs(b) ? a : b; }

}  // namespace

DepthSurface::DepthSurface(const HeightfieldInput& input)
    : size_(input.size), orthographic_(input.camera.orthographic), depth_(input.viewDepth) {
    const glm::vec2 extent(input.size);
    const Camera& camera = input.camera;
    const float height = orthographic_ ? camera.orthoHeight : 2 * std::tan(0.5f * camera.fovY);
    pixelsPerUnit_ = extent.y / height;
    farthest_ = kSkyShare * kSkyViewDepth;
    centre_ = 0.5f * extent * (1.0f - camera.lensShift);
    value_.reserve(depth_.size());
    for (const float depth : depth_) value_.push_back(toLinear(depth));
    slope_.resize(depth_.size());
    const auto value = [&](int x, int y) { return value_[std::size_t(y) * size_.x + x]; };
    const auto difference = [&](int x, int y, int dx, int dy) {
        const glm::ivec2 a(x - dx, y - dy), b(x + dx, y + dy);
        const bool hasBefore = a.x >= 0 && a.y >= 0, hasAfter = b.x < size_.x && b.y < size_.y;
        const float here = value(x, y);
        const float before = hasBefore ? here - value(a.x, a.y) : 0, after = hasAfter ? value(b.x, b.y) - here : 0;
        return hasBefore && hasAfter ? smaller(before, after) : before + after;
    };
    for (int y = 0; y < size_.y; ++y)
        for (int x = 0; x < size_.x; ++x)
            slope_[std::size_t(y) * size_.x + x] = {difference(x, y, 1, 0), difference(x, y, 0, 1)};
}

float DepthSurface::valueAt(const glm::ivec2& texel, const glm::vec2& pixel) const {
    const std::size_t i = std::size_t(texel.y) * size_.x + texel.x;
    return value_[i] + glm::dot(slope_[i], pixel - glm::vec2(texel) - 0.5f);
}

DepthSurface::Sample DepthSurface::at(const glm::vec2& pixel) const {
    Sample sample;
    sample.texel = glm::clamp(glm::ivec2(glm::floor(pixel)), glm::ivec2(0), size_ - 1);
    const std::size_t i = std::size_t(sample.texel.y) * size_.x + sample.texel.x;
    sample.isSky = isSky(i);
    if (sample.isSky) return sample;
    const float value = valueAt(sample.texel, pixel);
    sample.depth = orthographic_ ? value : value > 0 ? 1 / value : depth_[i];
    return sample;
}

bool DepthSurface::isContinuous(const Sample& a, const Sample& b) const {
    if (a.isSky || b.isSky) return false;
    if (a.texel == b.texel) return true;
    const glm::vec2 middle = 0.5f * glm::vec2(a.texel + b.texel) + 0.5f;
    const float va = valueAt(a.texel, middle), vb = valueAt(b.texel, middle);
    const float scale = orthographic_ ? static_cast<float>(size_.y) / pixelsPerUnit_ : std::max(va, vb);
    return std::abs(va - vb) <= kMeetTolerance * scale;
}

glm::vec3 DepthSurface::position(const glm::vec2& pixel, float depth) const {
    const glm::vec2 aside = (pixel - centre_) * glm::vec2(1, -1) / pixelsPerUnit_;
    return {orthographic_ ? aside : aside * depth, -depth};
}

glm::vec2 DepthSurface::project(const glm::vec3& direction) const {
    return centre_ + pixelsPerUnit_ * glm::vec2(direction.x, -direction.y) / -direction.z;
}

float DepthSurface::pixelsToBorder(const glm::vec2& pixel, const glm::vec2& step) const {
    float reach = 1e30f;
    for (int i = 0; i < 2; ++i) {
        if (step[i] > 0) reach = std::min(reach, (static_cast<float>(size_[i]) - pixel[i]) / step[i]);
        if (step[i] < 0) reach = std::min(reach, -pixel[i] / step[i]);
    }
    return reach;
}

}  // namespace crevice
