// Turns glslang's log into problems at the author's file and line.
#pragma once

#include <string_view>
#include <vector>

#include "effect/ShaderCompiler.h"

namespace crevice {

/// The log of one parsed stage.
void reportGlslMessages(std::string_view log, const StageSource& source, Problems& problems);

/// The log of linking all stages; its messages name variables but no lines.
void reportLinkMessages(std::string_view log, const std::vector<StageSource>& sources, Problems& problems);

}  // namespace crevice
