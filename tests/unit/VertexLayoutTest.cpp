// What no vertex needs takes no room, and everything else lies where placeOf() says.
#include <gtest/gtest.h>

#include <cstring>

#include "flow/VertexLayout.h"

namespace crevice {
namespace {

Scene sceneOf(std::vector<Vertex> vertices) {
    Scene scene;
    scene.meshes.resize(2);  // the first one empty
    scene.meshes[1].vertices = std::move(vertices);
    return scene;
}

template <typename Part>
Part partAt(const VertexLayout& layout, const std::vector<std::byte>& bytes, std::size_t vertex, std::size_t offset) {
    Part part;
    std::memcpy(&part, &bytes.at(vertex * layout.stride() + layout.placeOf(std::uint32_t(offset)).value()),
                sizeof part);
    return part;
}

std::vector<std::byte> packed(const VertexLayout& layout, const Scene& scene) {
    std::vector<std::byte> bytes(scene.meshes[1].vertices.size() * layout.stride());
    layout.pack(scene.meshes[1].vertices, bytes);
    return bytes;
}

TEST(VertexLayout, PositionsAndNormalsAloneAreSixFloats) {
    const Scene scene = sceneOf({Vertex{.position = {1, 2, 3}}, Vertex{.position = {4, 5, 6}, .normal = {0, 1, 0}}});
    const VertexLayout layout(scene);
    EXPECT_EQ(layout.stride(), 24u);
    for (const std::size_t offset :
         {offsetof(Vertex, tangent), offsetof(Vertex, uv0), offsetof(Vertex, uv1), offsetof(Vertex, color)})
        EXPECT_FALSE(layout.placeOf(std::uint32_t(offset)).has_value()) << offset;
    const auto bytes = packed(layout, scene);
    EXPECT_EQ(partAt<glm::vec3>(layout, bytes, 1, offsetof(Vertex, position)), glm::vec3(4, 5, 6));
    EXPECT_EQ(partAt<glm::vec3>(layout, bytes, 1, offsetof(Vertex, normal)), glm::vec3(0, 1, 0));
}

TEST(VertexLayout, OnePartOfOneVertexIsEnough) {
    Vertex last;
    last.uv1 = {0, 0.25f};
    last.color = {1, 1, 1, 0.5f};
    const Scene scene = sceneOf({Vertex{}, Vertex{}, last});
    const VertexLayout layout(scene);
    EXPECT_EQ(layout.stride(), 24u + 8u + 16u);
    EXPECT_FALSE(layout.placeOf(offsetof(Vertex, tangent)).has_value());
    EXPECT_FALSE(layout.placeOf(offsetof(Vertex, uv0)).has_value());
    const auto bytes = packed(layout, scene);
    EXPECT_EQ(partAt<glm::vec2>(layout, bytes, 2, offsetof(Vertex, uv1)), last.uv1);
    EXPECT_EQ(partAt<glm::vec4>(layout, bytes, 2, offsetof(Vertex, color)), last.color);
    EXPECT_EQ(partAt<glm::vec4>(layout, bytes, 1, offsetof(Vertex, color)), glm::vec4(1));
}

TEST(VertexLayout, WithAllPartsItIsTheVertexItself) {
    const Vertex all{{1, 2, 3}, {1, 0, 0}, {0, 1, 0, -1}, {0.5f, 0.25f}, {0.125f, 1}, {0, 0.5f, 1, 1}};
    const Scene scene = sceneOf({Vertex{}, all});
    const VertexLayout layout(scene);
    EXPECT_EQ(layout.stride(), VertexLayout().stride());
    EXPECT_EQ(layout.stride(), 72u);
    const auto bytes = packed(layout, scene);
    EXPECT_EQ(partAt<glm::vec4>(layout, bytes, 1, offsetof(Vertex, tangent)), all.tangent);
    EXPECT_EQ(partAt<glm::vec2>(layout, bytes, 1, offsetof(Vertex, uv0)), all.uv0);
    EXPECT_EQ(partAt<glm::vec4>(layout, bytes, 1, offsetof(Vertex, color)), all.color);
}

}  // namespace
}  // namespace crevice
