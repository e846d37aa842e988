// A pipeline document that runs: owns its targets, set 0 and stages, and records frames exactly as planned.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/Image.h"
#include "flow/EnvironmentGpu.h"
#include "flow/FrameProgram.h"
#include "flow/StageExecution.h"
#include "gfx/Readback.h"

namespace crevice {

/// GPU time of one stage in the last frame.
struct StageTime {
    std::string flow, stage;
    double milliseconds = 0;
};

class RenderPipeline {
public:
    /// Throws Error with everything wrong in the document, its effects and materials.
    RenderPipeline(Device& device, EffectLibrary& library, const StageRegistry& registry, const Log& log,
                   PipelineDesc desc, RunInfo run);
    ~RenderPipeline();

    /// Uploads the scene, compiles what its materials need and plans the frame. The scene must outlive its use here,
    /// unchanged.
    void prepare(const Scene& scene) { prepare(scene, nullptr); }
    /// The same; what is uploaded is let go of in the scene: see SceneGpu::makeReleasing().
    void prepareReleasing(Scene& scene) { prepare(scene, &scene); }

    /// Is told how much of a scene prepare() has uploaded.
    void observeUpload(UploadProgress progress) { uploadProgress_ = std::move(progress); }

    /// Renders one frame and waits. Targets are made anew only when the extent differs from the last frame's.
    /// With a guard in the document the frame is rendered with a border (see guardedView()), and image() is without it.
    /// `keep`: targets whose contents image() can return afterwards, besides the output.
    void render(const FrameView& frame, std::span<const std::string> keep = {});

    /// Called with a stage's name ("readback" at the end) when the device has finished it: for profilers that measure
    /// the processor. Every stage becomes a submission of its own.
    void observeStages(std::function<void(std::string_view stage)> observer) { stageDone_ = std::move(observer); }

    /// A target as the last frame left it: the output, or one that was kept. Of one with a guard, what shows the frame.
    Image image(std::string_view target) const;
    Image output() const { return image(program_.desc().output); }

    const FrameProgram& program() const { return program_; }
    const SceneGpu* scene() const { return scene_.get(); }
    std::uint64_t targetBytes() const { return targets_ ? targets_->bytes() : 0; }
    /// Vulkan pipelines that the driver has made so far: rendering and resizing make none.
    std::size_t pipelinesMade() const { return pipelines_.createdCount(); }
    /// Per stage, in order; their sum against frameMilliseconds() shows what transitions and read-back cost.
    std::vector<StageTime> stageTimes() const;
    double frameMilliseconds() const;
    /// Draw calls of the last frame.
    std::uint64_t drawCount() const { return commands_.drawCount() - drawsBefore_; }
    /// Barriers of targets in the last frame, for comparison with the plan.
    const std::vector<RecordedBarrier>& recordedBarriers() const { return barriers_; }

private:
    struct Kept;
    void prepare(const Scene& scene, Scene* releasing);
    void prepareEnvironment(const Scene& scene);
    void activate(glm::uvec2 extent);
    void writeLights(const Scene& scene);
    void uploadFrameBlocks(const FrameView& view);
    void recordStage(StageExecution& execution, const FrameView& view);
    void recordTransitions(const std::vector<Transition>& transitions);
    void beginStage(const StageExecution& execution);
    void recordReadback(std::string_view target);

    Device& device_;
    const Log& log_;
    FrameProgram program_;
    SamplerCache samplers_;
    DescriptorPool pool_;
    PipelineLayoutCache layouts_;
    PipelineCache pipelines_;
    DefaultTextures defaults_;
    FileTextures files_;
    GlobalSet globals_;
    LocalSet locals_;
    QuadMesh quad_;
    Commands commands_;
    std::unique_ptr<Timestamps> timestamps_;
    std::unique_ptr<SceneGpu> scene_;
    Buffer lights_, lightGrid_;
    std::unique_ptr<EnvironmentGpu> environment_;
    std::unique_ptr<TargetPool> targets_;
    std::unique_ptr<ExecutionContext> context_;
    std::vector<std::unique_ptr<StageExecution>> executions_;
    glm::uvec2 frame_{0};  ///< Pixels of the last frame, without the guard.
    FrameLights frameLights_;
    std::uint64_t drawsBefore_ = 0;
    bool warnedOfLights_ = false;
    std::uint32_t guard_ = 0;  ///< Pixels around it.
    std::vector<std::unique_ptr<Kept>> kept_;
    std::vector<RecordedBarrier> barriers_;
    std::function<void(std::string_view)> stageDone_;
    UploadProgress uploadProgress_;
};

}  // namespace crevice
