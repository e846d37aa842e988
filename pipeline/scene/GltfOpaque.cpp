// Blended materials that nothing shows through, drawn opaque: exporters say BLEND of whole models. Drawn as they say, a
// model would show its far side through its near one wherever its triangles stand in that order.
#include <algorithm>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

bool isOpaque(const Image& image) {
    for (std::size_t alpha = 3; alpha < image.pixels.size(); alpha += 4)
        if (image.pixels[alpha] != std::byte(255)) return false;
    return true;
}

bool isOpaque(const Mesh& mesh) {
    return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const Vertex& v) { return v.color.a >= 1; });
}

bool isOpaque(const SceneMaterial& material, const Scene& scene) {
    return material.baseColor.a >= 1 &&
           (!material.baseColorMap || isOpaque(scene.textures[std::size_t(material.baseColorMap.texture)].image));
}

}  // namespace

void drawOpaqueWhatIs(Scene& scene) {
    std::vector<char> candidate;
    for (const SceneMaterial& material : scene.materials)
        candidate.push_back(material.alphaMode == AlphaMode::Blend && isOpaque(material, scene));
    if (std::find(candidate.begin(), candidate.end(), 1) == candidate.end()) return;
    std::set<std::pair<int, int>> seen;  // material, mesh
    for (const Instance& instance : scene.instances) {
        char& opaque = candidate[std::size_t(instance.material)];
        if (opaque && seen.insert({instance.material, instance.mesh}).second)
            opaque = isOpaque(scene.meshes[std::size_t(instance.mesh)]);
    }
    for (std::size_t i = 0; i < candidate.size(); ++i)
        if (candidate[i]) scene.materials[i].alphaMode = AlphaMode::Opaque;
}

}  // namespace crevice::gltf
