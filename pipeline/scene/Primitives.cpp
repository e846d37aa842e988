// Triangles for the simple shapes: flat polygons, and curves that are revolved; seams repeat their vertices.
#include "scene/Primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include <glm/gtc/constants.hpp>

namespace crevice {

namespace {

constexpr float kTwoPi = 2 * glm::pi<float>();
constexpr float kSmoothCos = 0.819f;  // cos 35°: flatter kinks of a profile are shaded smoothly
constexpr float kNeverSmooth = 2;

// cos and sin that are exact at quarter turns, so that both ends of a seam coincide and poles lie on the axis.
glm::vec2 unitCircle(std::uint32_t step, std::uint32_t count) {
    step %= count;
    if (4 * step % count == 0) {
        constexpr std::array<glm::vec2, 4> kQuarters = {glm::vec2(1, 0), {0, 1}, {-1, 0}, {0, -1}};
        return kQuarters[4 * step / count];
    }
    const float angle = kTwoPi * float(step) / float(count);
    return {std::cos(angle), std::sin(angle)};
}

// glTF's convention: v falls along the bitangent cross(normal, tangent).
glm::vec2 planarUv(const glm::vec3& position, const glm::vec3& normal, const glm::vec3& tangent) {
    return {glm::dot(position, tangent), -glm::dot(position, glm::cross(normal, tangent))};
}

// A flat convex polygon, counter-clockwise about its normal.
void addPolygon(Mesh& mesh, std::initializer_list<glm::vec3> corners, const glm::vec3& tangent) {
    const glm::vec3* p = corners.begin();
    const glm::vec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const glm::vec3& corner : corners)
        mesh.vertices.push_back({.position = corner,
                                 .normal = normal,
                                 .tangent = glm::vec4(tangent, 1),
                                 .uv0 = planarUv(corner, normal, tangent)});
    for (std::uint32_t i = 2; i < corners.size(); ++i)
        mesh.indices.insert(mesh.indices.end(), {first, first + i - 1, first + i});
}

// Triangles of a grid of `columns` × `rows` cells whose vertices start at `first`, row after row. Seen from the front,
// columns run to the right and rows upwards. Cells that end in a point keep one triangle.
void addGrid(Mesh& mesh, std::uint32_t first, std::uint32_t columns, std::uint32_t rows) {
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto& v = mesh.vertices;
        if (v[a].position == v[b].position || v[b].position == v[c].position || v[c].position == v[a].position) return;
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    };
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c) {
            const std::uint32_t low = first + r * (columns + 1) + c, high = low + columns + 1;
            add(low, low + 1, high + 1);
            add(low, high + 1, high);
        }
}

/// A sample of the curve that is revolved: (radius, height), its normal in that plane, and the length of the curve so
/// far.
struct ProfilePoint {
    glm::vec2 at{0}, normal{0};
    float length = 0;
};

// Revolves points around the y axis, from +x towards -z: to the right, seen from outside.
void revolve(Mesh& mesh, std::span<const ProfilePoint> points, std::uint32_t segments) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    float widest = 0;
    for (const ProfilePoint& p : points) widest = std::max(widest, p.at.x);
    for (const ProfilePoint& p : points)
        for (std::uint32_t s = 0; s <= segments; ++s) {
            const glm::vec2 c = unitCircle(s, segments);
            const glm::vec3 outward(c.x, 0, -c.y);
            mesh.vertices.push_back({.position = p.at.x * outward + glm::vec3(0, p.at.y, 0),
                                     .normal = glm::normalize(p.normal.x * outward + glm::vec3(0, p.normal.y, 0)),
                                     .tangent = {-c.y, 0, -c.x, 1},
                                     .uv0 = {kTwoPi * widest * float(s) / float(segments), -p.length}});
        }
    addGrid(mesh, first, segments, static_cast<std::uint32_t>(points.size() - 1));
}

// The outside of a profile lies to the right of its direction: at larger radii where it rises.
glm::vec2 outsideOf(const glm::vec2& from, const glm::vec2& to) {
    const glm::vec2 d = glm::normalize(to - from);
    return {d.y, -d.x};
}

