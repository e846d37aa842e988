// GLSL's type names with what Cocos' metadata says of them: numbers of its `Type` and `Format` enums, sizes.
#pragma once

#include <optional>
#include <string_view>

#include "cocos/interface/Interface.h"

namespace crevice::cocos {

struct GlslType {
    int type = 0;  ///< Cocos' gfx `Type`: FLOAT 13 … FLOAT4 16, MAT3 21, MAT4 25, SAMPLER2D 28; 0 = unknown.
    int attributeFormat = 0;  ///< Cocos' gfx `Format` as a vertex attribute: R32F 11 … RGBA32F 44; 0 = none.
    int components = 0;       ///< Of a scalar or vector; a column of a matrix. 0 = neither.
    int columns = 1;
    int componentBytes = 4;
    bool integer = false;                   ///< Integers and doubles: not interpolated.
    std::optional<InterfaceKind> resource;  ///< Samplers, textures, images, subpass inputs.
};

/// Null for a name that is no built-in type of GLSL 4.50 with Cocos' extensions.
const GlslType* findGlslType(std::string_view name);

/// Cocos' gfx `Format` of a name such as RGBA8, and whether a vertex attribute of it is normalised; 0 = unknown.
struct NamedFormat {
    int format = 0;
    bool normalized = false;
};
NamedFormat findFormat(std::string_view name);

}  // namespace crevice::cocos
