// What tests of ambient occlusion share: maps as floats, and small scenes of planes and boxes.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "RenderFixture.h"

namespace crevice {

inline constexpr float kByteStep = 1.0f / 255.0f;

/// The red channel of an image as numbers.
struct FloatMap {
    std::uint32_t width = 0, height = 0;
    std::vector<float> values;

    explicit FloatMap(const Image& image) : width(image.width), height(image.height) {
        values.reserve(std::size_t(width) * height);
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x) values.push_back(image.at(x, y).x);
    }
    float at(std::uint32_t x, std::uint32_t y) const { return values[std::size_t(y) * width + x]; }
    double mean() const {
        double sum = 0;
        for (float v : values) sum += v;
        return sum / static_cast<double>(values.size());
    }
    double rowMean(std::uint32_t y, std::uint32_t firstX, std::uint32_t endX) const {
        double sum = 0;
        for (std::uint32_t x = firstX; x < endX; ++x) sum += at(x, y);
        return sum / (endX - firstX);
    }
    double rowMean(std::uint32_t y) const { return rowMean(y, 0, width); }
    double rowVariance(std::uint32_t y) const {
        const double m = rowMean(y);
        double sum = 0;
        for (std::uint32_t x = 0; x < width; ++x) sum += (at(x, y) - m) * (at(x, y) - m);
        return sum / width;
    }
    float min() const { return *std::min_element(values.begin(), values.end()); }
    float max() const { return *std::max_element(values.begin(), values.end()); }
};

inline double meanDifference(const FloatMap& a, const FloatMap& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) sum += std::abs(a.values[i] - b.values[i]);
    return sum / static_cast<double>(a.values.size());
}

inline float maxDifference(const FloatMap& a, const FloatMap& b) {
    float largest = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i) largest = std::max(largest, std::abs(a.values[i] - b.values[i]));
    return largest;
}

/// A scene without lights whose first material is white, dull and two-sided.
inline Scene emptyScene() {
    Scene scene;
    SceneMaterial white;
    white.metallic = 0;
    white.doubleSided = true;
    scene.materials.push_back(white);
    scene.ambient = Ambient{glm::vec3(1), glm::vec3(1)};
    scene.exposureEv = 0.0f;
    return scene;
}

/// A square through `point` that faces `normal`.
inline void addSquare(Scene& scene, const glm::vec3& point, const glm::vec3& normal, float size, int material = 0) {
    const glm::vec3 n = glm::normalize(normal);
    const glm::vec3 aside = std::abs(n.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    const glm::vec3 u = glm::normalize(glm::cross(aside, n));
    const glm::mat4 world(glm::vec4(u, 0), glm::vec4(n, 0), glm::vec4(glm::cross(u, n), 0), glm::vec4(point, 1));
    addObject(scene, makePlane(glm::vec2(size)), world, material);
}

inline void addBox(Scene& scene, const glm::vec3& centre, const glm::vec3& size, int material = 0) {
    addObject(scene, makeBox(size), translated(centre), material);
}

/// Floor y = 0 and wall x = 0, which the floor meets from x > 0; both reach far.
inline Scene wallScene(float size = 40) {
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, {0, 1, 0}, size);
    addSquare(scene, {0, 0, 0}, {1, 0, 0}, size);
    return scene;
}

/// wallScene() and a second wall, z = 0: three planes meet in the origin.
inline Scene cornerScene(float size = 40) {
    Scene scene = wallScene(size);
    addSquare(scene, {0, 0, 0}, {0, 0, 1}, size);
    return scene;
}

/// Looks down on the wall's foot at 45 degrees: a row of pixels is a line parallel to the wall, `height` world units
/// are seen.
inline Camera wallCamera(float height, const glm::vec3& target = glm::vec3(0)) {
    Camera camera = Camera::lookAt(target + glm::vec3(10, 10, 0), target);
    camera.orthographic = true;
    camera.orthoHeight = height;
    camera.near = 0.1f;
    camera.far = 60;
    return camera;
}

/// Distance from the wall of the floor that wallCamera() sees in the middle of a pixel row; negative on the wall.
inline float floorDistance(std::uint32_t row, std::uint32_t rows, float height) {
    const float down = ((static_cast<float>(row) + 0.5f) / static_cast<float>(rows) - 0.5f) * height;
    return down * 1.41421356f;
}

/// Exact openness of the floor at `k` radii from an infinite wall (hard range, cosine-weighted): one minus a segment of
/// the unit disc.
inline double exactWall(double k) { return 1 - (std::acos(k) - k * std::sqrt(1 - k * k)) / 3.14159265358979; }

/// wallScene() with a box in front of the wall: creases and depth steps in one frame.
inline Scene busyScene() {
    Scene scene = wallScene();
    addBox(scene, {1.2f, 0.6f, 0.3f}, {0.8f, 1.2f, 0.7f});
    return scene;
}

/// A plane that the axis -z meets at that distance, tilted towards a direction that is no axis: no component of its
/// normal is special.
inline Scene tiltedPlane(float degrees, float distance) {
    const float tilt = glm::radians(degrees);
    Scene scene = emptyScene();
    const glm::vec3 normal(std::sin(tilt) * 0.3f, std::sin(tilt) * std::sqrt(1 - 0.09f), std::cos(tilt));
    addSquare(scene, {0, 0, -distance}, normal, 60 * distance);
    return scene;
}

class AoTest : public RenderTest {
protected:
    AoTest() : RenderTest(LogLevel::Error) {}

    /// The raw map of a form, as full floats: no lighting, no picture.
    void loadMap(const std::string& form = "default", Sets sets = {}, const RunInfo& run = {.width = 1, .height = 1}) {
        sets.insert(sets.begin(), {.path = "cc_ssaoMap.format", .value = "R32F"});
        load("ao-only", {{"view", "raw"}, {"form", form}}, std::move(sets), run);
    }
    FloatMap map(const View& view, const std::string& name = "cc_ssaoMap") { return FloatMap(target(view, name)); }

    const StageProgram& stage(const std::string& name) const {
        for (const StageProgram& program : renderer_->pipeline().program().stages())
            if (program.desc->name == name) return program;
        throw Error("no stage " + name);
    }
};

}  // namespace crevice
