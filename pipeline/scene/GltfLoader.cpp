// The table of contents of loading a glTF.
#include "scene/GltfLoader.h"

#include "scene/GltfRelease.h"

namespace crevice {

namespace {

// A white normal map would turn every surface: without a picture the surface is as smooth as its mesh.
void dropBrokenNormalMaps(const std::set<int>& broken, Scene& scene) {
    for (SceneMaterial& material : scene.materials)
        if (broken.contains(material.normalMap.texture)) material.normalMap = {};
}

}  // namespace

Scene loadGltf(const std::filesystem::path& path, const LoadOptions& options) {
    gltf::File file = gltf::open(path, options);
    Scene scene;
    scene.name = path.stem().string();

    gltf::Images images(file);
    const gltf::Materials materials = gltf::readMaterials(file, images);
    scene.materials = materials.scene;
    gltf::Release release(file);
    gltf::Meshes meshes(file, materials, release, scene.meshes);
    gltf::readNodes(file, meshes, scene);
    scene.textures = images.decode();
    dropBrokenNormalMaps(images.broken(), scene);
    gltf::convertSpecularGlossiness(file, materials.toConvert, images.bytesLeft(), scene);
    gltf::drawOpaqueWhatIs(scene);
    return scene;
}

}  // namespace crevice
