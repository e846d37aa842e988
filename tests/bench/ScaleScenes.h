// Scenes made for the curves of `crevice_bench --scale`: as many objects, lights or triangles as asked for. Generated,
// never kept.
#pragma once

#include <cstdint>
#include <filesystem>

#include "scene/Scene.h"

namespace crevice::bench {

/// `count` instances of ten small meshes (boxes and others, 12 to 60 triangles) with one material, in a grid of width 1
/// per object around the origin; one directional light.
Scene manyObjects(std::uint32_t count);

/// Adds point lights at random places within the scene's bounds. Range: 1/40 of the diagonal. All together shine about
/// as bright whatever their number.
void addSmallLights(Scene& scene, std::uint32_t count);

/// Writes a .glb of `meshes` wavy squares, each of side × side quads (two triangles each) with positions, normals,
/// texture coordinates and 32-bit indices. Returns the bytes of its binary chunk.
std::uint64_t writeManyTriangles(const std::filesystem::path& path, std::uint32_t meshes, std::uint32_t side);

/// Writes a folder with a .gltf of `count` squares, each with a PNG of side × side pixels of its own. Returns the
/// .gltf.
std::filesystem::path writeManyPictures(const std::filesystem::path& folder, std::uint32_t count, std::uint32_t side);

}  // namespace crevice::bench
