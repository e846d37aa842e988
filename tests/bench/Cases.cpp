// Each stage is a submission of its own here, so that the process's clock can be read between them.
#include "Cases.h"

#include <algorithm>

#include <fmt/format.h>

#include "ProcessClock.h"
#include "scene/SceneAsset.h"

namespace crevice::bench {
namespace {

constexpr const char* kReadback = "readback";

}  // namespace

std::vector<CaseDesc> benchCases() {
    return {
        {"full", "everything on: shadow map 1024², PCF 3x3, SSAO 64, blur, FXAA", "ssao-deferred"},
        {"plain",
         "G-buffer to tone mapping: shadows and FXAA off",
         "ssao-deferred",
         {{"shadows", "false"}, {"fxaa", "false"}}},
        {"article",
         "the article's pass: float world positions, kernel in a block",
         "ssao-deferred",
         {{"form", "article"}, {"shadows", "false"}, {"fxaa", "false"}},
         {{"cc_gbuffer_positionMap.format", "RGBA32F"}}},
    };
}

std::string benchScene(const BenchView& view, const Log& log) {
    if (!view.scene.empty()) return view.scene;
    const std::filesystem::path folder(CREVICE_BENCH_DIR);
    if (std::filesystem::exists(folder / "../../../shared/scenes/atrium/atrium.gltf"))
        return (folder / "atrium.scene.json").string();
    log.note(
        "the atrium is not here (../shared/scenes/atrium/atrium.gltf): the default scene is measured instead; "
        "the bars of docs/performance.md are for the atrium");
    return (folder / "../../assets/scenes/default.scene.json").string();
}

BenchCase::BenchCase(const CaseDesc& desc, const BenchView& view)
    : desc_(desc), renderer_(std::make_unique<Renderer>(RendererOptions{.log = Log(LogLevel::Warning)})) {
    view_.width = view.width;
    view_.height = view.height;
    renderer_->load({.nameOrPath = desc.pipeline, .options = desc.options, .sets = desc.sets},
                    {.width = view.width, .height = view.height, .frames = 100});
    renderer_->setScene(
        loadScene(benchScene(view, Log(LogLevel::Error)), {.log = renderer_->log(), .allowOutside = true}));
}

void BenchCase::run(const std::vector<std::string>& keep) {
    view_.keep = keep;
    std::vector<StageCost> costs;
    ProcessStopwatch watch;
    renderer_->pipeline().observeStages([&](std::string_view stage) {
        if (stage == kReadback) return;
        costs.push_back({std::string(stage), watch.lap()});
    });
    picture_ = renderer_->render(view_);
    renderer_->pipeline().observeStages({});
    double frame = 0;
    for (const StageCost& cost : costs) frame += cost.ms;
    frameMs_ = warm_ ? std::min(frameMs_, frame) : frame;
    if (!warm_) stages_ = costs;
    for (std::size_t i = 0; i < costs.size(); ++i) stages_[i].ms = std::min(stages_[i].ms, costs[i].ms);
    warm_ = true;
}

double BenchCase::stageMs(const std::string& stage) const {
    const auto found =
        std::find_if(stages_.begin(), stages_.end(), [&](const StageCost& s) { return s.stage == stage; });
    if (found == stages_.end()) throw Error(fmt::format("case '{}' has no stage '{}'", desc_.name, stage));
    return found->ms;
}

}  // namespace crevice::bench
