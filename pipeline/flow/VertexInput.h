// Vertex attributes of a shader by name → where they lie in Crevice's two vertex streams.
#pragma once

#include <vector>

#include "effect/EffectLibrary.h"
#include "gfx/Pipeline.h"

namespace crevice {

struct VertexInput {
    std::vector<VertexBinding> bindings;  ///< 0: mesh vertices, 1: instance rows; only those used.
    std::vector<VertexAttribute> attributes;
};

/// Throws Error naming the attributes there are when the shader asks for another.
VertexInput vertexInput(const EffectVariant& variant);

}  // namespace crevice
