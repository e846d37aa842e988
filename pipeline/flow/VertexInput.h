// Vertex attributes of a shader by name → where they lie in Crevice's vertex streams.
#pragma once

#include <vector>

#include "effect/EffectLibrary.h"
#include "flow/VertexLayout.h"
#include "gfx/Pipeline.h"
#include "plan/PipelineDesc.h"

namespace crevice {

/// Bindings: mesh vertices (or the corners of the full-screen quad), instance rows, and what is the same for all
/// vertices.
inline constexpr std::uint32_t kMeshStream = 0, kInstanceStream = 1, kSameStream = 2;
/// Of the last one: zeroes for what meshes do not have, then Vertex{} for what none of a scene's meshes has.
inline constexpr std::uint32_t kZeroBytes = 64, kSameBytes = kZeroBytes + sizeof(Vertex);

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
/// effects ask for the attributes of every mesh). `layout`: of the meshes, see SceneGpu.
VertexInput vertexInput(const EffectVariant& variant, VertexSource source = VertexSource::Mesh,
                        MissingAttributes missing = MissingAttributes::Refused, const VertexLayout& layout = {});

}  // namespace crevice
