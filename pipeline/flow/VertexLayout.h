// How the vertices of one scene lie on the GPU: what none of its meshes has takes no room there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "scene/Scene.h"

namespace crevice {

/// Interleaved floats as in Vertex, in its order. What is left out is the same for all vertices: Vertex{}'s.
class VertexLayout {
public:
    /// All parts.
    VertexLayout() = default;
    /// The parts in which some vertex differs from Vertex{}. Positions and normals always.
    explicit VertexLayout(const Scene& scene);

    std::uint32_t stride() const;
    /// Where a part begins that begins at `offset` of Vertex; nothing when it is left out.
    std::optional<std::uint32_t> placeOf(std::uint32_t offset) const;
    /// `out`: vertices.size() * stride() bytes.
    void pack(std::span<const Vertex> vertices, std::span<std::byte> out) const;

private:
    bool tangent_ = true, uv0_ = true, uv1_ = true, color_ = true;
};

}  // namespace crevice
