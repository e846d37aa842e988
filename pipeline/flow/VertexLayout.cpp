// A part stays as soon as one vertex needs it, so that most scans end at their first vertex.
#include "flow/VertexLayout.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace crevice {
namespace {

template <typename Part>
bool isAnywhere(const Scene& scene, Part Vertex::*part) {
    const Part usual = Vertex{}.*part;
    return std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) {
        return std::any_of(mesh.vertices.begin(), mesh.vertices.end(),
                           [&](const Vertex& vertex) { return vertex.*part != usual; });
    });
}

}  // namespace

VertexLayout::VertexLayout(const Scene& scene)
    : tangent_(isAnywhere(scene, &Vertex::tangent)),
      uv0_(isAnywhere(scene, &Vertex::uv0)),
      uv1_(isAnywhere(scene, &Vertex::uv1)),
      color_(isAnywhere(scene, &Vertex::color)) {}

std::uint32_t VertexLayout::stride() const {
    return static_cast<std::uint32_t>(offsetof(Vertex, tangent) + (tangent_ ? sizeof Vertex::tangent : 0) +
                                      (uv0_ ? sizeof Vertex::uv0 : 0) + (uv1_ ? sizeof Vertex::uv1 : 0) +
                                      (color_ ? sizeof Vertex::color : 0));
}

std::optional<std::uint32_t> VertexLayout::placeOf(std::uint32_t offset) const {
    std::uint32_t place = offset;
    const auto leaveOut = [&](bool isThere, std::size_t at, std::size_t bytes) {
        if (!isThere && offset > at) place -= static_cast<std::uint32_t>(bytes);
        return !isThere && offset == at;
    };
    if (leaveOut(tangent_, offsetof(Vertex, tangent), sizeof Vertex::tangent) ||
        leaveOut(uv0_, offsetof(Vertex, uv0), sizeof Vertex::uv0) ||
        leaveOut(uv1_, offsetof(Vertex, uv1), sizeof Vertex::uv1) ||
        leaveOut(color_, offsetof(Vertex, color), sizeof Vertex::color))
        return std::nullopt;
    return place;
}

void VertexLayout::pack(std::span<const Vertex> vertices, std::span<std::byte> out) const {
    assert(out.size() == vertices.size() * stride());
    if (stride() == sizeof(Vertex)) {
        std::memcpy(out.data(), vertices.data(), out.size());
        return;
    }
    std::byte* to = out.data();
    const auto put = [&](const void* part, std::size_t bytes) {
        std::memcpy(to, part, bytes);
        to += bytes;
    };
    for (const Vertex& vertex : vertices) {
        put(&vertex, offsetof(Vertex, tangent));
        if (tangent_) put(&vertex.tangent, sizeof vertex.tangent);
        if (uv0_) put(&vertex.uv0, sizeof vertex.uv0);
        if (uv1_) put(&vertex.uv1, sizeof vertex.uv1);
        if (color_) put(&vertex.color, sizeof vertex.color);
    }
}

}  // namespace crevice
