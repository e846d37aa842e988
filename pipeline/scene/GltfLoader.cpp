// The table of contents of loading a glTF.
#include "scene/GltfLoader.h"

#include "scene/GltfParts.h"

namespace crevice {

Scene loadGltf(const std::filesystem::path& path, const LoadOptions& options) {
    const gltf::File file = gltf::open(path, options);
    Scene scene;
    scene.name = path.stem().string();

    gltf::Images images(file);
    scene.materials = gltf::readMaterials(file, images);
    gltf::Meshes meshes(file, scene.meshes);
    gltf::readNodes(file, meshes, scene);
    scene.textures = images.decode();
    return scene;
}

}  // namespace crevice
