// The alpha test of masked materials at a point of a triangle, as the standard effect makes it.
#pragma once

#include "scene/Scene.h"

namespace crevice {

/// Texture coordinates as the standard effect reads them: see TextureRef::texcoord.
inline glm::vec2 texcoordOf(const Vertex& vertex, int set) {
    return set == 0   ? vertex.uv0
           : set == 1 ? vertex.uv1
           : set == 2 ? glm::vec2(vertex.tangent)
                      : glm::vec2(vertex.tangent.z, vertex.tangent.w);
}

/// Bilinear, on the largest mip level, with the sampler's wrapping.
float sampleAlpha(const SceneTexture& texture, const glm::vec2& uv);

/// Is the triangle `primitive` of the mesh solid at the barycentric place (u, v)? Alpha below the cutoff is a hole.
bool passesAlphaTest(const Scene& scene, const Mesh& mesh, const SceneMaterial& material, std::uint32_t primitive,
                     const glm::vec2& barycentric);

}  // namespace crevice
