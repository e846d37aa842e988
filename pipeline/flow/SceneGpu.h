// A scene on the GPU: meshes and textures, uploaded once.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "flow/VertexLayout.h"
#include "gfx/Commands.h"
#include "scene/DrawList.h"
#include "scene/Scene.h"

namespace crevice {

/// Is told how much of a scene is on the device, 0 … 1, at steps of a hundredth or more.
using UploadProgress = std::function<void(float share)>;

class SceneGpu {
public:
    struct MeshRange {
        std::uint32_t firstIndex = 0, indexCount = 0;
        std::int32_t vertexOffset = 0;
        bool sixteenBit = false;  ///< Which of the two index buffers.
    };

    /// The scene must stay as it is while this lives.
    SceneGpu(Device& device, SamplerCache& samplers, const Scene& scene, const UploadProgress& progress = {})
        : SceneGpu(device, samplers, scene, nullptr, progress) {}
    /// The same, but vertices, indices and pixels in `scene` are let go of one by one as the device has them: peak
    /// memory is then little above one copy. Everything else in it stays.
    static std::unique_ptr<SceneGpu> makeReleasing(Device& device, SamplerCache& samplers, Scene& scene,
                                                   const UploadProgress& progress = {}) {
        return std::unique_ptr<SceneGpu>(new SceneGpu(device, samplers, scene, &scene, progress));
    }

    const Scene& scene() const { return scene_; }
    const Aabb& bounds() const { return instances_.bounds(); }
    const InstanceTable& instances() const { return instances_; }
    /// Of the vertices: decided by what the scene's meshes have.
    const VertexLayout& layout() const { return layout_; }
    const MeshRange& mesh(int index) const { return meshes_[std::size_t(index)]; }
    const GpuTexture& texture(int index) const { return textures_[std::size_t(index)]; }
    VkSampler sampler(int texture) const { return textureSamplers_[std::size_t(texture)]; }
    void bindVertices(Commands& commands) const { commands.bindVertexBuffer(0, vertices_); }
    void bindIndices(Commands& commands, bool sixteenBit) const;

private:
    /// `releasing`: the scene, when its copies are not wanted afterwards; else null.
    SceneGpu(Device& device, SamplerCache& samplers, const Scene& scene, Scene* releasing,
             const UploadProgress& progress);
    class Meter;
    void uploadMeshes(Device& device, Scene* releasing, Meter& meter);
    void uploadTextures(Device& device, SamplerCache& samplers, Scene* releasing, Meter& meter);

    const Scene& scene_;
    InstanceTable instances_;
    VertexLayout layout_;
    std::vector<MeshRange> meshes_;
    Buffer vertices_, indices_, shortIndices_;  ///< Meshes of up to 65536 vertices have indices of 16 bits.
    std::vector<GpuTexture> textures_;
    std::vector<VkSampler> textureSamplers_;
};

}  // namespace crevice
