// What every test of rendered frames starts from: a validated renderer that must stay silent, and a folder for the
// documents and effects of a test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <glm/gtc/matrix_transform.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/Renderer.h"
#include "scene/Primitives.h"
#include "tests/SceneObjects.h"

namespace crevice {

inline glm::mat4 translated(const glm::vec3& offset) { return glm::translate(glm::mat4(1), offset); }

inline View viewOf(const Camera& camera, std::uint32_t width, std::uint32_t height) {
    View view{.width = width, .height = height};
    view.camera = camera;
    return view;
}

class RenderTest : public testing::Test {
protected:
    using Options = std::map<std::string, std::string>;
    using Sets = std::vector<StageSet>;

    /// A message of `strictness` or worse fails the test.
    explicit RenderTest(LogLevel strictness)
        : log_(strictness, [this](LogLevel, std::string_view text) { messages_.emplace_back(text); }) {}

    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  ("crevice-gpu-" + std::to_string(getpid()) + "-" + test->test_suite_name() + "-" + test->name());
        std::filesystem::create_directories(folder_ / "effects" / "chunks");
        std::filesystem::create_directories(folder_ / "assets" / "pipelines");
        renderer_ = makeRenderer();
    }
    /// No message of the validation layer, none of ours, and no object that outlives its device (which warns).
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

    /// A pipeline by name or path; `options` and `sets` as on the command line.
    void load(const std::string& pipeline, const Options& options = {}, Sets sets = {},
              const RunInfo& run = {.width = 1, .height = 1}) {
        load(*renderer_, pipeline, options, std::move(sets), run);
    }
    static void load(Renderer& renderer, const std::string& pipeline, const Options& options = {}, Sets sets = {},
                     const RunInfo& run = {.width = 1, .height = 1}) {
        renderer.load({.nameOrPath = pipeline, .options = options, .sets = std::move(sets)}, run);
    }
    /// A document of the test itself.
    void loadDocument(const std::string& text, Sets sets = {}, const Options& options = {}) {
        const std::filesystem::path path = folder_ / "test.pipeline.json";
        writeFileAtomically(path, text);
        load(path.string(), options, std::move(sets));
    }
    /// An effect of the test itself, found by name.
    void writeEffect(const std::string& name, const std::string& text) const {
        writeFileAtomically(folder_ / "effects" / (name + ".effect"), text);
    }
    /// A full-screen effect from the body of its fragment program; `type` is the type of its output `result`.
    void writeFragment(const std::string& name, const std::string& declarations, const std::string& body,
                       const std::string& type = "vec4") const {
        writeEffect(name,
                    "CCEffect %{\n  techniques:\n  - passes:\n    - vert: fullscreen-vs\n      frag: test-fs\n"
                    "      rasterizerState: { cullMode: none }\n"
                    "      depthStencilState: { depthTest: false, depthWrite: false }\n}%\n"
                    "CCProgram test-fs %{\n  precision highp float;\n" +
                        declarations + "\n  in vec2 v_uv;\n  layout(location = 0) out " + type +
                        " result;\n  void main() {\n" + body + "\n  }\n}%\n");
    }

    Image target(const View& view, const std::string& name) {
        View keeping = view;
        keeping.keep = {name};
        renderer_->render(keeping);
        return renderer_->target(name);
    }

    std::filesystem::path folder_;
    std::vector<std::string> messages_;
    Log log_;
    std::unique_ptr<Renderer> renderer_;
};

}  // namespace crevice
