// `crevice render`: scenes through a pipeline into pictures.
#include <algorithm>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/Renderer.h"
#include "app/commands/Commands.h"
#include "app/commands/DumpTarget.h"
#include "app/commands/Interrupt.h"
#include "app/commands/OpenScene.h"
#include "app/commands/OutputFiles.h"
#include "app/commands/RenderOptions.h"
#include "app/commands/Timings.h"
#include "flow/StageChecks.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice render default -o default.png\n"
    "  crevice render default -p deferred -o small.png --size 320x180 --eye -1,2,4 --target 0,0.5,0\n"
    "  crevice render default -o lit.png --option ssao=false --dump viewDepth=depth.exr --background transparent\n";

/// One run of the command: everything it holds, in the order it is needed.
class RenderRun {
public:
    RenderRun(const RenderOptions& options, const PipelineChoice& pipeline, RenderJob job)
        : options_(options), pipeline_(pipeline), job_(std::move(job)), progress_(options.console.quiet) {}

    int run() {
        // What is wrong with the input is told before a device is made.
        const glm::uvec2 size = job_.view.size;
        checkStages(pipeline_.desc(), pipeline_.classes().registry(), {.width = size.x, .height = size.y});
        if (job_.items.size() > 1 || job_.eachFrame) interrupt_.emplace();
        loadScene(0);
        start();
        for (std::size_t i = 0; i < job_.items.size(); ++i) renderScene(i);
        if (interrupt_) interrupt_->check();
        if (reportValidation()) return 1;
        if (!options_.timings.empty()) files_.add(options_.timings, timingsJson(timings_));
        progress_.clear();
        for (const std::filesystem::path& path : files_.commit()) print(path.string() + "\n");
        return 0;
    }

private:
    void loadScene(std::size_t index);
    void start();
    void compile();
    void renderScene(std::size_t index);
    void renderFrames(const RenderItem& item, const View& view);
    void writeDumps(const View& view);
    bool reportValidation();

    const RenderOptions& options_;
    const PipelineChoice& pipeline_;
    RenderJob job_;
    Progress progress_;
    std::optional<Interrupt> interrupt_;  ///< Only for several pictures: a single one leaves nothing behind.
    Timings timings_;
    Stopwatch watch_;
    OutputFiles files_;
    Scene scene_;                               ///< The next one to render.
    std::optional<Camera> camera_;              ///< Chosen for it.
    glm::vec4 background_{0, 0, 0, 1};          ///< Its camera's, where --background is not given.
    std::vector<StageSet> wanted_, sceneSets_;  ///< What it says of the pipeline, and what that was loaded with.
    std::string uploading_;                     ///< What progress says while the device gets the scene.
    std::unique_ptr<Renderer> renderer_;
};

void RenderRun::loadScene(std::size_t index) {
    const RenderItem& item = job_.items[index];
    const std::string title = fmt::format("{}/{} {}", index + 1, job_.items.size(), item.scene.name);
    progress_.show(title + ": loading …");
    watch_.lap();
    SceneOptions loading = options_.loading;
    loading.aspect = static_cast<float>(job_.view.size.x) / static_cast<float>(job_.view.size.y);
    loading.progress = [this, &title](std::string_view what, float share) {
        progress_.show(fmt::format("{}: {} {:.0f} %", title, what, 100 * share));
    };
    OpenedScene opened = openScene(item.scene, pipeline_, makeLog(options_.console, progress_), loading);
    scene_ = std::move(opened.scene);
    wanted_ = std::move(opened.sets);
    const bool fromScene = opened.background && options_.view.background.empty();
    background_ = fromScene ? *opened.background : job_.view.background;
    Limits limits;
    for (const std::string& limit : options_.loading.limits) setLimit(limits, limit);
    job_.environment.apply(scene_, makeLog(options_.console, progress_), limits);
    camera_ = chooseCamera(job_.view, scene_);
    timings_.loadMs += watch_.lap();
}

