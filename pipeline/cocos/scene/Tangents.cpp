// Sums first, then one pass that straightens them.
#include "cocos/scene/Tangents.h"

#include <cmath>

namespace crevice::cocos {
namespace {

glm::vec3 anyAcross(const glm::vec3& normal) {
    const glm::vec3 axis = std::abs(normal.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(axis - normal * glm::dot(axis, normal));
}

}  // namespace

void addTangents(Mesh& mesh) {
    std::vector<glm::vec3> along(mesh.vertices.size(), glm::vec3(0)), across(mesh.vertices.size(), glm::vec3(0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* corner = &mesh.indices[i];
        const Vertex &a = mesh.vertices[corner[0]], &b = mesh.vertices[corner[1]], &c = mesh.vertices[corner[2]];
        const glm::vec3 e1 = b.position - a.position, e2 = c.position - a.position;
        const glm::vec2 d1 = b.uv0 - a.uv0, d2 = c.uv0 - a.uv0;
        const float area = d1.x * d2.y - d2.x * d1.y;
        if (area == 0 || !std::isfinite(area)) continue;
        const glm::vec3 s = (e1 * d2.y - e2 * d1.y) / area, t = (e2 * d1.x - e1 * d2.x) / area;
        for (int k = 0; k < 3; ++k) {
            along[corner[k]] += s;
            across[corner[k]] += t;
        }
    }
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        Vertex& vertex = mesh.vertices[i];
        const glm::vec3& n = vertex.normal;
        const glm::vec3 flat = along[i] - n * glm::dot(n, along[i]);
        const float length = glm::length(flat);
        const bool good = length > 1e-12f && std::isfinite(length);
        const glm::vec3 tangent = good ? flat / length : anyAcross(n);
        const bool mirrored = good && glm::dot(glm::cross(n, along[i]), across[i]) < 0;
        vertex.tangent = {tangent, mirrored ? -1.0f : 1.0f};
    }
    mesh.hasTangents = true;
}

void addTangentsFor(const SceneMaterial& material, Mesh& mesh, bool required) {
    if (mesh.hasTangents || (!material.normalMap && !required)) return;
    for (const TextureRef* map : {&material.baseColorMap, &material.metallicRoughnessMap, &material.normalMap,
                                  &material.occlusionMap, &material.emissiveMap})
        if (*map && map->texcoord > 1) return;
    addTangents(mesh);
}

}  // namespace crevice::cocos
