// The slope of a texel is the smaller of the differences to both sides, so that edges do not tilt it.
#include "truth/DepthSurface.h"

#include <algorithm>
#include <cmath>

#include "truth/AmbientReference.h"

namespace crevice {
namespace {

/// Steepest piece of plane that is taken from a normal alone: the share of the depth that it may change in a pixel.
constexpr float kSteepest = 0.5f;

float smaller(float a, float b) { return std::abs(a) < std::abs(b) ? a : b; }

}  // namespace

DepthSurface::DepthSurface(const HeightfieldInput& input)
    : size_(input.size), continuity_(input.camera), texels_(input.viewDepth.size()) {
    const glm::vec2 extent(input.size);
    const Camera& camera = input.camera;
    const float height = camera.orthographic ? camera.orthoHeight : 2 * std::tan(0.5f * camera.fovY);
    pixelsPerUnit_ = extent.y / height;
    centre_ = 0.5f * extent * (1.0f - camera.lensShift);
    const glm::mat3 toView(camera.view);
    for (std::size_t i = 0; i < texels_.size(); ++i) {
        const float depth = input.viewDepth[i];
        texels_[i] = {.depth = depth, .value = continuity_.toLinear(depth)};
    }
    for (int y = 0; y < size_.y; ++y) {
        for (int x = 0; x < size_.x; ++x) {
            const std::size_t i = indexOf({x, y});
            if (isSky(i)) continue;
            const glm::vec3 normal = toView * input.normal[i];
            texels_[i].slope = {slopeAlong({x, y}, {1, 0}, normal), slopeAlong({x, y}, {0, 1}, normal)};
        }
    }
}

float DepthSurface::slopeAlong(const glm::ivec2& texel, const glm::ivec2& step, const glm::vec3& normal) const {
    const auto value = [&](const glm::ivec2& place) {
        return texels_[indexOf(glm::clamp(place, glm::ivec2(0), size_ - 1))].value;
    };
    const glm::ivec2 before = texel - step, after = texel + step;
    const float here = value(texel), rise = here - value(before), next = value(after) - here;
    const bool hasBefore =
        before.x >= 0 && before.y >= 0 && !continuity_.breaks(value(before - step), value(before), here, value(after));
    const bool hasAfter = after.x < size_.x && after.y < size_.y &&
                          !continuity_.breaks(value(before), here, value(after), value(after + step));
    if (hasBefore && hasAfter) return smaller(rise, next);
    return hasBefore ? rise : hasAfter ? next : slopeOfPlane(texel, step, normal);
}

/// For texels without a neighbour on their surface. On a plane normal · position is constant.
float DepthSurface::slopeOfPlane(const glm::ivec2& texel, const glm::ivec2& step, const glm::vec3& normal) const {
    const glm::vec2 pixel = glm::vec2(texel) + 0.5f;
    const float here = texels_[indexOf(texel)].value;
    const glm::vec3 direction = position(pixel, 1) - (continuity_.orthographic() ? position(pixel, 0) : glm::vec3(0));
    const glm::vec3 aside = position(pixel + glm::vec2(step), 1) - position(pixel, 1);
    const float facing = glm::dot(normal, direction);
    if (!(std::abs(facing) > 0)) return 0;
    // Parallel: normal · (aside + slope·direction) = 0. Perspective: 1/z ~ normal · direction.
    const float slope =
        continuity_.orthographic() ? -glm::dot(normal, aside) / facing : here * glm::dot(normal, aside) / facing;
    const float steepest = kSteepest * (continuity_.orthographic() ? 1 / pixelsPerUnit_ : here);
    return std::clamp(slope, -steepest, steepest);
}

DepthSurface::Sample DepthSurface::at(const glm::vec2& pixel) const {
    const glm::ivec2 place = glm::clamp(glm::ivec2(pixel), glm::ivec2(0), size_ - 1);
    const Texel& texel = texels_[indexOf(place)];
    if (!(texel.depth < kSkyDepth)) return {};
    Sample sample{.depth = texel.depth, .centre = glm::vec2(place) + 0.5f, .texel = &texel};
    const float value = valueAt(sample, pixel);
    if (continuity_.orthographic() || value > 0) sample.depth = continuity_.toDepth(value);
    return sample;
}

bool DepthSurface::isContinuous(const Sample& a, const Sample& b) const {
    if (!a.texel || !b.texel) return false;
    if (a.texel == b.texel) return true;
    const glm::vec2 middle = 0.5f * (a.centre + b.centre);
    return continuity_.meets(valueAt(a, middle), valueAt(b, middle));
}

DepthSurface::Line DepthSurface::lineThrough(const glm::vec2& pixel, const glm::vec2& step, const glm::vec3& across,
                                             const glm::vec3& up) const {
    const auto flatten = [&](const glm::vec3& v) { return glm::vec2(glm::dot(v, across), glm::dot(v, up)); };
    const glm::vec2 start = (pixel - centre_) * glm::vec2(1, -1) / pixelsPerUnit_;
    const glm::vec3 stepped(step * glm::vec2(1, -1) / pixelsPerUnit_, 0);
    if (continuity_.orthographic()) return {.originStep = flatten(stepped), .direction = flatten({0, 0, -1})};
    return {.direction = flatten({start, -1}), .directionStep = flatten(stepped)};
}

glm::vec3 DepthSurface::position(const glm::vec2& pixel, float depth) const {
    const glm::vec2 aside = (pixel - centre_) * glm::vec2(1, -1) / pixelsPerUnit_;
    return {continuity_.orthographic() ? aside : aside * depth, -depth};
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
