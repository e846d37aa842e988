// What a shader stage declares to the outside: inputs, outputs, blocks, samplers, buffers, images, read from its text
// without evaluating conditions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cocos/text/StageText.h"

namespace crevice::cocos {

/// In the order in which Cocos' compiler numbers the resources of a material.
enum class InterfaceKind : std::uint8_t {
    Block,
    CombinedSampler,
    Sampler,
    Texture,
    Buffer,
    Image,
    SubpassInput,
    Input,   ///< Of a stage: a vertex attribute, or a fragment program's varying.
    Output,  ///< A varying, or a fragment program's output.
};

enum class Builtin : std::uint8_t { None, Global, Local };

/// An array's size. `count` is 1 for what is no array; where a macro has several values it is the largest, uncertain.
struct ArraySize {
    std::int64_t count = 1;
    bool array = false, certain = true;
};

struct InterfaceMember {
    std::string name, type;
    ArraySize size;
    SourceLoc where;
};

/// A piece of the text and what to write there instead.
struct TextEdit {
    std::size_t begin = 0, length = 0;  ///< Bytes.
    std::string text;
};

/// Numbers of one declaration as they are to be written; -1 = none.
struct LayoutNumbers {
    int set = -1, binding = -1, location = -1, attachment = -1;
};

/// One declared name. A statement that declares several (`in vec2 a, b;`) gives one each.
struct InterfaceDeclaration {
    InterfaceKind kind = InterfaceKind::Block;
    std::string name;            ///< A block's own name, else the variable's.
    std::string type;            ///< Of a variable: "vec4", "sampler2D"; empty for a block.
    ArraySize size;              ///< Of a variable, or of a block's instance.
    std::int64_t locations = 1;  ///< Inputs and outputs: how many they take, arrays and matrices several.
    LayoutNumbers literal;       ///< As the author wrote them.
    Builtin builtin = Builtin::None;
    bool readOnly = false, writeOnly = false;
    std::string formatMark;  ///< `#pragma format(NAME)` in front of it.
    std::vector<InterfaceMember> members;
    std::uint32_t conditions = 0;  ///< Index into the stage's `conditions`.
    SourceLoc where;
    std::size_t statement = 0;  ///< Index into StageInterface::statements.
};

/// Where a declaration stands in the text, so that its layout can be written anew. Offsets in bytes.
struct InterfaceStatement {
    std::size_t begin = 0, end = 0;        ///< From its first qualifier to the semicolon; a block: to its brace.
    std::size_t storage = 0;               ///< Of the word in, out, uniform or buffer.
    std::vector<TextEdit> layouts;         ///< Its `layout(…)`; `text` is what stays of each: "std140, rgba8".
    std::size_t firstName = 0;             ///< Several names: where the first one begins.
    std::vector<std::string> declarators;  ///< Several names: each with its array size.
    bool flat = false;                     ///< The word is missing: integers are not interpolated.
    bool fromPragma = false;               ///< A subpass input that a pragma declares: all of it is to be written.
};

/// `cc` in front, in any case: such names belong to the engine, and no material's number is for them.
bool isEngineName(std::string_view name);

struct StageInterface {
    ShaderStageBits stage = kVertexBit;
    std::vector<InterfaceDeclaration> declarations;  ///< In text order.
    std::vector<InterfaceStatement> statements;
};

/// Reports what Cocos' compiler refuses: arrays of blocks, uniforms outside of blocks. Warns of blocks that are not
/// tightly packed.
StageInterface readInterface(const StageText& stage, Problems& problems);

/// Writes `layout(…)` with the given numbers (one set per declaration) into every declaration. Lines stay lines; where
/// conditions among the qualifiers of several names are written once for each, lines are added, in `flat.lines` too.
void writeLayouts(StageText& stage, const StageInterface& interface, const std::vector<LayoutNumbers>& numbers);

}  // namespace crevice::cocos
