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

/// `missing`: what happens to attributes that the source does not have. Refused: throws Error naming those there are;
/// attributes that no code reads are left out. Zero: feeds zeroes, and feeds those that no code reads too (Cocos'
/// effects ask for the attributes of every mesh).
VertexInput vertexInput(const EffectVariant& variant, VertexSource source = VertexSource::Mesh,
                        MissingAttributes missing = MissingAttributes::Refused);

}  // namespace crevice
