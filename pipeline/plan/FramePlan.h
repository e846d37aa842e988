// Order, attachments, states and transitions of a frame, computed from declarations alone: no Vulkan, exhaustively testable.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plan/PipelineDesc.h"

namespace crevice {

/// The state a target is in while a stage runs.
enum class TargetState : std::uint8_t {
    Undefined, Color, Depth, DepthReadOnly, Sampled, StorageRead, StorageWrite, TransferSource, TransferDest
};

/// How a stage writes or tests a target.
enum class WriteKind : std::uint8_t { Color, DepthTest, DepthWrite, Storage };

struct TargetWrite {
    std::string target;
    WriteKind kind = WriteKind::Color;
    bool blends = false;      ///< The later of two writers that neither blends nor tests depth earns a warning.
    std::uint32_t mip = 0;
    SourceLoc where;
};

struct TargetRead {
    std::string target;
    bool storage = false;     ///< Read by imageLoad instead of a sampler.
    std::uint32_t mip = 0;
    std::string shaderName;
    SourceLoc where;          ///< The line in the effect that samples it.
};

/// What one stage said in declare(), plus the reads found in its shaders.
struct StageUse {
    std::string stage;
    std::string flow;
    bool enabled = true;
    bool compute = false;
    std::vector<TargetWrite> writes;   ///< Colour outputs in location order.
    std::vector<TargetRead> reads;
    SourceLoc where;
};

struct Transition {
    std::string target;
    TargetState from = TargetState::Undefined;
    TargetState to = TargetState::Undefined;
    bool operator==(const Transition&) const = default;
};

struct PlannedWrite {
    TargetWrite write;
    bool clears = false;      ///< First write of the frame: load op clear. Otherwise load.
};

struct PlannedStage {
    std::size_t use = 0;      ///< Index into FramePlan::uses.
    std::vector<PlannedWrite> writes;
    std::vector<TargetRead> reads;
    std::vector<Transition> before;
};

/// First and last planned stage that touches a target, and everything it is used as.
struct TargetLife {
    std::string target;
    int firstUse = -1, lastUse = -1;
    bool color = false, depth = false, sampled = false, storage = false, transferSource = false, transferDest = false;
    bool neverWritten = false;  ///< Holds its clear value; cleared once, at creation.
};

struct FramePlan {
    std::vector<StageUse> uses;            ///< All stages in document order, disabled ones included.
    std::vector<PlannedStage> stages;      ///< Enabled ones, in order.
    std::vector<Transition> atEnd;         ///< The output to transfer source.
    std::vector<TargetLife> lives;         ///< Per target of the document, in order.
    std::string output;
    Problems notes;                        ///< Warnings and notes.
};

/// Plans a frame. Throws Error when a target is undeclared, read before its first write, read and written by one stage
/// (depth that is only tested may be sampled), when attachment sizes differ, or when the output is never written.
/// Extra targets that must be readable at the end (`--dump`) are handled by the caller after the plan.
FramePlan planFrame(const PipelineDesc& desc, std::vector<StageUse> uses);

/// The table of `crevice plan`, and the Graphviz form.
std::string planTable(const FramePlan& plan, const PipelineDesc& desc, std::uint32_t width, std::uint32_t height);
std::string planDot(const FramePlan& plan);

/// "color", "sampled"… as the table prints it.
const char* stateName(TargetState state);

}  // namespace crevice
