// prepare: program → GPU objects. render: frame blocks, then each stage between its planned barriers.
#include "flow/RenderPipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "core/Text.h"
#include "flow/CocosFrame.h"
#include "flow/FrameData.h"
#include "flow/FrameUpload.h"
#include "flow/LightGrid.h"
#include "flow/RenderStage.h"
#include "gfx/Device.h"
#include "gfx/Pipeline.h"
#include "plan/TargetSize.h"

namespace crevice {
namespace {

class Setup final : public StageSetup {
public:
    Setup(StageExecution& execution, const SceneGpu& scene, glm::uvec2 extent)
        : execution_(execution), scene_(scene), extent_(extent) {}
    const Scene& scene() const override { return scene_.scene(); }
    const Aabb& sceneBounds() const override { return scene_.bounds(); }
    glm::uvec2 extent() const override { return extent_; }
    void setProperty(DrawId draw, std::string_view name, const Value& value) override {
        execution_.setProperty(draw, name, value);
    }

private:
    StageExecution& execution_;
    const SceneGpu& scene_;
    glm::uvec2 extent_;
};

}  // namespace

/// The contents of one target, copied at the end of a frame.
struct RenderPipeline::Kept {
    std::string target;
    Readback readback;
    bool current = false;  ///< Copied by the last frame.
};

RenderPipeline::RenderPipeline(Device& device, EffectLibrary& library, const StageRegistry& registry, const Log& log,
                               PipelineDesc desc, RunInfo run)
    : device_(device),
      log_(log),
      program_(std::move(desc), registry, library, log, run),
      samplers_(device),
      pool_(device),
      layouts_(device),
      pipelines_(device),
      defaults_(device),
      files_(device),
      globals_(device, pool_, samplers_, program_.globals(), defaults_),
      locals_(device, pool_, samplers_, defaults_, program_.desc().profile),
      quad_(device),
      commands_(device, "frame") {}

RenderPipeline::~RenderPipeline() = default;

void RenderPipeline::prepare(const Scene& scene, Scene* releasing) {
    executions_.clear();
    targets_.reset();
    scene_.reset();
    program_.prepare(&scene);
    log_.write(program_.globals().notes());
    log_.write(program_.plan().notes);
    scene_ = releasing ? SceneGpu::makeReleasing(device_, samplers_, *releasing, uploadProgress_)
                       : std::make_unique<SceneGpu>(device_, samplers_, scene, uploadProgress_);
    writeLights(scene);
    targets_ = std::make_unique<TargetPool>(device_, program_.desc(), program_.plan(), program_.stencilTargets());
    context_ = std::make_unique<ExecutionContext>(ExecutionContext{{device_, pool_, samplers_, defaults_, files_},
                                                                   layouts_,
                                                                   pipelines_,
                                                                   globals_,
                                                                   locals_,
                                                                   quad_,
                                                                   program_.desc().profile,
                                                                   commands_,
                                                                   *targets_,
                                                                   frameLights_});
    for (const PlannedStage& planned : program_.plan().stages) {
        executions_.push_back(
            std::make_unique<StageExecution>(*context_, program_.stages()[planned.use], planned, scene_.get()));
    }
    timestamps_ = std::make_unique<Timestamps>(device_, static_cast<std::uint32_t>(executions_.size() + 2));
}

void RenderPipeline::writeLights(const Scene& scene) {
    if (isCocos(program_.desc().profile)) return prepareEnvironment(scene);
    const std::vector<std::byte> lights = punctualLights(scene);
    lights_ =
        Buffer(device_, {.size = lights.size(), .usage = BufferUsage::Storage, .name = "punctual lights"}, lights);
    const float exposure = exposureFromEv(scene.exposureEv ? *scene.exposureEv : autoExposureEv(scene));
    const std::vector<std::byte> grid = lightGridBytes(makeLightGrid(scene, scene_->bounds(), exposure));
    lightGrid_ = Buffer(device_, {.size = grid.size(), .usage = BufferUsage::Storage, .name = "light grid"}, grid);
    globals_.writeBuffer("CCPunctualLights", lights_);  // both, or none
    globals_.writeBuffer("CCLightGrid", lightGrid_);
    prepareEnvironment(scene);
    locals_.writeLights(forwardLightBlock(scene));
    globals_.update();
}

void RenderPipeline::prepareEnvironment(const Scene& scene) {
    EnvironmentGpu::writeNone(globals_, program_.globals());
    globals_.update();  // before the old one goes
    environment_.reset();
    if (!scene.environment) return;
    environment_ = isCocos(program_.desc().profile)
                       ? std::make_unique<EnvironmentGpu>(device_, *scene.environment, ambientScale(scene))
                       : std::make_unique<EnvironmentGpu>(device_, *scene.environment);
    environment_->write(globals_, program_.globals());
    globals_.update();
}

void RenderPipeline::activate(glm::uvec2 extent) {
    if (extent == targets_->extent()) return;
    targets_->checkFits(extent);  // before anything is let go of: a frame that is too large leaves all as it was
    // Set 0 must let go of the old views before they are destroyed: some drivers read them although no shader does.
    for (const TargetDesc& target : program_.desc().targets) {
        if (target.isGlobal() && targets_->extent().x > 0)
            globals_.writeImage(target.name, defaults_.white, target.sampler);
    }
    globals_.update();
    targets_->resize(extent);
    for (const TargetDesc& target : program_.desc().targets) {
        if (target.isGlobal()) globals_.writeImage(target.name, targets_->texture(target.name), target.sampler);
    }
    globals_.update();
    const float autoLength = automaticLength(scene_->bounds());
    for (const auto& execution : executions_) {
        execution->writeTargets();
        execution->setAutoLength(autoLength);
        Setup setup(*execution, *scene_, extent);
        execution->stage().activate(setup);
    }
    log_.verbose(
        fmt::format("{}x{}: targets hold {:.1f} MiB; auto radius {:.4g} world units (1/40 of the scene's diagonal)",
                    extent.x, extent.y, static_cast<double>(targets_->bytes()) / (1 << 20), autoLength));
}

void RenderPipeline::render(const FrameView& frame, std::span<const std::string> keep) {
    assert(scene_ && "prepare() comes first");
    const std::uint32_t guard = guardPixels(program_.desc().guard, frame.extent.y);
    const FrameView view = guardedView(frame, guard);
    activate(view.extent);
    frame_ = frame.extent;
    guard_ = guard;
    drawsBefore_ = commands_.drawCount();
    commands_.begin();
    barriers_.clear();
    commands_.recordBarriersTo(&barriers_);
    commands_.resetTimestamps(*timestamps_);
    locals_.beginFrame();
    uploadFrameBlocks(view);
    std::uint32_t slot = 0;
    commands_.writeTimestamp(*timestamps_, slot++);
    for (const auto& execution : executions_) {
        recordStage(*execution, view);
        commands_.writeTimestamp(*timestamps_, slot++);
        if (!stageDone_) continue;
        commands_.submitAndWait();
        stageDone_(program_.plan().uses[execution->planned().use].stage);
        commands_.begin();
    }
    recordTransitions(program_.plan().atEnd);
    commands_.recordBarriersTo(nullptr);
    for (const auto& kept : kept_) kept->current = false;
    recordReadback(program_.desc().output);
    for (const std::string& target : keep) recordReadback(target);
    commands_.writeTimestamp(*timestamps_, slot++);
    commands_.memoryBarrier();
    commands_.submitAndWait();
    if (stageDone_) stageDone_("readback");
}

void RenderPipeline::uploadFrameBlocks(const FrameView& view) {
    globals_.beginFrame();
    frameLights_ = uploadFrame(globals_, locals_, program_.desc(), view, scene_->scene(), scene_->bounds(),
                               environment_ ? environment_->levels() : 1);
    if (frameLights_.left > 0 && !warnedOfLights_) {
        Problems problems;
        problems.warning(
            {},
            fmt::format("the view sees {} lights more than the {} that Cocos' pipelines have room for here: "
                        "the brightest at the camera are used",
                        frameLights_.left, frameLights_.single.empty() ? std::size_t(kForwardLights) : kSingleLights));
        log_.write(problems);
        warnedOfLights_ = true;
    }
    globals_.save();
}

void RenderPipeline::recordTransitions(const std::vector<Transition>& transitions) {
    std::vector<TextureBarrier> barriers;
    for (const Transition& transition : transitions) {
        const bool all = transition.mip == kAllMips;
        barriers.push_back({.texture = &targets_->texture(transition.target),
                            .from = textureState(transition.from),
                            .to = textureState(transition.to),
                            .firstMip = all ? 0 : transition.mip,
                            .mipCount = all ? 0u : 1u});
    }
    if (!barriers.empty()) commands_.barriers(barriers);
}

void RenderPipeline::beginStage(const StageExecution& execution) {
    RenderingDesc rendering;
    for (const PlannedWrite& planned : execution.planned().writes) {
        const TargetWrite& write = planned.write;
        const GpuTexture& texture = targets_->texture(write.target);
        const glm::vec4 clear = targets_->desc(write.target).clear;
        const LoadOp load = planned.clears ? LoadOp::Clear : LoadOp::Load;
        if (write.kind == WriteKind::Color) {
            rendering.colors.push_back({.texture = &texture, .load = load, .clear = clear, .mip = write.mip});
        } else if (write.kind != WriteKind::Storage) {
            rendering.depth = {.texture = &texture,
                               .load = load,
                               .clear = clear.x,
                               .readOnly = write.kind == WriteKind::DepthTest,
                               .mip = write.mip};
        }
    }
    commands_.beginRendering(rendering);
    const FrameCrop& part = execution.part();
    commands_.setScissor(static_cast<std::int32_t>(part.offset.x), static_cast<std::int32_t>(part.offset.y),
                         part.extent.x, part.extent.y);
}

void RenderPipeline::recordStage(StageExecution& execution, const FrameView& view) {
    const StageUse& use = program_.plan().uses[execution.planned().use];
    commands_.beginLabel(use.flow + " / " + use.stage);
    recordTransitions(execution.planned().before);
    globals_.restore();
    const bool draws = !use.compute && !execution.planned().writes.empty();
    execution.beginFrame(frame_, guard_);
    if (draws) beginStage(execution);
    FrameContext frame(execution, view, scene_->scene());
    execution.stage().render(frame);
    if (draws) commands_.endRendering();
    commands_.endLabel();
}

void RenderPipeline::recordReadback(std::string_view target) {
    auto found = std::find_if(kept_.begin(), kept_.end(), [&](const auto& kept) { return kept->target == target; });
    if (found == kept_.end()) {
        kept_.push_back(std::make_unique<Kept>(Kept{std::string(target), Readback(device_)}));
        found = kept_.end() - 1;
    }
    if ((*found)->current) return;
    const std::vector<TargetLife>& lives = program_.plan().lives;
    const auto life = std::find_if(lives.begin(), lives.end(), [&](const TargetLife& l) { return l.target == target; });
    if (life == lives.end()) {
        std::vector<std::string> names;
        for (const TargetLife& l : lives) names.push_back(l.target);
        throw Error(fmt::format("pipeline '{}' has no target '{}'", program_.desc().name, target),
                    didYouMean(target, names, "targets"));
    }
    const GpuTexture& texture = targets_->texture(target);
    const TextureState state = textureState(life->atEnd);
    const bool moves = state != TextureState::TransferSource;
    if (moves) commands_.barrier(texture, state, TextureState::TransferSource);
    (*found)->readback.record(commands_, texture);
    if (moves && life->neverWritten) commands_.barrier(texture, TextureState::TransferSource, TextureState::Sampled);
    (*found)->current = true;
}

Image RenderPipeline::image(std::string_view target) const {
    for (const auto& kept : kept_) {
        if (kept->target != target || !kept->current) continue;
        Image whole = kept->readback.image();
        if (guard_ == 0) return whole;
        const FrameCrop crop = frameCrop(targets_->desc(target), frame_.x, frame_.y, guard_);
        return cropped(whole, crop.offset, crop.extent);
    }
    throw Error(fmt::format("target '{}' was not kept by the last frame", target), "name it in render()'s keep");
}

std::vector<StageTime> RenderPipeline::stageTimes() const {
    const std::vector<double> times = timestamps_->read(static_cast<std::uint32_t>(executions_.size() + 2));
    std::vector<StageTime> result;
    for (std::size_t i = 0; i < executions_.size(); ++i) {
        const StageUse& use = program_.plan().uses[executions_[i]->planned().use];
        result.push_back({use.flow, use.stage, (times[i + 1] - times[i]) * 1e-6});
    }
    result.push_back({"", "readback", (times[executions_.size() + 1] - times[executions_.size()]) * 1e-6});
    return result;
}

double RenderPipeline::frameMilliseconds() const {
    const std::vector<double> times = timestamps_->read(static_cast<std::uint32_t>(executions_.size() + 2));
    return (times.back() - times.front()) * 1e-6;
}

}  // namespace crevice
