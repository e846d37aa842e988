// Tangents for meshes that bring none: Cocos' effects read them from the vertices.
#pragma once

#include "scene/Scene.h"

namespace crevice::cocos {

/// Per vertex the direction in which u grows, at right angles to the normal, as the sum over its triangles (Lengyel,
/// Computing Tangent Space Basis Vectors for an Arbitrary Mesh); w = -1 where the texture is mirrored. A vertex without
/// such a direction gets any tangent.
void addTangents(Mesh& mesh);

/// The same if the mesh has no tangents and the material a normal map, or if tangents are `required` whatever draws it;
/// not where sets 2 and 3 of texture coordinates lie in their place (TextureRef).
void addTangentsFor(const SceneMaterial& material, Mesh& mesh, bool required = false);

}  // namespace crevice::cocos
