// Vertex attributes of a shader by name → where they lie in Crevice's vertex streams.
#pragma once

#include <vector>

#include "effect/EffectLibrary.h"
#include "gfx/Pipeline.h"
#include "plan/PipelineDesc.h"

namespace crevice {

/// Bindings: mesh vertices (or the corners of the full-screen quad), instance rows, and zeroes.
inline constexpr std::uint32_t kMeshStream = 0, kInstanceStream = 1, kZeroStream = 2;

struct VertexInput {
    std::vector<VertexBinding> bindings;  ///< Only those used.
    std::vector<VertexAttribute> attributes;
    bool uses(std::uint32_t stream) const;
};

enum class VertexSource { Mesh, Quad };
enum class MissingAttributes { Refused, Zero };

/// Cocos' shaders ask for the attributes of every mesh.
inline MissingAttributes missingAttributes(Profile profile) {
    return isCocos(profile) ? MissingAttributes::Zero : MissingAttributes::Refused;
}

/// Attributes that the shader does not use are left out. `missing`: what happens to those that are used and that the
/// source does not have: Throws Error naming those there are, or feeds zeroes (Cocos' effects ask for the attributes of
/// every mesh).
VertexInput vertexInput(const EffectVariant& variant, VertexSource source = VertexSource::Mesh,
                        MissingAttributes missing = MissingAttributes::Refused);

}  // namespace crevice
