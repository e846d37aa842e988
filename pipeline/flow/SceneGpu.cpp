// One vertex and one index buffer for all meshes; one texture per picture and colour space.
#include "flow/SceneGpu.h"

#include "gfx/Device.h"
#include "gfx/Readback.h"

namespace crevice {
namespace {

SamplerWrap addressMode(TextureWrap wrap) {
    switch (wrap) {
        case TextureWrap::Repeat:
            return SamplerWrap::Repeat;
        case TextureWrap::Mirror:
            return SamplerWrap::Mirror;
        case TextureWrap::Clamp:
            return SamplerWrap::Clamp;
    }
    return SamplerWrap::Repeat;
}

SamplerKey keyOf(const SamplerDesc& desc) {
    SamplerKey key;
    key.minFilter = desc.linearMin ? Filter::Linear : Filter::Nearest;
    key.magFilter = desc.linearMag ? Filter::Linear : Filter::Nearest;
    key.mipFilter = !desc.mipmaps ? MipFilter::None : desc.linearMip ? MipFilter::Linear : MipFilter::Nearest;
    key.wrapU = addressMode(desc.wrapU);
    key.wrapV = addressMode(desc.wrapV);
    return key;
}

}  // namespace

SceneGpu::SceneGpu(Device& device, SamplerCache& samplers, const Scene& scene) : scene_(scene), instances_(scene) {
    uploadMeshes(device);
    uploadTextures(device, samplers);
}

void SceneGpu::uploadMeshes(Device& device) {
    std::uint64_t vertexCount = 0, indexCount = 0;
    for (const Mesh& mesh : scene_.meshes) {
        meshes_.push_back({static_cast<std::uint32_t>(indexCount), static_cast<std::uint32_t>(mesh.indices.size()),
                           static_cast<std::int32_t>(vertexCount)});
        vertexCount += mesh.vertices.size();
        indexCount += mesh.indices.size();
    }
    if (indexCount == 0) return;
    vertices_ =
        Buffer(device, {.size = vertexCount * sizeof(Vertex), .usage = BufferUsage::Vertex, .name = "scene vertices"});
    indices_ = Buffer(
        device, {.size = indexCount * sizeof(std::uint32_t), .usage = BufferUsage::Index, .name = "scene indices"});
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        const Mesh& mesh = scene_.meshes[i];
        vertices_.write(std::as_bytes(std::span(mesh.vertices)),
                        std::uint64_t(meshes_[i].vertexOffset) * sizeof(Vertex));
        indices_.write(std::as_bytes(std::span(mesh.indices)), meshes_[i].firstIndex * sizeof(std::uint32_t));
    }
}

void SceneGpu::uploadTextures(Device& device, SamplerCache& samplers) {
    for (const crevice::SceneTexture& texture : scene_.textures) {
        Image image = texture.image;
        if (texture.srgb && image.format == Format::RGBA8) image.format = Format::RGBA8_SRGB;
        textures_.push_back(makeTexture(device, image, texture.sampler.mipmaps, texture.name));
        textureSamplers_.push_back(samplers.get(keyOf(texture.sampler)));
    }
}

void SceneGpu::bindMeshes(Commands& commands) const {
    commands.bindVertexBuffer(0, vertices_);
    commands.bindIndexBuffer(indices_);
}

}  // namespace crevice
