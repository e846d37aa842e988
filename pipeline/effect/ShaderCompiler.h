// GLSL stages to SPIR-V with bindings by name; errors come back in the author's files and lines.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "effect/Includes.h"
#include "effect/ShaderInfo.h"

namespace crevice {

/// A stage ready for the compiler: head (version, defines) and flattened text.
struct StageSource {
    ShaderStageBits stage = kVertexBit;
    std::string head;       ///< Lines in front of the text; they have no place in a file.
    std::string text;       ///< As `flat.text`, with lines emptied that are not GLSL, and the entry appended.
    FlatSource flat;        ///< Places.
    bool numbered = false;  ///< All locations, sets and bindings are written in `text`: the compiler keeps them.
};

struct StageCode {
    ShaderStageBits stage = kVertexBit;
    std::vector<std::uint32_t> words;
};

/// Owns glslang's process-wide tables while it lives; they are built by the first compile (60-85 ms).
class ShaderCompiler {
public:
    ShaderCompiler();
    ~ShaderCompiler();

    /// All stages of one pass together, so that names agree. Empty when `problems` got an error.
    /// Numbered stages do not depend on each other: they may be compiled one by one.
    std::vector<StageCode> compile(std::span<const StageSource> stages, const BindingMap& bindings, Problems& problems);
    /// Changes when equal text may give other code: part of cache keys.
    static std::string version();

private:
    struct Process;
    std::unique_ptr<Process> process_;
};

}  // namespace crevice