// Revolves a polyline, split into strips where it bends by more than the angle.
void revolvePolyline(Mesh& mesh, std::vector<glm::vec2> line, std::uint32_t segments, float smoothCos) {
    line.erase(std::unique(line.begin(), line.end()), line.end());
    std::vector<ProfilePoint> strip;
    float length = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::vec2 normal = outsideOf(line[i], line[i + 1]);
        if (strip.empty()) {
            strip.push_back({line[i], normal, length});
        } else if (glm::dot(outsideOf(line[i - 1], line[i]), normal) > smoothCos) {
            strip.back().normal = glm::normalize(strip.back().normal + normal);
        } else {
            revolve(mesh, strip, segments);
            strip = {{line[i], normal, length}};
        }
        length += glm::distance(line[i], line[i + 1]);
        strip.push_back({line[i + 1], normal, length});
    }
    if (strip.size() > 1) revolve(mesh, strip, segments);
}

std::vector<glm::vec2> closeToAxis(std::span<const glm::vec2> profile) {
    std::vector<glm::vec2> line(profile.begin(), profile.end());
    if (line.empty()) return line;
    if (line.front().x > 0) line.insert(line.begin(), {0, line.front().y});
    if (line.back().x > 0) line.push_back({0, line.back().y});
    return line;
}

Mesh finish(Mesh mesh, const char* name) {
    mesh.name = name;
    mesh.hasTangents = true;
    updateBounds(mesh);
    return mesh;
}

}  // namespace

void updateBounds(Mesh& mesh) {
    mesh.bounds = {};
    for (const Vertex& vertex : mesh.vertices) mesh.bounds.add(vertex.position);
}

Mesh makeBox(const glm::vec3& size) {
    struct Face {
        glm::vec3 normal, tangent;
    };
    constexpr Face kFaces[] = {{{1, 0, 0}, {0, 0, -1}}, {{-1, 0, 0}, {0, 0, 1}}, {{0, 1, 0}, {1, 0, 0}},
                               {{0, -1, 0}, {1, 0, 0}}, {{0, 0, 1}, {1, 0, 0}},  {{0, 0, -1}, {-1, 0, 0}}};
    const glm::vec3 half = 0.5f * size;
    Mesh mesh;
    for (const Face& face : kFaces) {
        const glm::vec3 n = half * face.normal, t = half * face.tangent,
                        b = half * glm::cross(face.normal, face.tangent);
        addPolygon(mesh, {n - t - b, n + t - b, n + t + b, n - t + b}, face.tangent);
    }
    return finish(std::move(mesh), "box");
}

Mesh makePlane(const glm::vec2& size, std::uint32_t segments) {
    Mesh mesh;
    for (std::uint32_t row = 0; row <= segments; ++row)
        for (std::uint32_t column = 0; column <= segments; ++column) {
            const glm::vec3 position(size.x * (float(column) / float(segments) - 0.5f), 0,
                                     size.y * (0.5f - float(row) / float(segments)));
            mesh.vertices.push_back(
                {.position = position, .normal = {0, 1, 0}, .uv0 = planarUv(position, {0, 1, 0}, {1, 0, 0})});
        }
    addGrid(mesh, 0, segments, segments);
    return finish(std::move(mesh), "plane");
}

Mesh makeSphere(float radius, std::uint32_t segments) {
    const std::uint32_t rows = std::max(2u, segments / 2);
    std::vector<ProfilePoint> points;
    for (std::uint32_t i = 0; i <= rows; ++i) {
        const glm::vec2 c = unitCircle(i, 2 * rows);  // half a turn from the south pole
        const glm::vec2 normal(c.y, -c.x);
        points.push_back({radius * normal, normal, 0.5f * kTwoPi * radius * float(i) / float(rows)});
    }
    Mesh mesh;
    revolve(mesh, points, segments);
    return finish(std::move(mesh), "sphere");
}

Mesh makeCylinder(float bottomRadius, float topRadius, float height, std::uint32_t segments) {
    const std::array<glm::vec2, 2> side = {glm::vec2(bottomRadius, -0.5f * height), {topRadius, 0.5f * height}};
    Mesh mesh;
    revolvePolyline(mesh, closeToAxis(side), segments, kNeverSmooth);
    return finish(std::move(mesh), "cylinder");
}

