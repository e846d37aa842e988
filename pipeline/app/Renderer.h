// The library's front door: a device, a pipeline document, a scene → images. The program is a client of it without
// private powers.
//
//   crevice::Renderer renderer({});
//   renderer.load({.nameOrPath = "ssao-deferred"});
//   renderer.setScene(crevice::loadScene("helmet.gltf", {renderer.log()}));
//   crevice::writeImage("helmet.png", renderer.render({.width = 1280, .height = 720}));
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/Files.h"
#include "core/Image.h"
#include "core/Log.h"
#include "flow/PluginSet.h"
#include "flow/RenderPipeline.h"
#include "flow/StageRegistry.h"
#include "gfx/Device.h"
#include "plan/PipelineAsset.h"
#include "scene/SceneAsset.h"

namespace crevice {

struct RendererOptions {
    std::string device{};   ///< Index or part of a name; empty = the best.
    bool validate = false;  ///< Vulkan validation, synchronization included.
    bool useCache = true;   ///< SPIR-V and blurred environments on disk.
    /// False: once a pipeline has the scene, scene() keeps no vertices, indices and pixels, and another pipeline must
    /// be loaded before setScene(). Saves half of a big scene's memory.
    bool keepScene = true;
    bool defaultLight = true;  ///< A scene without lights gets a key light, ambient and an environment, with a note.
    bool defaultEnvironment = true;  ///< False: without the latter.
    AssetRoots roots = AssetRoots::standard();
    Log log{};
    UploadProgress uploadProgress{};  ///< Is told how much of a scene is on the device.
    DeviceFaults faults{};            ///< For tests.
};

/// One picture to make.
struct View {
    std::uint32_t width = 1280, height = 720;
    std::optional<Camera> camera{};    ///< Nothing = the scene's first, else one that frames the scene.
    glm::vec4 background{0, 0, 0, 1};  ///< sRGB, straight alpha; shows where nothing was drawn.
    std::uint32_t frameIndex = 0;
    std::vector<std::string> keep{};  ///< Targets that target() can return afterwards.
};

class Renderer {
public:
    explicit Renderer(RendererOptions options);
    ~Renderer();

    /// Classes for documents to name; add yours before load().
    StageRegistry& stages() { return registry_; }
    void loadPlugin(const std::filesystem::path& path) { plugins_.load(path, registry_); }
    /// Documents may name plugins of this folder. Without it and loadPlugin(), opening a document never runs code.
    void allowPlugins(const std::filesystem::path& folder) { plugins_.allowFolder(folder); }

    /// Reads a pipeline document; `run` is what the caller expects to draw. Throws Error. Effects that lie beside a
    /// document that is given by path go before ours.
    void load(PipelineRequest request, const RunInfo& run = {});
    /// Takes the scene over and uploads it. Throws Error.
    void setScene(Scene scene);

    /// Renders and waits; RGBA8, sRGB-encoded. Needs a pipeline and a scene.
    Image render(const View& view);
    /// Several cameras and sizes in one pipeline, one after the other.
    std::vector<Image> render(std::span<const View> views);
    /// A target that the last view kept, raw.
    Image target(const std::string& name) const { return pipeline_->image(name); }

    const Scene& scene() const { return scene_; }
    /// The camera a view is rendered with: near and far filled in.
    Camera cameraFor(const View& view) const;
    /// In force for the scene: its own EV, or the automatic one.
    float exposureEv() const { return exposureEv_; }
    const Log& log() const { return options_.log; }
    Log& log() { return options_.log; }
    const AssetRoots& roots() const { return options_.roots; }
    Device& device() { return device_; }
    EffectLibrary& effects() { return effects_; }
    RenderPipeline& pipeline() { return *pipeline_; }

private:
    void prepare();

    RendererOptions options_;
    PluginSet plugins_;  // before the registry: code outlives the objects made from it
    StageRegistry registry_;
    Device device_;
    EffectLibrary effects_;
    Scene scene_;
    Aabb bounds_;                     ///< Of scene_.
    std::vector<glm::vec3> outline_;  ///< Of scene_, when it has no camera.
    float exposureEv_ = 0;            ///< In force for scene_.
    bool hasScene_ = false;           ///< With all its vertices and pixels.
    std::unique_ptr<RenderPipeline> pipeline_;
};

}  // namespace crevice
