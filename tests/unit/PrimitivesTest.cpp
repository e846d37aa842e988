// Primitives are closed, wound outwards, and have unit normals and tangents that fit their texture coordinates.
#include "scene/Primitives.h"

#include <array>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace crevice {
namespace {

constexpr float kPi = 3.14159265f;

struct Case {
    const char* name;
    Mesh mesh;
    double volume;
    double tolerance;  // Facets cut the round ones off.
};

std::vector<Case> closedCases() {
    const std::vector<glm::vec2> bowl = {{0.2f, 0}, {0.5f, 0.4f}, {0.45f, 0.4f}, {0, 0.05f}};
    return {{"box", makeBox({2, 3, 4}), 24, 1e-5},
            {"wedge", makeWedge({2, 3, 4}), 12, 1e-5},
            {"sphere", makeSphere(1, 128), 4.0 / 3.0 * kPi, 0.01},
            {"cylinder", makeCylinder(1, 1, 2, 128), 2 * kPi, 0.01},
            {"cone", makeCylinder(1, 0, 3, 128), kPi, 0.01},
            {"torus", makeTorus(2, 0.5f, 128, 64), 2 * kPi * kPi * 2 * 0.25, 0.03},
            {"arch", makeArch(1, 0.5f, 2, 64), kPi * (2.25 - 1) / 2 * 2, 0.01},
            {"bowl", makeLathe(bowl, 96), 0.089, 0.02}};
}

double signedVolume(const Mesh& mesh) {
    double volume = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3 a = mesh.vertices[mesh.indices[i]].position, b = mesh.vertices[mesh.indices[i + 1]].position,
                         c = mesh.vertices[mesh.indices[i + 2]].position;
        volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return volume;
}

// Positions rounded to a millionth, so that the repeated vertices of seams count as one.
std::array<long, 3> quantised(const glm::vec3& p) {
    return {std::lround(p.x * 1e5f), std::lround(p.y * 1e5f), std::lround(p.z * 1e5f)};
}

// For every directed edge how often it occurs minus how often its reverse does: all zero for a closed surface.
int openEdges(const Mesh& mesh) {
    std::map<std::pair<std::array<long, 3>, std::array<long, 3>>, int> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = quantised(mesh.vertices[mesh.indices[i + k]].position);
            const auto b = quantised(mesh.vertices[mesh.indices[i + (k + 1) % 3]].position);
            if (a < b)
                ++edges[{a, b}];
            else
                --edges[{b, a}];
        }
    int open = 0;
    for (const auto& [edge, balance] : edges) open += balance != 0;
    return open;
}

TEST(Primitives, EnclosePositiveVolume) {
    for (const Case& c : closedCases()) EXPECT_NEAR(signedVolume(c.mesh), c.volume, c.tolerance * c.volume) << c.name;
}

TEST(Primitives, AreClosed) {
    for (const Case& c : closedCases()) {
        EXPECT_EQ(openEdges(c.mesh), 0) << c.name;
        EXPECT_EQ(c.mesh.indices.size() % 3, 0u) << c.name;
    }
    EXPECT_EQ(openEdges(makePlane({1, 1}, 2)), 8);  // only its rim is open
}

TEST(Primitives, NormalsFollowTheWinding) {
    for (const Case& c : closedCases())
        for (std::size_t i = 0; i < c.mesh.indices.size(); i += 3) {
            const Vertex* v[3];
            for (std::size_t k = 0; k < 3; ++k) v[k] = &c.mesh.vertices[c.mesh.indices[i + k]];
            const glm::vec3 face = glm::cross(v[1]->position - v[0]->position, v[2]->position - v[0]->position);
            ASSERT_GT(glm::length(face), 0) << c.name << ": degenerate triangle " << i / 3;
            for (const Vertex* vertex : v) {
                ASSERT_NEAR(glm::length(vertex->normal), 1, 1e-5) << c.name;
                ASSERT_GT(glm::dot(vertex->normal, glm::normalize(face)), 0.5f) << c.name << " triangle " << i / 3;
            }
        }
}

