// Puts a shader stage together from programs and chunks, and remembers where each of its lines was written.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/Error.h"
#include "core/Files.h"
#include "effect/EffectAsset.h"

namespace crevice {

/// One stage's text without #include and comments, with the author's place of every line.
struct FlatSource {
    struct Origin {
        std::uint32_t file = 0;  ///< Index into `files`.
        int line = 1;
    };
    std::string text;  ///< Every line ends with a newline.
    std::vector<std::string> files;
    std::vector<Origin> lines;      ///< Per line of `text`.
    std::map<int, Origin> calls{};  ///< Lines (counted from 1) that a macro wrote: where it was called.

    /// The author's place of a line of `text`, counted from 1; beyond the ends the nearest line.
    SourceLoc locate(int line, int column = 0, int length = 1) const;
};

/// Generated chunks by name.
using Chunks = std::map<std::string, std::string, std::less<>>;

/// Limits that keep hostile effects from using unbounded time and memory.
struct IncludeLimits {
    std::size_t maxIncludes = 1000;
    std::size_t maxBytes = 16u << 20;
    std::size_t maxDepth = 64;
};

/// Where the text of an effect's stages may come from.
struct IncludeSources {
    const EffectAsset& effect;
    const AssetRoots& roots;
    const Chunks& generated;
    IncludeLimits limits{};
};

/// Flattens "program" (a CCProgram of the effect, else a chunk), without an entry. `where` is the pass that names it.
///
/// `#include <name>` (or "name") is looked up as: a CCProgram of the effect; relative to the including file if it
/// begins with
/// "."; a generated chunk; effects/chunks/NAME.chunk of the asset roots. A text enters a stage once. If its first
/// include stands inside a condition, later ones are kept and guarded, so that an untaken branch never hides a chunk.
FlatSource flattenProgram(const IncludeSources& sources, const std::string& program, const SourceLoc& where,
                          Problems& problems);

}  // namespace crevice
