// SPIR-V checked against the rules of Vulkan 1.2. It takes half as long as compiling: `effects compile` does it, frames
// do not.
#pragma once

#include "effect/ShaderCompiler.h"

namespace crevice {

/// Reports what SPIRV-Tools finds wrong, at the program's first line: the compiler's places end with GLSL.
void checkSpirv(const StageCode& code, const StageSource& source, Problems& problems);

}  // namespace crevice
