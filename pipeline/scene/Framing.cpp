// The default view: from the front right above, as close as the picture's edges allow.
#include "scene/Framing.h"

#include <algorithm>
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

/// Where the camera stands, from the centre of the bounds along the view's axes.
struct Stand {
    float distance = 0, right = 0, up = 0;
};

/// The points along right, up and towards the viewer, from the centre.
std::vector<glm::vec3> inAxes(std::span<const glm::vec3> points, const glm::vec3& centre, float scale) {
    const Axes axes;
    std::vector<glm::vec3> result;
    for (const glm::vec3& point : points) {
        const glm::vec3 c = scale * (point - centre);
        result.emplace_back(glm::dot(c, axes.right), glm::dot(c, axes.up), glm::dot(c, axes.backward));
    }
    return result;
}

// Every point must lie inside the frustum. A camera moved sideways by x to a distance D from the centre sees a point
// (r to the right, t towards it) when |r - x| <= tanH (D - t): the point farthest out on each side bounds D, and x
// makes both bounds equal. Up and down likewise.
Stand closestStand(std::span<const glm::vec3> points, float tanH, float tanV) {
    constexpr float kLeast = std::numeric_limits<float>::lowest();
    float rightmost = kLeast, leftmost = kLeast, highest = kLeast, lowest = kLeast;
    for (const glm::vec3& point : points) {
        rightmost = std::max(rightmost, point.z + point.x / tanH);
        leftmost = std::max(leftmost, point.z - point.x / tanH);
        highest = std::max(highest, point.z + point.y / tanV);
        lowest = std::max(lowest, point.z - point.y / tanV);
    }
    return {.distance = 0.5f * std::max(rightmost + leftmost, highest + lowest),
            .right = 0.5f * tanH * (rightmost - leftmost),
            .up = 0.5f * tanV * (highest - lowest)};
}

// The place along one axis from which the farthest points on both sides are as far from the picture's middle. `start`
// is one from which all are seen.
float centred(std::span<const glm::vec3> points, int axis, float tangent, float distance, float start) {
    float low = start - 2 * tangent * distance, high = start + 2 * tangent * distance;
    for (int step = 0; step < 40; ++step) {
        const float middle = 0.5f * (low + high);
        float most = std::numeric_limits<float>::lowest(), least = std::numeric_limits<float>::max();
        for (const glm::vec3& point : points) {
            const float place = (point[axis] - middle) / std::max(distance - point.z, 1e-6f * distance);
            most = std::max(most, place);
            least = std::min(least, place);
        }
        (most + least > 0 ? low : high) = middle;
    }
    return 0.5f * (low + high);
}

Camera cameraAt(const Stand& stand, const Aabb& bounds, float fovY) {
    const Axes axes;
    const glm::vec3 target = bounds.centre() + stand.right * axes.right + stand.up * axes.up;
    Camera camera = Camera::lookAt(target + stand.distance * axes.backward, target);
    camera.fovY = fovY;
    fitNearFar(camera, bounds);
    return camera;
}

}  // namespace

std::array<glm::vec3, 8> corners(const Aabb& box) {
    std::array<glm::vec3, 8> points;
    for (std::size_t i = 0; i < 8; ++i)
        points[i] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
    return points;
}

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
    if (outline.empty()) return frameBounds(bounds, fovY, aspect);
    // The margin is kept at the picture's edges: a model that points at the camera would lose its size to one in depth.
    const float tanV = std::tan(0.5f * fovY) / kFrameMargin;
    const std::vector<glm::vec3> points = inAxes(outline, bounds.centre(), 1);
    Stand stand = closestStand(points, tanV * aspect, tanV);
    if (!(stand.distance > 0)) stand.distance = bounds.diagonal() > 0 ? bounds.diagonal() : 1;  // a single point
    stand.right = centred(points, 0, tanV * aspect, stand.distance, stand.right);
    stand.up = centred(points, 1, tanV, stand.distance, stand.up);
    return cameraAt(stand, bounds, fovY);
}

Camera frameBounds(const Aabb& bounds, float fovY, float aspect) {
    Aabb box = bounds;
    if (box.empty) box.add(glm::vec3(0));
    const float tanV = std::tan(0.5f * fovY);
    Stand stand = closestStand(inAxes(corners(box), box.centre(), kFrameMargin), tanV * aspect, tanV);
    if (!(stand.distance > 0)) stand.distance = 1;  // a single point
    return cameraAt(stand, box, fovY);
}

}  // namespace crevice
