// Ambient occlusion tests: a validated renderer, maps as floats, small scenes of planes and boxes, documents and
// effects of a test.
#pragma once

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/Renderer.h"
#include "scene/Primitives.h"

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

inline void addMesh(Scene& scene, Mesh mesh, const glm::mat4& world, int material = 0) {
    updateBounds(mesh);
    scene.meshes.push_back(std::move(mesh));
    Instance instance;
    instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
    instance.material = material;
    instance.world = world;
    scene.instances.push_back(instance);
}

inline glm::mat4 translated(const glm::vec3& offset) { return glm::translate(glm::mat4(1), offset); }

/// A square through `point` that faces `normal`.
inline void addSquare(Scene& scene, const glm::vec3& point, const glm::vec3& normal, float size, int material = 0) {
    const glm::vec3 n = glm::normalize(normal);
    const glm::vec3 aside = std::abs(n.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    const glm::vec3 u = glm::normalize(glm::cross(aside, n));
    const glm::mat4 world(glm::vec4(u, 0), glm::vec4(n, 0), glm::vec4(glm::cross(u, n), 0), glm::vec4(point, 1));
    addMesh(scene, makePlane(glm::vec2(size)), world, material);
}

inline void addBox(Scene& scene, const glm::vec3& centre, const glm::vec3& size, int material = 0) {
    addMesh(scene, makeBox(size), translated(centre), material);
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

inline View viewOf(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    View view{.width = width, .height = height};
    view.camera = camera;
    return view;
}

class AoTest : public testing::Test {
protected:
    using Options = std::map<std::string, std::string>;
    using Sets = std::vector<StageSet>;

    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  (std::string("crevice-ao-") + test->test_suite_name() + "-" + test->name());
        std::filesystem::create_directories(folder_ / "effects");
        renderer_ = makeRenderer();
    }
    void TearDown() override {
        if (renderer_) {
            for (const std::string& message : renderer_->device().validationMessages()) ADD_FAILURE() << message;
            EXPECT_EQ(renderer_->device().validationMessageCount(), 0u);
        }
        renderer_.reset();
        std::filesystem::remove_all(folder_);
    }

    std::unique_ptr<Renderer> makeRenderer() {
        AssetRoots roots = AssetRoots::standard();
        roots.prepend(folder_);
        return std::make_unique<Renderer>(
            RendererOptions{.validate = true, .defaultLight = false, .roots = roots, .log = log_});
    }

    /// The raw map of a form, as full floats: no lighting, no picture.
    void loadMap(const std::string& form = "default", Sets sets = {}, const RunInfo& run = {.width = 1, .height = 1}) {
        sets.insert(sets.begin(), {.path = "cc_ssaoMap.format", .value = "R32F"});
        load("ao-only", {{"view", "raw"}, {"form", form}}, std::move(sets), run);
    }
    /// The shipped pipeline; `options` as on the command line.
    void load(const std::string& pipeline, const Options& options = {}, Sets sets = {},
              const RunInfo& run = {.width = 1, .height = 1}) {
        renderer_->load({.nameOrPath = pipeline, .options = options, .sets = std::move(sets)}, run);
    }
    /// A document of the test itself.
    void loadDocument(const std::string& text, Sets sets = {}, Options options = {}) {
        const std::filesystem::path path = folder_ / "test.pipeline.json";
        writeFileAtomically(path, text);
        renderer_->load({.nameOrPath = path.string(), .options = std::move(options), .sets = std::move(sets)},
                        {.width = 1, .height = 1});
    }
    /// An effect of the test itself, found by name.
    void writeEffect(const std::string& name, const std::string& text) {
        writeFileAtomically(folder_ / "effects" / (name + ".effect"), text);
    }
    /// A full-screen effect from the body of its fragment program; `out` is the type of its output `result`.
    void writeFragment(const std::string& name, const std::string& declarations, const std::string& body,
                       const std::string& out = "float") {
        writeEffect(name,
                    "CCEffect %{\n  techniques:\n  - passes:\n    - vert: fullscreen-vs\n      frag: test-fs\n"
                    "      rasterizerState: { cullMode: none }\n"
                    "      depthStencilState: { depthTest: false, depthWrite: false }\n}%\n"
                    "CCProgram test-fs %{\n  precision highp float;\n" +
                        declarations + "\n  in vec2 v_uv;\n  layout(location = 0) out " + out +
                        " result;\n  void main() {\n" + body + "\n  }\n}%\n");
    }

    Image target(const View& view, const std::string& name) {
        View keeping = view;
        keeping.keep = {name};
        renderer_->render(keeping);
        return renderer_->target(name);
    }
    FloatMap map(const View& view, const std::string& name = "cc_ssaoMap") { return FloatMap(target(view, name)); }

    const StageProgram& stage(const std::string& name) const {
        for (const StageProgram& program : renderer_->pipeline().program().stages())
            if (program.desc->name == name) return program;
        throw Error("no stage " + name);
    }

    Log log_{LogLevel::Error};
    std::filesystem::path folder_;
    std::unique_ptr<Renderer> renderer_;
};

}  // namespace crevice