Mesh makeTorus(float radius, float tubeRadius, std::uint32_t segments, std::uint32_t tubeSegments) {
    std::vector<ProfilePoint> points;
    for (std::uint32_t i = 0; i <= tubeSegments; ++i) {
        const glm::vec2 normal = unitCircle(i, tubeSegments);
        points.push_back(
            {glm::vec2(radius, 0) + tubeRadius * normal, normal, kTwoPi * tubeRadius * float(i) / float(tubeSegments)});
    }
    Mesh mesh;
    revolve(mesh, points, segments);
    return finish(std::move(mesh), "torus");
}

Mesh makeWedge(const glm::vec3& size) {
    const float x = 0.5f * size.x, y = 0.5f * size.y, z = 0.5f * size.z;
    Mesh mesh;
    addPolygon(mesh, {{-x, -y, -z}, {x, -y, -z}, {x, -y, z}, {-x, -y, z}}, {1, 0, 0});   // bottom
    addPolygon(mesh, {{x, -y, -z}, {-x, -y, -z}, {-x, y, -z}, {x, y, -z}}, {-1, 0, 0});  // back
    addPolygon(mesh, {{-x, -y, z}, {x, -y, z}, {x, y, -z}, {-x, y, -z}}, {1, 0, 0});     // slope
    addPolygon(mesh, {{x, -y, z}, {x, -y, -z}, {x, y, -z}}, {0, 0, -1});                 // right
    addPolygon(mesh, {{-x, -y, -z}, {-x, -y, z}, {-x, y, -z}}, {0, 0, 1});               // left
    return finish(std::move(mesh), "wedge");
}

Mesh makeArch(float innerRadius, float thickness, float depth, std::uint32_t segments) {
    const float outer = innerRadius + thickness, z = 0.5f * depth;
    Mesh mesh;
    // Curved faces: rows step along the arch, columns along z; a front face looks inwards or outwards by its columns'
    // direction.
    const auto addCurved = [&](float radius, float facing) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (std::uint32_t i = 0; i <= segments; ++i)
            for (const float side : {facing, -facing}) {
                const glm::vec2 c = unitCircle(i, 2 * segments);
                const float along = 0.5f * kTwoPi * radius * float(i) / float(segments);
                mesh.vertices.push_back({.position = {radius * c.x, radius * c.y, side * z},
                                         .normal = {facing * c.x, facing * c.y, 0},
                                         .tangent = {0, 0, -facing, 1},
                                         .uv0 = {-facing * side * z, -along}});
            }
        addGrid(mesh, first, 1, segments);
    };
    addCurved(outer, 1);
    addCurved(innerRadius, -1);
    for (std::uint32_t i = 0; i < segments; ++i) {
        const glm::vec2 a = unitCircle(i, 2 * segments), b = unitCircle(i + 1, 2 * segments);
        const glm::vec3 innerA(innerRadius * a, z), outerA(outer * a, z), innerB(innerRadius * b, z),
            outerB(outer * b, z);
        const glm::vec3 back(0, 0, -depth);
        addPolygon(mesh, {innerA, outerA, outerB, innerB}, {1, 0, 0});
        addPolygon(mesh, {innerB + back, outerB + back, outerA + back, innerA + back}, {-1, 0, 0});
    }
    addPolygon(mesh, {{innerRadius, 0, -z}, {outer, 0, -z}, {outer, 0, z}, {innerRadius, 0, z}}, {1, 0, 0});
    addPolygon(mesh, {{-outer, 0, -z}, {-innerRadius, 0, -z}, {-innerRadius, 0, z}, {-outer, 0, z}}, {1, 0, 0});
    return finish(std::move(mesh), "arch");
}

Mesh makeLathe(std::span<const glm::vec2> profile, std::uint32_t segments) {
    Mesh mesh;
    revolvePolyline(mesh, closeToAxis(profile), segments, kSmoothCos);
    return finish(std::move(mesh), "lathe");
}

}  // namespace crevice
