// The GPU side of one stage: pipelines and bindings of its draws and queues, made in activate(), used while it renders.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "flow/FrameContext.h"
#include "flow/FrameProgram.h"
#include "flow/FrameUpload.h"
#include "flow/LocalSet.h"
#include "flow/QuadMesh.h"
#include "flow/QueueView.h"
#include "flow/ShaderBinding.h"
#include "flow/VertexInput.h"
#include "plan/TargetSize.h"

namespace crevice {

class PipelineLayoutCache;
class PipelineCache;

/// What all stages of a pipeline share; outlives them.
struct ExecutionContext {
    BindingContext bindings;
    PipelineLayoutCache& layouts;
    PipelineCache& pipelines;
    GlobalSet& globals;
    LocalSet& locals;
    const QuadMesh& quad;
    Profile profile;
    Commands& commands;
    const TargetPool& targets;
    const FrameLights& lights;
};

class StageExecution {
public:
    /// Makes layouts, bindings and pipelines. `scene` is null when there is none.
    StageExecution(const ExecutionContext& context, StageProgram& program, const PlannedStage& planned,
                   const SceneGpu* scene);

    /// Targets were made (anew): rewrites what points to them.
    void writeTargets();
    /// A property of a draw's material, unless the document gives it.
    void setProperty(DrawId draw, std::string_view name, const Value& value);
    /// Supplies every property left at `auto`: a length in world units.
    void setAutoLength(float length);

    /// Pixels of what the stage writes; the frame's when it writes nothing.
    glm::uvec2 extent() const { return extent_; }
    /// What of it has to be drawn: see FrameContext::part().
    const FrameCrop& part() const { return part_; }
    const PlannedStage& planned() const { return planned_; }
    RenderStage& stage() const { return *program_.stage; }
    const StageProgram& program() const { return program_; }

    /// Before the stage renders, once a frame, of `frame` pixels with `guard` pixels on each side.
    void beginFrame(glm::uvec2 frame, std::uint32_t guard);

    // What FrameContext hands on.
    void upload(BlockId block, std::span<const std::byte> bytes);
    void draw(DrawId draw);
    void drawQueue(QueueId queue, const glm::mat4& view, const glm::mat4& viewProjection);
    void drawPerLight(QueueId queue, const glm::mat4& view, const glm::mat4& viewProjection);
    void dispatch(DrawId draw, Groups groups);
    Groups groupsFor(DrawId draw) const;
    Commands& commands() { return context_.commands; }
    const SceneGpu* scene() const { return scene_; }

private:
    struct ShaderGpu {
        std::optional<ShaderBinding> binding;
        const Pipeline* pipeline = nullptr;
        const Pipeline* flipped = nullptr;  ///< Surfaces: for instances that mirror.
        /// Blended surfaces with two sides: drawn before `pipeline`, which then has the sides that face the viewer.
        const Pipeline* farSides = nullptr;
        const Pipeline* farSidesFlipped = nullptr;
        bool usesLocal = false, usesQuad = false, usesSame = false;
        std::uint32_t order = 0;
    };
    void loadPictures();
    ShaderGpu makeShader(const EffectVariant& variant, const Material& material, RenderState state, bool surface);
    ShaderGpu makeSurface(const SurfaceProgram& surface);
    const Pipeline& makePipeline(const EffectVariant& variant, const VertexInput& input, const PipelineLayout& layout,
                                 RenderState state);
    void writeShaderTargets(ShaderGpu& shader, const std::vector<Wire>& wires);
    void bindShader(const ShaderGpu& shader, bool flipped);
    QueueView& nextView(QueueId queue);
    /// What a viewer sees of the queue, its rows bound; null when that is nothing.
    const DrawList* bindQueue(QueueId queue, const glm::mat4& view, const glm::mat4& viewProjection);
    /// The passes of one place in the order, as DrawList orders what they are drawn on. `reach`: null, or where a light
    /// ends, world space.
    void drawPasses(QueueId queue, const DrawList& list, std::uint32_t order, const Aabb* reach = nullptr);
    void drawBatch(const ShaderGpu& shader, const DrawBatch& batch, std::span<const std::uint32_t> instances,
                   const Aabb* reach);
    /// One instance after the other, far sides first.
    void drawTwoSided(const ShaderGpu& shader, const DrawBatch& batch, std::span<const std::uint32_t> instances,
                      const Aabb* reach);

    const ExecutionContext& context_;
    StageProgram& program_;
    const PlannedStage& planned_;
    const SceneGpu* scene_;
    std::vector<std::string> depthReadOnly_;
    std::vector<Format> colorFormats_;
    std::optional<Format> depthFormat_;
    bool stencil_ = false;  ///< Of the depth target.
    std::vector<ShaderGpu> draws_;
    using Passes = std::vector<ShaderGpu>;         ///< Of one surface, ascending by order; empty = not drawn.
    std::vector<std::vector<Passes>> queues_;      ///< [queue][surfaceIndex]
    std::vector<std::set<std::uint32_t>> orders_;  ///< Of each queue.
    /// A stage may draw a queue several times a frame, for several viewers: each time has a view of its own.
    struct QueueViews {
        std::vector<std::unique_ptr<QueueView>> views;
        std::size_t used = 0;  ///< In this frame.
    };
    std::vector<QueueViews> views_;  ///< [queue]
    glm::uvec2 extent_{0};
    FrameCrop part_;
};

}  // namespace crevice
