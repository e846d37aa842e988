// What a stage says of itself in declare(): names of targets, blocks, draws and queues. No GPU object exists yet.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/Document.h"
#include "effect/EffectLibrary.h"
#include "plan/FramePlan.h"
#include "plan/PipelineDesc.h"

namespace crevice {

struct BlockId {
    std::uint32_t index = ~0u;
};
struct DrawId {
    std::uint32_t index = ~0u;
};
struct QueueId {
    std::uint32_t index = ~0u;
};

enum class DepthUse { Test, Write };  ///< Write tests and writes.

/// What the run is expected to draw: lets a stage weigh compile time against frame time.
struct RunInfo {
    std::uint32_t width = 1280, height = 720;  ///< Of the picture; stages see it with the document's guard.
    std::uint32_t frames = 1;
    std::uint64_t pixels() const { return std::uint64_t(width) * height * frames; }
};

struct DrawDeclaration {
    std::string effect;
    bool compute = false;
    Defines defines;  ///< From the stage's code; those of the document win.
    Value material;   ///< Values of properties, from the stage's code; those of the document win.
    std::vector<std::pair<std::uint32_t, std::string>> inputs;  ///< Number of a sampler of set 1 → target.
};

struct QueueDeclaration {
    QueueDesc queue;
    std::string effect;     ///< Draws every scene material; "effect" of the stage in the document overrides.
    bool casters = false;   ///< Only what casts shadows.
    bool perLight = false;  ///< Cocos' forward pipeline: drawn once for each light, opaque materials only.
};

struct BlockDeclaration {
    std::string name;
    std::uint32_t size = 0;
};

/// Everything one stage declared.
struct StageDeclaration {
    std::vector<TargetWrite> writes;
    std::vector<std::string> reads;
    std::vector<BlockDeclaration> blocks;
    std::vector<DrawDeclaration> draws;
    std::vector<QueueDeclaration> queues;
    std::vector<std::pair<std::string, std::string>> chunks;  ///< Generated chunks: name, text.
};

class StageIo {
public:
    StageIo(StageDeclaration& declaration, const StageDesc& desc, const RunInfo& run,
            const PipelineDesc* pipeline = nullptr);

    /// Colour outputs in the order of the fragment shader's locations. "writes" of the document renames them in order.
    void color(std::string_view target);
    void depth(std::string_view target, DepthUse use);
    /// A target that a compute effect writes by imageStore.
    void storage(std::string_view target);
    /// Only for what no effect shows: reads are found in the shaders.
    void read(std::string_view target);

    /// A uniform block of set 0 that this stage fills. sizeof(T) is checked against every effect that declares it.
    template <class T>
    BlockId block(std::string_view name) {
        return addBlock(name, sizeof(T));
    }

    /// A full-screen triangle. The document's "effect", "defines" and "material" apply.
    DrawId fullscreen(std::string_view defaultEffect);
    /// A compute dispatch of an effect's `compute` program.
    DrawId compute(std::string_view defaultEffect);
    /// Scene draws of one phase. The document's "queues" replace the phase and order in the order they are declared.
    QueueId queue(std::string_view phase, QueueSort sort, std::string_view defaultEffect = "standard");

    /// Scene draws of phase `shadow-caster`, of what casts shadows.
    QueueId casters(std::string_view defaultEffect);
    /// Scene draws that FrameContext::drawPerLight() repeats, of materials whose first pass does not blend. The
    /// document's "queues" say nothing of it.
    QueueId perLight(std::string_view phase, std::string_view defaultEffect);

    /// A macro of a draw's effect, where the document gives none.
    void define(DrawId draw, std::string_view macro, std::string_view value);
    /// A property of a draw's material, where the document gives none.
    void property(DrawId draw, std::string_view name, Value value);
    /// Cocos' stages bind images to numbers of the material's set: `target` feeds the sampler with this number, unless
    /// the document's "reads" name another.
    void input(DrawId draw, std::uint32_t binding, std::string_view target);
    /// A generated chunk that effects can include.
    void chunk(std::string_view name, std::string text);

    /// "writes" and "queues" of the document: data-only stages declare what is written there.
    const std::vector<std::string>& documentWrites() const { return desc_.writes; }
    const std::vector<QueueDesc>& documentQueues() const { return desc_.queues; }
    const RunInfo& run() const { return run_; }
    Profile profile() const { return pipeline_ ? pipeline_->profile : Profile::Crevice; }
    /// Whether the document declares the target.
    bool hasTarget(std::string_view target) const;
    const StageDesc& description() const { return desc_; }

private:
    BlockId addBlock(std::string_view name, std::size_t size);
    void addWrite(std::string_view target, WriteKind kind);

    StageDeclaration& declaration_;
    const StageDesc& desc_;
    RunInfo run_;
    const PipelineDesc* pipeline_;
    std::size_t renamed_ = 0;  ///< Colour and storage outputs declared so far.
};

}  // namespace crevice
