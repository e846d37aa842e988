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
constexpr std::uint64_t kZeroBytes = 64;

}  // namespace

QuadMesh::QuadMesh(Device& device)
    : vertices_(device, {.size = sizeof kCorners, .usage = BufferUsage::Vertex, .name = "quad vertices"}),
      indices_(device, {.size = sizeof kIndices, .usage = BufferUsage::Index, .name = "quad indices"}),
      zeroes_(device, {.size = kZeroBytes, .usage = BufferUsage::Vertex, .name = "zero attributes"}) {
    vertices_.write(std::as_bytes(std::span(kCorners)), 0);
    indices_.write(std::as_bytes(std::span(kIndices)), 0);
    std::memset(zeroes_.data().data(), 0, kZeroBytes);
}

void QuadMesh::bind(Commands& commands) const {
    commands.bindVertexBuffer(kMeshStream, vertices_);
    commands.bindIndexBuffer(indices_);
}

void QuadMesh::bindZeroes(Commands& commands) const { commands.bindVertexBuffer(kZeroStream, zeroes_); }

void QuadMesh::draw(Commands& commands) const { commands.drawIndexed(std::size(kIndices)); }

}  // namespace crevice
