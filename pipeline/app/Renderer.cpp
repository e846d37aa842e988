// Puts the layers together in the order in which they own each other.
#include "app/Renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "flow/FrameData.h"
#include "scene/EnvironmentCube.h"
#include "scene/Framing.h"
#include "stages/Builtin.h"

namespace crevice {
namespace {

constexpr float kDefaultFovY = 0.785398f;

std::uint8_t toByte(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

/// Pixels that nothing covers have alpha 0 and are premultiplied; the background shows through them.
void putBackground(Image& image, const glm::vec4& background) {
    if (image.format != Format::RGBA8 && image.format != Format::RGBA8_SRGB) return;
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        auto* pixel = reinterpret_cast<std::uint8_t*>(&image.pixels[i]);
        if (pixel[3] == 255) continue;
        const float alpha = static_cast<float>(pixel[3]) / 255.0f;
        const float behind = (1.0f - alpha) * background.a;
        const float total = alpha + behind;
        for (int c = 0; c < 3; ++c) {
            const float sum = static_cast<float>(pixel[c]) / 255.0f + background[c] * behind;
            pixel[c] = total > 0 ? toByte(sum / total) : std::uint8_t{0};
        }
        pixel[3] = toByte(total);
    }
}

}  // namespace

Renderer::Renderer(RendererOptions options)
    : options_(std::move(options)),
      device_(DeviceOptions{.log = options_.log,
                            .device = options_.device,
                            .validate = options_.validate,
                            .syncValidation = options_.validate,
                            .faults = options_.faults}),
      effects_(options_.roots, options_.log, {.useDiskCache = options_.useCache}) {
    registerBuiltinStages(registry_);
}

Renderer::~Renderer() = default;

void Renderer::load(PipelineRequest request, const RunInfo& run) {
    if (!request.defaultPriority) {
        request.defaultPriority = [this](const std::string& stageClass) { return registry_.priorityOf(stageClass); };
    }
    const AssetRoots roots = options_.roots.forDocument(request.nameOrPath);
    plugins_.loadNeeded(roots, request, registry_);
    PipelineDesc desc = loadPipeline(roots, request);
    pipeline_.reset();
    effects_.setRoots(roots);
    pipeline_ = std::make_unique<RenderPipeline>(device_, effects_, registry_, options_.log, std::move(desc), run);
    pipeline_->observeUpload(options_.uploadProgress);
    if (hasScene_) prepare();
}

void Renderer::setScene(Scene scene) {
    scene_ = std::move(scene);
    hasScene_ = true;
    if (options_.defaultLight && addDefaultLight(scene_, options_.defaultEnvironment)) {
        options_.log.note(
            "the scene has no lights: a key light and ambient light were added (--no-default-light leaves it dark)");
    }
    if (scene_.environment && !scene_.environment->cube) {
        scene_.environment->cube = cachedEnvironmentCube(
            scene_.environment->radiance, options_.useCache ? cacheFolder("environments") : std::nullopt);
    }
    bounds_ = scene_.bounds();
    outline_ = scene_.cameras.empty() ? outlineOf(scene_) : std::vector<glm::vec3>();
    exposureEv_ = scene_.exposureEv ? *scene_.exposureEv : autoExposureEv(scene_);
    if (pipeline_) prepare();
}

void Renderer::prepare() {
    if (options_.keepScene)
        pipeline_->prepare(scene_);
    else
        pipeline_->prepareReleasing(scene_);
    hasScene_ = options_.keepScene;
    options_.log.verbose(fmt::format("exposure {:.3g} EV{}", exposureEv(), scene_.exposureEv ? "" : " (automatic)"));
}

Camera Renderer::cameraFor(const View& view) const {
    const float aspect = static_cast<float>(view.width) / static_cast<float>(view.height);
    Camera camera = view.camera               ? *view.camera
                    : !scene_.cameras.empty() ? scene_.cameras.front()
                                              : frameOutline(outline_, bounds_, kDefaultFovY, aspect);
    fitNearFar(camera, bounds_);
    return camera;
}

Image Renderer::render(const View& view) {
    assert(pipeline_ && pipeline_->scene() && "load() and setScene() come first");
    FrameView frame;
    frame.camera = cameraFor(view);
    frame.extent = {view.width, view.height};
    frame.projection = frame.camera.projection(static_cast<float>(view.width) / static_cast<float>(view.height));
    frame.exposure = exposureFromEv(exposureEv());
    frame.frameIndex = view.frameIndex;
    pipeline_->render(frame, view.keep);
    Image image = pipeline_->output();
    putBackground(image, view.background);
    return image;
}

std::vector<Image> Renderer::render(std::span<const View> views) {
    std::vector<Image> images;
    for (const View& view : views) images.push_back(render(view));
    return images;
}

}  // namespace crevice
