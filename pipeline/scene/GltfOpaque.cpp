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

/// Answers for textures and meshes, each of which is looked through once, whatever number of materials share it.
class Opaque {
public:
    explicit Opaque(const Scene& scene) : scene_(scene) {}

    bool isOpaqueMaterial(const SceneMaterial& material) {
        return material.baseColor.a >= 1 && (!material.baseColorMap || isOpaqueTexture(material.baseColorMap.texture));
    }
    bool isOpaqueMesh(int mesh) {
        const auto [entry, isNew] = meshes_.emplace(mesh, false);
        if (isNew)
            entry->second = look(scene_.meshes[std::size_t(mesh)], scene_.meshes[std::size_t(mesh)].vertices.size());
        return entry->second;
    }
    std::size_t looked() const { return looked_; }

private:
    bool isOpaqueTexture(int texture) {
        const auto [entry, isNew] = textures_.emplace(texture, false);
        const Image& image = scene_.textures[std::size_t(texture)].image;
        if (isNew) entry->second = look(image, std::size_t(image.width) * image.height);
        return entry->second;
    }
    template <class Part>
    bool look(const Part& part, std::size_t elements) {
        looked_ += elements;
        return isOpaque(part);
    }

    const Scene& scene_;
    std::map<int, bool> textures_, meshes_;
    std::size_t looked_ = 0;
};

}  // namespace

std::size_t drawOpaqueWhatIs(Scene& scene) {
    Opaque opaque(scene);
    std::map<int, bool> candidates;  // blended materials in use
    for (const Instance& instance : scene.instances) {
        const SceneMaterial& material = scene.materials[std::size_t(instance.material)];
        if (material.alphaMode != AlphaMode::Blend) continue;
        const auto [candidate, isNew] = candidates.emplace(instance.material, false);
        if (isNew) candidate->second = opaque.isOpaqueMaterial(material);
        if (candidate->second) candidate->second = opaque.isOpaqueMesh(instance.mesh);
    }
    for (const auto& [material, isWhole] : candidates)
        if (isWhole) scene.materials[std::size_t(material)].alphaMode = AlphaMode::Opaque;
    return opaque.looked();
}

}  // namespace crevice::gltf
