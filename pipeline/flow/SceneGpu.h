// A scene on the GPU: meshes and textures uploaded once, and the instance rows that draws read.
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
    const Aabb& bounds() const { return bounds_; }
    std::span<const Aabb> instanceBounds() const { return instanceBounds_; }
    const MeshRange& mesh(int index) const { return meshes_[std::size_t(index)]; }
    const GpuTexture& texture(int index) const { return textures_[std::size_t(index)]; }
    VkSampler sampler(int texture) const { return textureSamplers_[std::size_t(texture)]; }
    void bindMeshes(Commands& commands) const;

private:
    void uploadMeshes(Device& device);
    void uploadTextures(Device& device, SamplerCache& samplers);

    const Scene& scene_;
    Aabb bounds_;
    std::vector<Aabb> instanceBounds_;
    std::vector<MeshRange> meshes_;
    Buffer vertices_, indices_;
    std::vector<GpuTexture> textures_;
    std::vector<VkSampler> textureSamplers_;
};

/// World matrices of drawn instances as rows, in a host buffer that starts over with every frame and grows by whole
/// pieces.
class InstanceStream {
public:
    explicit InstanceStream(Device& device) : device_(device) {}
    void beginFrame() { piece_ = 0, used_ = 0; }

    struct Slice {
        const Buffer* buffer = nullptr;
        std::uint64_t offset = 0;
    };
    /// Writes the rows of the given instances in order; valid until the frame has finished.
    Slice append(const Scene& scene, std::span<const std::uint32_t> instances);

private:
    Device& device_;
    std::vector<Buffer> pieces_;
    std::size_t piece_ = 0;
    std::uint64_t used_ = 0;
};

}  // namespace crevice
