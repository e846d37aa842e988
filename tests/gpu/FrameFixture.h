// Tests of whole frames: a validated renderer that must stay silent and leave nothing over, small scenes, and documents
// and effects of a test in a folder of its own.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <glm/gtc/matrix_transform.hpp>

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

class FrameTest : public testing::Test {
protected:
    using Options = std::map<std::string, std::string>;
    using Sets = std::vector<StageSet>;

    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  ("crevice-frame-" + std::to_string(getpid()) + "-" + test->test_suite_name() + "-" + test->name());
        std::filesystem::create_directories(folder_ / "effects" / "chunks");
        std::filesystem::create_directories(folder_ / "assets" / "pipelines");
        renderer_ = makeRenderer();
    }
    /// No message of the validation layer, no warning of ours, and no object that outlives its device (which warns).
    void TearDown() override {
        if (renderer_) expectSilence(*renderer_);
        renderer_.reset();
        for (const std::string& message : messages_) ADD_FAILURE() << message;
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }

    std::unique_ptr<Renderer> makeRenderer() {
        AssetRoots roots = AssetRoots::standard();
        roots.prepend(folder_);
        return std::make_unique<Renderer>(
            RendererOptions{.validate = true, .defaultLight = false, .roots = roots, .log = log_});
    }
    static void expectSilence(Renderer& renderer) {
        for (const std::string& message : renderer.device().validationMessages()) ADD_FAILURE() << message;
        EXPECT_EQ(renderer.device().validationMessageCount(), 0u);
    }

    void load(const std::string& pipeline, const Options& options = {}, Sets sets = {}) {
        load(*renderer_, pipeline, options, std::move(sets));
    }
    static void load(Renderer& renderer, const std::string& pipeline, const Options& options = {}, Sets sets = {}) {
        renderer.load({.nameOrPath = pipeline, .options = options, .sets = std::move(sets)}, {.width = 1, .height = 1});
    }
    /// A document of the test itself.
    void loadDocument(const std::string& text, const Options& options = {}) {
        const std::filesystem::path path = folder_ / "test.pipeline.json";
        writeFileAtomically(path, text);
        load(path.string(), options);
    }
    void writeEffect(const std::string& name, const std::string& text) const {
        writeFileAtomically(folder_ / "effects" / (name + ".effect"), text);
    }
    /// A copy of a shipped effect with one text replaced by another; fails when the text is not there.
    void copyEffect(const std::string& shipped, const std::string& name, const std::string& from,
                    const std::string& to) const {
        std::string text = readText(*AssetRoots::standard().find(AssetKind::Effect, shipped));
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        writeEffect(name, text);
    }
    /// A full-screen effect from the body of its fragment program, which sets `result`.
    void writeFragment(const std::string& name, const std::string& declarations, const std::string& body) const {
        writeEffect(name,
                    "CCEffect %{\n  techniques:\n  - passes:\n    - vert: fullscreen-vs\n      frag: test-fs\n"
                    "      rasterizerState: { cullMode: none }\n"
                    "      depthStencilState: { depthTest: false, depthWrite: false }\n}%\n"
                    "CCProgram test-fs %{\n  precision highp float;\n" +
                        declarations + "\n  in vec2 v_uv;\n  layout(location = 0) out vec4 result;\n  void main() {\n" +
                        body + "\n  }\n}%\n");
    }

    Scene shippedScene(const std::string& name) const {
        return loadScene(*AssetRoots::standard().find(AssetKind::Scene, name), {log_});
    }

    /// Nothing but one material: dielectric, dull, white; exposure 1, no light at all.
    static Scene darkScene() {
        Scene scene;
        SceneMaterial material;
        material.metallic = 0;
        scene.materials.push_back(material);
        scene.exposureEv = std::log2(1.0f / 1.2f);
        return scene;
    }
    static void addObject(Scene& scene, Mesh mesh, const glm::mat4& world, int material = 0) {
        updateBounds(mesh);
        scene.meshes.push_back(std::move(mesh));
        Instance instance;
        instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
        instance.material = material;
        instance.world = world;
        instance.flipped = glm::determinant(glm::mat3(world)) < 0;
        scene.instances.push_back(instance);
    }
    /// A square around `centre` that faces +z.
    static void addWall(Scene& scene, float size, const glm::vec3& centre = glm::vec3(0), int material = 0) {
        const glm::mat4 world(glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, -1, 0, 0),
                              glm::vec4(centre, 1));
        addObject(scene, makePlane(glm::vec2(size)), world, material);
    }
    static void addFloor(Scene& scene, float size, int material = 0) {
        addObject(scene, makePlane(glm::vec2(size)), glm::mat4(1), material);
    }
    static void addBlock(Scene& scene, const glm::vec3& centre, const glm::vec3& size, int material = 0) {
        addObject(scene, makeBox(size), glm::translate(glm::mat4(1), centre), material);
    }
    static Light directional(const glm::vec3& direction, float lux) {
        Light light;
        light.direction = glm::normalize(direction);
        light.intensity = lux;
        light.castsShadow = false;
        return light;
    }
    static Light pointLight(const glm::vec3& position, float candela, float range = 0) {
        Light light;
        light.type = LightType::Point;
        light.position = position;
        light.intensity = candela;
        light.range = range;
        light.castsShadow = false;
        return light;
    }
    static Light spotLight(const glm::vec3& position, const glm::vec3& target, float candela, float inner,
                           float outer) {
        Light light = pointLight(position, candela);
        light.type = LightType::Spot;
        light.direction = glm::normalize(target - position);
        light.innerAngle = inner;
        light.outerAngle = outer;
        return light;
    }

    /// Looks along -z at the wall z = 0 from z = 5; `height` world units are seen.
    static Camera frontCamera(float height = 4) {
        Camera camera = Camera::lookAt({0, 0, 5}, {0, 0, 0});
        camera.orthographic = true;
        camera.orthoHeight = height;
        camera.near = 0.5f;
        camera.far = 20;
        return camera;
    }
    static View viewOf(const Camera& camera, std::uint32_t width, std::uint32_t height) {
        View view{.width = width, .height = height};
        view.camera = camera;
        return view;
    }
    static View sized(std::uint32_t width, std::uint32_t height) { return View{.width = width, .height = height}; }

    Image target(const View& view, const std::string& name) {
        View keeping = view;
        keeping.keep = {name};
        renderer_->render(keeping);
        return renderer_->target(name);
    }
    /// What the lighting wrote, in the scene's units.
    Image radiance(const View& view) { return target(view, "cc_lighting_resultMap"); }

    /// Pixel coordinates (fractions, y down) of a point in the world.
    static glm::vec2 pixelOf(const View& view, const glm::vec3& world) {
        const float aspect = static_cast<float>(view.width) / static_cast<float>(view.height);
        const glm::vec4 clip = view.camera->projection(aspect) * view.camera->view * glm::vec4(world, 1);
        return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(view.width, view.height);
    }
    static glm::vec4 at(const Image& image, const View& view, const glm::vec3& world) {
        const glm::vec2 pixel = pixelOf(view, world);
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= float(image.width) || pixel.y >= float(image.height)) {
            ADD_FAILURE() << "not in the picture: " << world.x << ' ' << world.y << ' ' << world.z;
            return glm::vec4(NAN);
        }
        return image.at(static_cast<std::uint32_t>(pixel.x), static_cast<std::uint32_t>(pixel.y));
    }

    std::filesystem::path folder_;
    std::vector<std::string> messages_;
    Log log_{LogLevel::Warning, [this](LogLevel, std::string_view text) { messages_.emplace_back(text); }};
    std::unique_ptr<Renderer> renderer_;
};

/// Largest difference of two images of one size, in units of their format's values.
inline float largestDifference(const Image& a, const Image& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    float largest = 0;
    for (std::uint32_t y = 0; y < a.height; ++y) {
        for (std::uint32_t x = 0; x < a.width; ++x) {
            const glm::vec4 d = glm::abs(a.at(x, y) - b.at(x, y));
            largest = std::max({largest, d.x, d.y, d.z, d.w});
        }
    }
    return largest;
}

}  // namespace crevice
