// glslang's words for types as GLSL writes them.
#pragma once

#include <string>

namespace crevice {

/// "cannot convert from ' temp highp 3-component vector of float' to 'const int'" → "cannot convert from 'vec3' to
/// 'int'": what stands in single quotes, without qualifiers; what is no type stays as it is.
std::string plainGlslTypes(const std::string& message);

}  // namespace crevice