// glTF: the bitangent cross(normal, tangent) * w points to where v falls.
TEST(Primitives, TangentsFollowTextureCoordinates) {
    for (const Case& c : closedCases()) {
        ASSERT_TRUE(c.mesh.hasTangents) << c.name;
        for (std::size_t i = 0; i < c.mesh.indices.size(); i += 3) {
            const Vertex &a = c.mesh.vertices[c.mesh.indices[i]], &b = c.mesh.vertices[c.mesh.indices[i + 1]],
                         &d = c.mesh.vertices[c.mesh.indices[i + 2]];
            ASSERT_NEAR(glm::dot(glm::vec3(a.tangent), a.normal), 0, 1e-5) << c.name;
            const glm::vec3 bitangent = glm::cross(a.normal, glm::vec3(a.tangent)) * a.tangent.w;
            const glm::vec2 ab = b.uv0 - a.uv0, ad = d.uv0 - a.uv0;
            const float area = ab.x * ad.y - ab.y * ad.x;
            ASSERT_NE(area, 0) << c.name;
            const glm::vec3 alongU = (ad.y * (b.position - a.position) - ab.y * (d.position - a.position)) / area;
            const glm::vec3 alongV = (ab.x * (d.position - a.position) - ad.x * (b.position - a.position)) / area;
            ASSERT_GT(glm::dot(alongU, glm::vec3(a.tangent)), 0) << c.name;
            ASSERT_LT(glm::dot(alongV, bitangent), 0) << c.name;
        }
    }
}

TEST(Primitives, BoundsAndCountsAreExact) {
    const Mesh box = makeBox({2, 4, 6});
    EXPECT_EQ(box.vertices.size(), 24u);
    EXPECT_EQ(box.indices.size(), 36u);
    EXPECT_EQ(box.bounds.min, glm::vec3(-1, -2, -3));
    EXPECT_EQ(box.bounds.max, glm::vec3(1, 2, 3));

    const Mesh plane = makePlane({4, 2}, 3);
    EXPECT_EQ(plane.indices.size(), 9u * 6);
    EXPECT_EQ(plane.bounds.min, glm::vec3(-2, 0, -1));
    for (const Vertex& vertex : plane.vertices) EXPECT_EQ(vertex.normal, glm::vec3(0, 1, 0));

    const Mesh sphere = makeSphere(2, 16);
    EXPECT_EQ(sphere.bounds.min, glm::vec3(-2));
    EXPECT_EQ(sphere.bounds.max, glm::vec3(2));
    EXPECT_EQ(sphere.indices.size() / 3, 16u * (2 * 8 - 2));  // one triangle per cell at the poles

    const Mesh arch = makeArch(1, 0.5f, 2, 8);
    EXPECT_EQ(arch.bounds.min, glm::vec3(-1.5f, 0, -1));
    EXPECT_EQ(arch.bounds.max, glm::vec3(1.5f, 1.5f, 1));
}

TEST(Primitives, LatheKeepsSharpKinksAndSmoothsFlatOnes) {
    const auto normalsAt = [](const Mesh& mesh, const glm::vec3& position) {
        std::vector<glm::vec3> normals;
        for (const Vertex& vertex : mesh.vertices)
            if (glm::distance(vertex.position, position) < 1e-5f) normals.push_back(vertex.normal);
        return normals;
    };
    const std::vector<glm::vec2> flat = {{1, 0}, {1.1f, 1}, {1, 2}};
    for (const glm::vec3& normal : normalsAt(makeLathe(flat, 16), {1.1f, 1, 0})) EXPECT_NEAR(normal.x, 1, 1e-5);
    const std::vector<glm::vec2> sharp = {{1, 0}, {2, 1}, {1, 2}};
    for (const glm::vec3& normal : normalsAt(makeLathe(sharp, 16), {2, 1, 0}))
        EXPECT_NEAR(normal.x, std::sqrt(0.5f), 1e-5);
}

}  // namespace
}  // namespace crevice
