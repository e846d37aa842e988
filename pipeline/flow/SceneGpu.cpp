// One vertex and one index buffer for all meshes; one texture per picture and colour space.
#include "flow/SceneGpu.h"

#include <algorithm>
#include <cstring>

#include "gfx/Device.h"
#include "gfx/Readback.h"

namespace crevice {
namespace {

constexpr std::uint64_t kPieceBytes = 1u << 20;

/// Three rows of the world matrix: a point's world coordinate is the dot product of a row and (x, y, z, 1).
struct InstanceRows {
    glm::vec4 row0, row1, row2;
};

InstanceRows rowsOf(const glm::mat4& world) {
    const glm::mat4 rows = glm::transpose(world);
    return {rows[0], rows[1], rows[2]};
}

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

SceneGpu::SceneGpu(Device& device, SamplerCache& samplers, const Scene& scene)
    : scene_(scene), bounds_(scene.bounds()), instanceBounds_(computeInstanceBounds(scene)) {
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

InstanceStream::Slice InstanceStream::append(const Scene& scene, std::span<const std::uint32_t> instances) {
    const std::uint64_t bytes = instances.size() * sizeof(InstanceRows);
    while (piece_ < pieces_.size() && used_ + bytes > pieces_[piece_].size()) {
        ++piece_;
        used_ = 0;
    }
    if (piece_ == pieces_.size()) {
        pieces_.emplace_back(
            device_,
            BufferDesc{.size = std::max(bytes, kPieceBytes), .usage = BufferUsage::Vertex, .name = "instances"});
        used_ = 0;
    }
    Buffer& buffer = pieces_[piece_];
    std::byte* out = buffer.data().data() + used_;
    for (const std::uint32_t index : instances) {
        const InstanceRows rows = rowsOf(scene.instances[index].world);
        std::memcpy(out, &rows, sizeof rows);
        out += sizeof rows;
    }
    const Slice slice{&buffer, used_};
    used_ += bytes;
    return slice;
}

}  // namespace crevice
