// The default view: from the front right above, as close as the picture's edges allow.
#include "scene/Framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace crevice {

namespace {

constexpr float kFrameMargin = 1.05f;
constexpr std::size_t kMostVertices = 500'000;

/// The default view's axes in world space.
struct Axes {
    glm::vec3 backward = glm::normalize(glm::vec3(0.6f, 0.7f, 1.0f));
    glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), backward));
    glm::vec3 up = glm::cross(backward, right);
};

std::array<glm::vec3, 8> corners(const Aabb& box) {
    std::array<glm::vec3, 8> points;
    for (std::size_t i = 0; i < 8; ++i)
        points[i] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
    return points;
}

/// The farthest points along directions between "towards the viewer" and each side of the picture. What bounds the
/// distance at a field of view is the farthest along (towards + sideways / tan): the directions stand for all of those.
class Supports {
public:
    Supports() {
        const Axes axes;
        for (int step = 0; step < kSteps; ++step) {
            const float slope = kFlattest * std::pow(kSteepest / kFlattest, float(step) / (kSteps - 1));
            for (const glm::vec3& side : {axes.right, -axes.right, axes.up, -axes.up})
                directions_.push_back(glm::normalize(axes.backward + slope * side));
        }
        farthest_.assign(directions_.size(), std::numeric_limits<float>::lowest());
        points_.resize(directions_.size());
    }
    void add(const glm::vec3& point) {
        for (std::size_t i = 0; i < directions_.size(); ++i) {
            const float distance = glm::dot(point, directions_[i]);
            if (!(distance > farthest_[i])) continue;
            farthest_[i] = distance;
            points_[i] = point;
        }
        isEmpty_ = false;
    }
    /// Whether a point of the box can change anything.
    bool matters(const Aabb& box) const {
        for (std::size_t i = 0; i < directions_.size(); ++i) {
            const glm::vec3& d = directions_[i];
            const glm::vec3 corner(d.x > 0 ? box.max.x : box.min.x, d.y > 0 ? box.max.y : box.min.y,
                                   d.z > 0 ? box.max.z : box.min.z);
            if (glm::dot(corner, d) > farthest_[i]) return true;
        }
        return false;
    }
    std::vector<glm::vec3> points() const { return isEmpty_ ? std::vector<glm::vec3>() : points_; }

private:
    // 1 / tan of half the angle of view: from 170 degrees to 1.
    static constexpr float kFlattest = 0.08f, kSteepest = 110.0f;
    static constexpr int kSteps = 12;
    std::vector<glm::vec3> directions_, points_;
    std::vector<float> farthest_;
    bool isEmpty_ = true;
};

std::size_t verticesToDraw(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.instances) count += scene.meshes[std::size_t(instance.mesh)].vertices.size();
    return count;
}

}  // namespace

std::vector<glm::vec3> outlineOf(const Scene& scene) {
    const bool byVertices = verticesToDraw(scene) <= kMostVertices;
    Supports supports;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        const Aabb box = mesh.bounds.transformed(instance.world);
        if (box.empty || !supports.matters(box)) continue;
        if (!byVertices || mesh.vertices.empty()) {
            for (const glm::vec3& corner : corners(mesh.bounds))
                supports.add(glm::vec3(instance.world * glm::vec4(corner, 1)));
            continue;
        }
        // Vertices that no index names are not drawn; where there are more indices than vertices that is rare.
        const bool byIndices = mesh.indices.size() < mesh.vertices.size();
        for (std::size_t i = 0; i < std::min(mesh.indices.size(), mesh.vertices.size()); ++i)
            supports.add(
                glm::vec3(instance.world * glm::vec4(mesh.vertices[byIndices ? mesh.indices[i] : i].position, 1)));
    }
    return supports.points();
}

Camera frameOutline(std::span<const glm::vec3> outline, const Aabb& bounds, float fovY, float aspect) {
    Aabb box = bounds;
    if (box.empty) box.add(glm::vec3(0));
    const Axes axes;
    const auto& [backward, right, up] = axes;
    const float tanV = std::tan(0.5f * fovY);
    const float tanH = tanV * aspect;

    // Every point must lie inside the frustum. A camera moved sideways by x to a distance D from the centre sees a
    // point (r to the right, t towards it) when |r - x| <= tanH (D - t): the point farthest out on each side bounds
    // D, and x makes both bounds equal. Up and down likewise.
    constexpr float kLeast = std::numeric_limits<float>::lowest();
    float rightmost = kLeast, leftmost = kLeast, highest = kLeast, lowest = kLeast;
    const std::array<glm::vec3, 8> boxCorners = corners(box);
    for (const glm::vec3& point : outline.empty() ? std::span<const glm::vec3>(boxCorners) : outline) {
        const glm::vec3 c = kFrameMargin * (point - box.centre());
        const float towards = glm::dot(c, backward);
        const float sideways = glm::dot(c, right) / tanH, upwards = glm::dot(c, up) / tanV;
        rightmost = std::max(rightmost, towards + sideways);
        leftmost = std::max(leftmost, towards - sideways);
        highest = std::max(highest, towards + upwards);
        lowest = std::max(lowest, towards - upwards);
    }
    float distance = 0.5f * std::max(rightmost + leftmost, highest + lowest);
    if (!(distance > 0)) distance = box.diagonal() > 0 ? box.diagonal() : 1;  // a single point
    const glm::vec3 target =
        box.centre() + 0.5f * (tanH * (rightmost - leftmost) * right + tanV * (highest - lowest) * up);
    Camera camera = Camera::lookAt(target + distance * backward, target);
    camera.fovY = fovY;
    fitNearFar(camera, box);
    return camera;
}

Camera frameBounds(const Aabb& bounds, float fovY, float aspect) { return frameOutline({}, bounds, fovY, aspect); }

}  // namespace crevice
