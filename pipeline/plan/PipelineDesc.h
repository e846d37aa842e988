// A pipeline document as plain structs, after `extends`, edits, options and `--set`: everything a frame is made from by
// name.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/Document.h"
#include "core/Format.h"

namespace crevice {

enum class SamplerKind : std::uint8_t { PointClamp, LinearClamp, LinearRepeat, ShadowCompare };

struct TargetDesc {
    std::string name;
    Format format = Format::RGBA8;
    float scale = 1.0f;              ///< Of the frame; ignored when `size` is set.
    std::optional<glm::uvec2> size;  ///< Fixed pixels.
    std::string like;                ///< Target that gave what this one's document did not say; empty = none.
    std::uint32_t mips = 1, layers = 1;
    glm::vec4 clear{0};
    SamplerKind sampler = SamplerKind::PointClamp;
    std::optional<std::uint32_t> binding;  ///< Pinned number in set 0 (names that start with cc_ only).
    std::string help;
    SourceLoc where;
    bool isGlobal() const { return name.starts_with("cc_"); }
};

/// "blocks": a pin for a uniform block of set 0.
struct BlockPin {
    std::string name;
    std::optional<std::uint32_t> binding;
    SourceLoc where;
};

enum class QueueSort : std::uint8_t { FrontToBack, BackToFront };
struct QueueDesc {
    std::vector<std::string> phases{"default"};  ///< A pass is drawn when its phase is one of these.
    QueueSort sort = QueueSort::FrontToBack;
    SourceLoc where;
};

struct ReadWire {
    std::string shaderName;  ///< Sampler or image in the stage's effect; empty = an extra read by hand.
    std::string target;      ///< "name" or "name@mip"
    SourceLoc where;
};

struct StageDesc {
    std::string stageClass;  ///< "SsaoStage"
    std::string name;        ///< Unique in the pipeline; default = class.
    bool enabled = true;     ///< Stage's and flow's `enabled`, options resolved.
    std::optional<int> priority;
    std::string effect;  ///< Empty = the class' default.
    SourceLoc effectWhere;
    Value defines;   ///< Object or null.
    Value material;  ///< Object or null.
    Value states;    ///< Object or null: over those of the full-screen effect's pass.
    Value params;    ///< Object or null.
    std::vector<ReadWire> reads;
    std::vector<std::string> writes;
    std::vector<QueueDesc> queues;
    /// How far from its own pixel it reads targets, in pixels of what it writes; null: nobody says.
    std::optional<std::uint32_t> reach{};
    SourceLoc where;
};

struct FlowDesc {
    std::string name;
    std::optional<int> priority;
    bool enabled = true;
    std::vector<StageDesc> stages;
    SourceLoc where;
};

enum class OptionType : std::uint8_t { Bool, Number, Choice };
struct OptionDesc {
    std::string name;
    OptionType type = OptionType::Bool;
    Value defaultValue;
    Value value;              ///< In force.
    double min = 0, max = 0;  ///< Number.
    std::vector<std::string> choices;
    std::string help;
    SourceLoc where;
};

/// Whose numbers sets 0 and 2 have, whose block layouts are bound and in whose units they are filled.
enum class Profile : std::uint8_t { Crevice, Cocos33, Cocos36 };
inline bool isCocos(Profile profile) { return profile != Profile::Crevice; }

/// What a Cocos profile does where a project's files contradict each other; each use is logged.
struct Fallbacks {
    bool rebindLiterals = true;  ///< A literal number of set 0 or 2 that is another name's: the name decides.
    bool globalSamplers = true;  ///< A material sampler that nothing feeds takes the target of set 0 with its name.
};

struct PipelineDesc {
    std::string name;
    std::string path;
    std::vector<std::string> files;  ///< Every file that was read, parents first: the order in which names get numbers.
    std::string help;
    std::string output;  ///< Target that a frame is read back from.
    SourceLoc outputWhere;
    Profile profile = Profile::Crevice;
    Fallbacks fallbacks;
    Value macros;      ///< Object or null: for every effect that knows them, over what its material says.
    double guard = 0;  ///< Percent of the frame's height that is rendered beyond every edge and cut off.
    SourceLoc guardWhere;
    std::vector<std::string> plugins;
    std::vector<TargetDesc> targets;  ///< Document order, parent before child.
    std::vector<BlockPin> blocks;
    std::vector<OptionDesc> options;
    std::vector<FlowDesc> flows;

    const TargetDesc* findTarget(std::string_view target) const;
};

}  // namespace crevice
