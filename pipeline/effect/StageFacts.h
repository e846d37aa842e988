// What one stage's code declares and uses, and how the facts of a pass' stages come together.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "effect/ShaderCompiler.h"

namespace crevice {

/// What crosses between stages: an output of the vertex stage, or an input of the fragment stage.
struct StageVarying {
    std::string name, type;
    bool active = false;
    SourceLoc where;
};

/// Of one stage alone: stages that passes share are looked into once.
struct StageFacts {
    ShaderInfo info;
    std::vector<StageVarying> varyings;
    bool numbered = false;
    struct Mistake {
        std::optional<std::size_t> resource;  ///< Of `info`: it is told where that one is declared first.
        Problem problem;
    };
    std::vector<Mistake> mistakes;
    ShaderStageBits stage = kVertexBit;
};

/// By SPIRV-Cross; places are looked up in the source.
StageFacts reflectStage(const StageCode& code, const StageSource& source);

/// The facts of a pass, vertex before fragment. Reports what a stage declares that Crevice has no use for, and varyings
/// that do not fit.
ShaderInfo joinStages(std::span<const StageFacts* const> stages, Problems& problems);

}  // namespace crevice
