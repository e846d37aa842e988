// One vertex and one index buffer for all meshes; one texture per picture and colour space.
#include "flow/SceneGpu.h"

#include <algorithm>

#include "core/Memory.h"
#include "gfx/Device.h"
#include "gfx/Readback.h"

namespace crevice {
namespace {

constexpr std::size_t kShortVertices = 1 << 16;
/// Of so many the scene's copy is given back together: a big mesh is not in memory twice.
constexpr std::size_t kVerticesAtOnce = 1 << 16;

void narrow(std::span<const std::uint32_t> indices, std::span<std::byte> out) {
    auto* to = reinterpret_cast<std::uint16_t*>(out.data());
    for (std::size_t i = 0; i < indices.size(); ++i) to[i] = static_cast<std::uint16_t>(indices[i]);
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

/// Counts bytes of vertices and pixels, which are nearly all there is to upload.
class SceneGpu::Meter {
public:
    Meter(const Scene& scene, std::uint64_t vertexStride, const UploadProgress& progress) : progress_(progress) {
        if (!progress_) return;
        for (const Mesh& mesh : scene.meshes) total_ += mesh.vertices.size() * vertexStride;
        for (const SceneTexture& texture : scene.textures) total_ += texture.image.pixels.size();
    }

    void add(std::uint64_t bytes) {
        if (!progress_ || total_ == 0) return;
        done_ += bytes;
        const float share = float(double(done_) / double(total_));
        if (share - told_ < kStep && done_ < total_) return;
        told_ = share;
        progress_(share);
    }

private:
    static constexpr float kStep = 0.01f;

    const UploadProgress& progress_;
    std::uint64_t total_ = 0, done_ = 0;
    float told_ = 0;
};

SceneGpu::SceneGpu(Device& device, SamplerCache& samplers, const Scene& scene, Scene* releasing,
                   const UploadProgress& progress)
    : scene_(scene), instances_(scene), layout_(scene) {
    Meter meter(scene, layout_.stride(), progress);
    uploadMeshes(device, releasing, meter);
    uploadTextures(device, samplers, releasing, meter);
}

void SceneGpu::uploadMeshes(Device& device, Scene* releasing, Meter& meter) {
    std::uint64_t vertexCount = 0, indexCount = 0, shortCount = 0;
    for (const Mesh& mesh : scene_.meshes) {
        const bool sixteenBit = mesh.vertices.size() <= kShortVertices;
        std::uint64_t& count = sixteenBit ? shortCount : indexCount;
        meshes_.push_back({static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(mesh.indices.size()),
                           static_cast<std::int32_t>(vertexCount), sixteenBit});
        vertexCount += mesh.vertices.size();
        count += mesh.indices.size();
    }
    if (indexCount + shortCount == 0) return;
    const std::uint64_t stride = layout_.stride();
    vertices_ = Buffer(device, {.size = vertexCount * stride, .usage = BufferUsage::Vertex, .name = "scene vertices"});
    if (indexCount > 0)
        indices_ = Buffer(
            device, {.size = indexCount * sizeof(std::uint32_t), .usage = BufferUsage::Index, .name = "scene indices"});
    if (shortCount > 0)
        shortIndices_ = Buffer(device, {.size = shortCount * sizeof(std::uint16_t),
                                        .usage = BufferUsage::Index,
                                        .name = "scene indices of 16 bits"});
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        const Mesh& mesh = scene_.meshes[i];
        const MeshRange& range = meshes_[i];
        const std::span<std::byte> out = vertices_.data().subspan(std::uint64_t(range.vertexOffset) * stride);
        for (std::size_t first = 0; first < mesh.vertices.size(); first += kVerticesAtOnce) {
            const std::size_t count = std::min(kVerticesAtOnce, mesh.vertices.size() - first);
            layout_.pack(std::span(mesh.vertices).subspan(first, count), out.subspan(first * stride, count * stride));
            meter.add(count * stride);
            if (releasing)
                releasePages(std::as_writable_bytes(std::span(releasing->meshes[i].vertices).subspan(first, count)));
        }
        if (range.sixteenBit)
            narrow(mesh.indices, shortIndices_.data().subspan(range.firstIndex * sizeof(std::uint16_t)));
        else
            indices_.write(std::as_bytes(std::span(mesh.indices)), range.firstIndex * sizeof(std::uint32_t));
        if (!releasing) continue;
        releasing->meshes[i].vertices = std::vector<Vertex>();  // not {}, which would keep the memory
        releasing->meshes[i].indices = std::vector<std::uint32_t>();
    }
}

void SceneGpu::uploadTextures(Device& device, SamplerCache& samplers, Scene* releasing, Meter& meter) {
    for (std::size_t i = 0; i < scene_.textures.size(); ++i) {
        const crevice::SceneTexture& texture = scene_.textures[i];
        // A moved image keeps its size.
        Image image = releasing ? std::move(releasing->textures[i].image) : texture.image;
        if (texture.srgb && image.format == Format::RGBA8) image.format = Format::RGBA8_SRGB;
        textures_.push_back(makeTexture(device, image, texture.sampler.mipmaps, texture.name));
        meter.add(image.pixels.size());
        textureSamplers_.push_back(samplers.get(keyOf(texture.sampler)));
    }
}

void SceneGpu::bindIndices(Commands& commands, bool sixteenBit) const {
    commands.bindIndexBuffer(sixteenBit ? shortIndices_ : indices_, 0, sixteenBit);
}

}  // namespace crevice
