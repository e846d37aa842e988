// Four corners, six indices.
#include "flow/QuadMesh.h"

#include <cstdint>
#include <cstring>
#include <span>

#include "flow/VertexInput.h"
#include "gfx/Device.h"

namespace crevice {
namespace {

struct Corner {
    float x, y, u, v;
};
// Cocos' shaders turn y over where the clip space points down (cc_cameraPos.w = 0): the corner at y = -1 ends at the
// bottom of the picture, where v = 1.
constexpr Corner kCorners[] = {{-1, -1, 0, 1}, {1, -1, 1, 1}, {-1, 1, 0, 0}, {1, 1, 1, 0}};
constexpr std::uint32_t kIndices[] = {0, 1, 2, 1, 3, 2};

}  // namespace

QuadMesh::QuadMesh(Device& device)
    : vertices_(device, {.size = sizeof kCorners, .usage = BufferUsage::Vertex, .name = "quad vertices"}),
      indices_(device, {.size = sizeof kIndices, .usage = BufferUsage::Index, .name = "quad indices"}),
      same_(device, {.size = kSameBytes, .usage = BufferUsage::Vertex, .name = "attributes of all vertices"}) {
    vertices_.write(std::as_bytes(std::span(kCorners)), 0);
    indices_.write(std::as_bytes(std::span(kIndices)), 0);
    const Vertex usual;
    std::memset(same_.data().data(), 0, kZeroBytes);
    same_.write(std::as_bytes(std::span(&usual, 1)), kZeroBytes);
}

void QuadMesh::bind(Commands& commands) const {
    commands.bindVertexBuffer(kMeshStream, vertices_);
    commands.bindIndexBuffer(indices_);
}

void QuadMesh::bindSame(Commands& commands) const { commands.bindVertexBuffer(kSameStream, same_); }

void QuadMesh::draw(Commands& commands) const { commands.drawIndexed(std::size(kIndices)); }

}  // namespace crevice
