// One stage as one text: includes put in once, macros expanded that GLSL cannot expand, pragmas read and taken out.
#pragma once

#include <string>
#include <vector>

#include "cocos/text/ChunkLibrary.h"
#include "cocos/text/StageText.h"

namespace crevice::cocos {

/// What keeps hostile effects from using unbounded time and memory.
struct FlattenLimits {
    std::size_t maxIncludes = 2000;       ///< #include lines that are followed in a stage.
    std::size_t maxBytes = 16u << 20;     ///< Of a stage's text, and of what macros wrote while it came about.
    std::size_t maxDepth = 64;            ///< Nesting of includes, and of macros.
    std::size_t maxExpansions = 10'000;   ///< Macro calls expanded here.
    std::size_t maxArgument = 64u << 10;  ///< Bytes of the arguments of one call.
};

/// A preprocessor line that the analysis needs, in the order of the text.
struct FlatDirective {
    LineKind kind = LineKind::Other;
    std::uint32_t line = 0;                  ///< Of the flat text, counted from 0; PragmaDefine: the line behind it.
    std::size_t offset = 0, length = 0;      ///< Conditionals, Define: the line itself in the flat text.
    const MacroDefinition* macro = nullptr;  ///< Define, PragmaDefine; null when the line is not a chunk's own.
    const StageMacro* meta = nullptr;        ///< Pragma: a description.
    FlatSource::Origin origin{};
};

struct Flattened {
    FlatSource flat;
    std::vector<PragmaMark> marks;
    std::vector<std::string> extensions;
    std::vector<FlatDirective> directives;
    std::vector<std::unique_ptr<StageMacro>> metas;  ///< What `directives` points to.
};

/// `program` is a CCProgram of the effect or a chunk; `where` is the pass that names it.
Flattened flattenStage(const EffectAsset& effect, const std::string& program, const SourceLoc& where,
                       ChunkLibrary& chunks, const FlattenLimits& limits, Problems& problems);

}  // namespace crevice::cocos
