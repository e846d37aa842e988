// What the front end knows of one shader stage before its interface is numbered: the flattened text and all that stood
// in its pragmas and conditions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "effect/Defines.h"
#include "effect/Includes.h"
#include "effect/ShaderInfo.h"

namespace crevice::cocos {

/// What a pragma says about a declaration.
struct PragmaMark {
    /// BuiltinGlobal, BuiltinLocal: the next block, sampler, buffer or image belongs to set 0 or 2. Format, GlBinding:
    /// the next image or buffer. Rate, SubpassColor, SubpassDepth: the declaration of `name`.
    enum class Kind : std::uint8_t { BuiltinGlobal, BuiltinLocal, Rate, Format, GlBinding, SubpassColor, SubpassDepth };
    Kind kind = Kind::BuiltinGlobal;
    std::string name;  ///< The uniform or subpass input meant, where the pragma has one.
    std::string
        value;     ///< Rate: "pass", "batch", … or empty; Format: "RGBA16UI"; GlBinding: the number; Subpass: "in".
    int line = 0;  ///< Of `flat.text`, counted from 1: where the pragma stood; the line is empty now.
    char scalar = 'f';  ///< Subpass: of its components: f, i or u.
};

/// A macro that a condition of the stage tests or a metadata pragma declares; its value comes from outside.
struct StageMacro {
    DefineInfo info;
    std::vector<std::string> conditions;  ///< Of its first occurrence: "USE_X", "!USE_Y".
    bool hasDefault = false;              ///< A pragma gives one.
    bool constant = false;                ///< The engine gives it a value, no material does: its default is no bool.
    bool inferred = false;  ///< A number with Cocos' usual range because a condition compares it; no pragma says so.
};

/// One stage. `flat.text` is GLSL with preprocessor lines, whose pragmas (these), includes and comments are gone;
/// `#pragma define` became `#define` in its first lines; macros whose bodies hold preprocessor lines, and those in
/// front of interface declarations, are expanded; the entry's main() is its last line. Lines stay lines: whoever edits
/// the text must keep their number, or `flat.lines` and `conditionOf` with it.
struct StageText {
    ShaderStageBits stage = kVertexBit;
    FlatSource flat;
    std::vector<PragmaMark> marks;        ///< Ascending by line.
    std::vector<std::string> extensions;  ///< Whole lines for the head: "#extension NAME : require".
    std::vector<StageMacro> macros;       ///< In order of first occurrence; without engine constants.
    std::vector<std::string> defined;     ///< Names that the text defines itself, sorted.
    /// Per line of `flat.text` the index of its enclosing conditions in `conditions` (0 = none). Each is a list of
    /// macro names, "!" in front of those that must be off; only simple names are kept.
    std::vector<std::uint32_t> conditionOf;
    std::vector<std::vector<std::string>> conditions{{}};
};

struct NumberingOptions {
    bool rebindByName = true;  ///< A literal set 0 or 2 number that differs from the binding map's is replaced, noted.
    bool subpassSamplers = false;  ///< Subpass inputs have no attachment number: they are read as samplers.
};

/// Writes `layout(…)` with location, set and binding into every interface declaration of a pass' stages (vertex before
/// fragment), in branches that are not taken too, and keeps the lines' origins. The rules are those of Cocos'
/// compiler: see docs/from-cocos.md.
void numberStages(std::vector<StageText>& stages, const BindingMap& bindings, const NumberingOptions& options,
                  Problems& problems);

}  // namespace crevice::cocos
