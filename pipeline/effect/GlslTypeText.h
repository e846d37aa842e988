// glslang's words for types as GLSL writes them.
#pragma once

#include <string>

namespace crevice {

/// "cannot convert from ' temp highp 3-component vector of float' to 'const int'" → "cannot convert from 'vec3' to
/// 'int'": what stands in single quotes, without qualifiers; what is no type stays as it is. Structs and blocks, which
/// glslang writes out with all their members, become "a struct", "an array of structs", "a block", without quotes.
std::string plainGlslTypes(const std::string& message);

/// What to do about a conversion that does not exist, by the two types of a message of plainGlslTypes.
std::string conversionAdvice(const std::string& message);

}  // namespace crevice
