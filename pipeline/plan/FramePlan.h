// Order, attachments, states and transitions of a frame, computed from declarations alone, without Vulkan.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "effect/ShaderInfo.h"
#include "plan/PipelineDesc.h"

namespace crevice {

/// The state a target is in while a stage runs.
enum class TargetState : std::uint8_t {
    Undefined,
    Color,
    Depth,
    DepthReadOnly,
    Sampled,
    StorageRead,
    StorageWrite,
    TransferSource,
    TransferDest
};

/// How a stage writes or tests a target.
enum class WriteKind : std::uint8_t { Color, DepthTest, DepthWrite, Storage };

/// Stands for every mip level of a target.
inline constexpr std::uint32_t kAllMips = ~0u;

struct TargetWrite {
    std::string target;
    WriteKind kind = WriteKind::Color;
    bool blends = false;  ///< The later of two writers that neither blends nor tests depth earns a warning.
    std::uint32_t mip = 0;
    SourceLoc where;
};

struct TargetRead {
    std::string target;
    bool storage = false;   ///< Read by imageLoad instead of a sampler.
    std::uint32_t mip = 0;  ///< A level above 0 is read alone ("name@2"); 0 means every level unless `oneMip`.
    std::string shaderName;
    SourceLoc where;      ///< The line in the effect that samples it.
    bool oneMip = false;  ///< Only level `mip` is read: what tells "name@0" from "name".
};

/// What one stage said in declare(), plus the reads found in its shaders.
struct StageUse {
    std::string stage;
    std::string flow;
    bool enabled = true;
    bool compute = false;
    std::vector<TargetWrite> writes;  ///< Colour outputs in location order.
    std::vector<TargetRead> reads;
    SourceLoc where;
    std::optional<std::uint32_t> reach{};  ///< StageDesc::reach.
};

struct Transition {
    std::string target;
    TargetState from = TargetState::Undefined;
    TargetState to = TargetState::Undefined;
    std::uint32_t mip = kAllMips;  ///< One level, or every level of the target.
    bool operator==(const Transition&) const = default;
};

/// All of a guard, however wide it is.
inline constexpr std::uint32_t kWholeGuard = ~0u;

struct PlannedWrite {
    TargetWrite write;
    /// First write of the frame: load op clear. Otherwise load. A storage image that is written first is not cleared:
    /// its old content is lost and the dispatch has to cover every texel.
    bool clears = false;
};

struct PlannedStage {
    std::size_t use = 0;  ///< Index into FramePlan::uses.
    std::vector<PlannedWrite> writes;
    std::vector<TargetRead> reads;
    std::vector<Transition> before;
    std::uint32_t beyond = kWholeGuard;  ///< Pixels of the guard that the stage has to draw: see planGuard().
};

/// First and last planned stage that touches a target, and everything it is used as.
struct TargetLife {
    std::string target;
    int firstUse = -1, lastUse = -1;
    bool color = false, depth = false, sampled = false, storage = false, transferSource = false, transferDest = false;
    bool neverWritten = false;  ///< Holds its clear value; cleared once, at creation, then left in Sampled.
    /// State after `atEnd` (of level 0): what a caller that reads the target back starts from. A frame starts in
    /// Undefined, except for never-written targets: those start, and end, in Sampled.
    TargetState atEnd = TargetState::Undefined;
};

struct FramePlan {
    std::vector<StageUse> uses;        ///< All stages in document order, disabled ones included.
    std::vector<PlannedStage> stages;  ///< Enabled ones, in order.
    std::vector<Transition> atEnd;     ///< The output to transfer source; never-written targets back to Sampled.
    std::vector<TargetLife> lives;     ///< Per target of the document, in order.
    std::string output;
    Problems notes;  ///< Warnings and notes.
};

/// Plans a frame. Throws Error when a target is undeclared, read before its first write, read and written by one stage
/// (depth that is only tested may be sampled), when attachment sizes differ, or when the output is never written.
/// Extra targets that must be readable at the end (`--dump`) are handled by the caller after the plan.
/// A frame is a loop: a plan may follow itself. A transition from Undefined must therefore wait for whatever the frame
/// before still does with the image. Transitions from a state to the same state order two writes.
FramePlan planFrame(const PipelineDesc& desc, std::vector<StageUse> uses);

/// The table of `crevice plan`, and the Graphviz form. With `bindings` the reads show their numbers in set 0.
std::string planTable(const FramePlan& plan, const PipelineDesc& desc, std::uint32_t width, std::uint32_t height,
                      const BindingMap* bindings = nullptr);
std::string planDot(const FramePlan& plan);

/// "color", "sampled"… as the table prints it.
const char* stateName(TargetState state);

}  // namespace crevice
