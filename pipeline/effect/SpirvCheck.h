// SPIR-V is checked against the rules of Vulkan 1.2 before it is kept or used.
#pragma once

#include "effect/ShaderCompiler.h"

namespace crevice {

/// Reports what SPIRV-Tools finds wrong, at the program's first line: the compiler's places end with GLSL.
void checkSpirv(const StageCode& code, const StageSource& source, Problems& problems);

}  // namespace crevice