void RenderRun::start() {
    timings_.pixels = std::uint64_t(job_.view.size.x) * job_.view.size.y;
    watch_.lap();
    renderer_ = std::make_unique<Renderer>(RendererOptions{.device = options_.device,
                                                           .validate = options_.validate,
                                                           .useCache = !options_.noCache,
                                                           .keepScene = false,
                                                           .defaultLight = !options_.noDefaultLight,
                                                           .defaultEnvironment = !job_.environment.isNone(),
                                                           .roots = pipeline_.roots(),
                                                           .log = makeLog(options_.console, progress_),
                                                           .uploadProgress = [this](float share) {
                                                               progress_.show(
                                                                   fmt::format("{} {:.0f} %", uploading_, 100 * share));
                                                           }});
    pipeline_.addEffects(renderer_->effects());
    timings_.deviceMs = watch_.lap();
    for (const std::filesystem::path& plugin : pipeline_.classes().pluginFiles()) renderer_->loadPlugin(plugin);
    compile();
}

void RenderRun::compile() {
    progress_.show(fmt::format("compiling {} …", pipeline_.desc().name));
    const auto frames = static_cast<std::uint32_t>(std::min<std::size_t>(job_.frames * job_.items.size(), 1u << 30));
    sceneSets_ = wanted_;
    PipelineRequest request = pipeline_.request();
    request.sets.insert(request.sets.begin(), sceneSets_.begin(), sceneSets_.end());  // those of the command line win
    renderer_->load(request, {.width = job_.view.size.x, .height = job_.view.size.y, .frames = frames});
    timings_.compileMs += watch_.lap();
}

void RenderRun::renderScene(std::size_t index) {
    const RenderItem& item = job_.items[index];
    if (index > 0) loadScene(index);
    watch_.lap();
    const auto isSame = [](const StageSet& a, const StageSet& b) { return a.path == b.path && a.value == b.value; };
    if (!std::ranges::equal(wanted_, sceneSets_, isSame)) compile();
    View view{.width = job_.view.size.x, .height = job_.view.size.y, .background = background_};
    view.camera = camera_;
    for (const Dump& dump : job_.dumps) {
        if (std::find(view.keep.begin(), view.keep.end(), dump.target) == view.keep.end())
            view.keep.push_back(dump.target);
    }
    uploading_ = fmt::format("{}/{} {}: uploading", index + 1, job_.items.size(), item.scene.name);
    progress_.show(uploading_ + " …");
    renderer_->setScene(std::move(scene_));
    timings_.prepareMs += watch_.lap();
    timings_.scenes.push_back({.scene = item.scene.name, .stages = {}, .framesMs = {}});
    renderFrames(item, view);
    writeDumps(view);
}

void RenderRun::renderFrames(const RenderItem& item, const View& view) {
    SceneTimings& times = timings_.scenes.back();
    for (std::uint32_t frame = 0; frame < job_.frames; ++frame) {
        progress_.show(fmt::format("{}: frame {}/{} …", item.scene.name, frame + 1, job_.frames));
        if (interrupt_) interrupt_->check();
        View current = view;
        current.frameIndex = frame;
        const bool last = frame + 1 == job_.frames;
        if (!last) current.keep.clear();
        watch_.lap();
        const Image image = renderer_->render(current);
        timings_.renderMs += watch_.lap();
        times.framesMs.push_back(renderer_->pipeline().frameMilliseconds());
        if (last || job_.eachFrame) files_.add(frameName(item.out, frame), image);
        timings_.writeMs += watch_.lap();
    }
    times.frameMs = times.framesMs.back();
    times.stages = renderer_->pipeline().stageTimes();
}

void RenderRun::writeDumps(const View& view) {
    watch_.lap();
    const Camera camera = renderer_->cameraFor(view);
    for (const Dump& dump : job_.dumps) {
        addDump(files_, dump.path, renderer_->target(dump.target), *pipeline_.desc().findTarget(dump.target), camera);
    }
    timings_.writeMs += watch_.lap();
}

bool RenderRun::reportValidation() {
    const std::uint32_t count = options_.validate ? renderer_->device().validationMessageCount() : 0;
    if (count == 0) return false;
    progress_.clear();
    for (const std::string& message : renderer_->device().validationMessages()) renderer_->log().error(message);
    renderer_->log().error(fmt::format("{} validation message{}: nothing was written", count, count == 1 ? "" : "s"));
    return true;
}

int runRender(const RenderOptions& options) {
    const PipelineChoice pipeline(options.pipeline, options.pipelineOptions, makeLog(options.console), options.scenes);
    return RenderRun(options, pipeline, planRender(options, pipeline)).run();
}

}  // namespace

void addRenderCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("render", "Render scenes into pictures");
    const auto options = std::make_shared<RenderOptions>();
    addRenderOptions(*command, *options);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runRender(*options); }; });
}

}  // namespace crevice
