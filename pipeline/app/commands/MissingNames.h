// The identifiers that a pass' source lacks, and the macros that led to their use.
#pragma once

#include <string>
#include <vector>

#include "cocos/text/StageText.h"
#include "core/Error.h"

namespace crevice {

struct MissingName {
    std::string name;
    SourceLoc where;                       ///< Of its first use.
    std::vector<std::string> usedWith;     ///< Macros around that use: "USE_X", "!USE_Y"; simple names only.
    std::vector<std::string> otherwise{};  ///< Where it is declared all the same: "file:line with USE_Z".
};

/// Names that the compiler found no declaration of (variables, functions, types, members), each once, in order of their
/// first mention.
std::vector<MissingName> missingNames(const Error& error);

/// Looks the uses up in the pass' flattened stages, and declarations that other macros would bring in.
void explainMissing(std::vector<MissingName>& names, const std::vector<cocos::StageText>& stages);

/// "a_matWorld0 with USE_INSTANCING (but skin.chunk:12 with USE_SKINNING); v_uv1": the macros of the use, and where
/// others would declare it; only names when nothing is known of them.
std::string missingText(const std::vector<MissingName>& names);

}  // namespace crevice
