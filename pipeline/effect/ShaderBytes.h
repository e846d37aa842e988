// Compiled stages with what was reflected of them, as bytes for the disk cache.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "effect/ShaderCompiler.h"

namespace crevice {

/// A compiled pass: everything of a variant that costs time.
struct CompiledPass {
    std::vector<StageCode> code;
    ShaderInfo info;
    bool checked = false;            ///< By SPIRV-Tools, without complaint.
    std::vector<Problem> remarks{};  ///< Said when the stages were joined; to be said again whenever this is used.
};

std::string toBytes(const CompiledPass& pass);
/// Nothing for bytes that toBytes() did not write.
std::optional<CompiledPass> compiledPassFrom(std::string_view bytes);

std::string toBytes(const std::vector<Problem>& problems);
std::optional<std::vector<Problem>> problemsFrom(std::string_view bytes);

}  // namespace crevice
