// A scene on the GPU: meshes and textures, uploaded once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gfx/Commands.h"
#include "scene/DrawList.h"
#include "scene/Scene.h"

namespace crevice {

class SceneGpu {
public:
    struct MeshRange {
        std::uint32_t firstIndex = 0, indexCount = 0;
        std::int32_t vertexOffset = 0;
    };

    /// The scene must stay as it is while this lives.
    SceneGpu(Device& device, SamplerCache& samplers, const Scene& scene);

    const Scene& scene() const { return scene_; }
    const Aabb& bounds() const { return instances_.bounds(); }
    const InstanceTable& instances() const { return instances_; }
    const MeshRange& mesh(int index) const { return meshes_[std::size_t(index)]; }
    const GpuTexture& texture(int index) const { return textures_[std::size_t(index)]; }
    VkSampler sampler(int texture) const { return textureSamplers_[std::size_t(texture)]; }
    void bindMeshes(Commands& commands) const;

private:
    void uploadMeshes(Device& device);
    void uploadTextures(Device& device, SamplerCache& samplers);

    const Scene& scene_;
    InstanceTable instances_;
    std::vector<MeshRange> meshes_;
    Buffer vertices_, indices_;
    std::vector<GpuTexture> textures_;
    std::vector<VkSampler> textureSamplers_;
};

}  // namespace crevice
