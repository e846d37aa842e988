// What moves vertices before they are uploaded: morph targets and skins, in the pose that is shown.
#include <cmath>

#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

// Adds `weight` times a target's differences. Colours and coordinates may have more components than are kept.
void addTarget(const File& file, int mesh, const AttributeMap& target, const std::string& name, float weight,
               FloatStream& base) {
    const auto entry = target.find(name);
    if (entry == target.end() || base.components == 0) return;
    const Floats difference = readFloats(file, entry->second);
    if (difference.count() != base.count)
        file.fail(
            "accessors", std::size_t(entry->second),
            fmt::format("'count' is {}, but {} of meshes[{}] has {}", difference.count(), name, mesh, base.count));
    // A tangent's handedness is not morphed: glTF 2.0 specification, 3.7.2.2.
    const std::size_t width = std::size_t(base.components);
    const std::size_t shared = std::min(std::size_t(difference.components), name == "TANGENT" ? 3 : width);
    std::vector<float>& values = base.edit();
    for (std::size_t i = 0; i < base.count; ++i)
        for (std::size_t c = 0; c < shared; ++c) values[i * width + c] += weight * difference.at(i)[c];
}

glm::mat4 blendMatrix(const File& file, int mesh, const Attributes& from, std::span<const glm::mat4> joints,
                      std::size_t vertex, float& total) {
    glm::mat4 blend(0);
    total = 0;
    for (std::size_t set = 0; set < from.joints.size(); ++set) {
        const glm::vec4 weights = from.weights[set].at<4>(vertex);
        for (std::size_t k = 0; k < 4; ++k) {
            const float weight = weights[int(k)];
            if (weight == 0) continue;  // padding: its joint may be anything
            const std::uint32_t joint = from.joints[set][vertex * 4 + k];
            if (joint >= joints.size())
                file.fail("meshes", std::size_t(mesh),
                          fmt::format("JOINTS_{} of vertex {} names joint {}, the skin has {}", set, vertex, joint,
                                      joints.size()));
            blend += weight * joints[joint];
            total += weight;
        }
    }
    return blend;
}

}  // namespace

glm::vec3 unitOr(const glm::vec3& vector, const glm::vec3& otherwise) {
    const float length = glm::length(vector);
    return length > 0 && std::isfinite(length) ? vector / length : otherwise;
}

void morph(const File& file, int mesh, const PrimitivePart& primitive, std::span<const float> weights,
           std::span<const int> sets, Attributes& attributes) {
    for (std::size_t i = 0; i < primitive.targets.size() && i < weights.size(); ++i) {
        if (weights[i] == 0) continue;
        const auto add = [&](const std::string& name, FloatStream& base) {
            addTarget(file, mesh, primitive.targets[i], name, weights[i], base);
        };
        add("POSITION", attributes.position);
        add("NORMAL", attributes.normal);
        add("TANGENT", attributes.tangent);
        add("COLOR_0", attributes.color);
        for (std::size_t set = 0; set < sets.size(); ++set)
            add(fmt::format("TEXCOORD_{}", sets[set]), attributes.uv[set]);
    }
}

void bend(const File& file, int mesh, const Attributes& from, std::span<const glm::mat4> joints,
          std::vector<Vertex>& vertices) {
    if (from.joints.empty() || joints.empty()) return;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        Vertex& vertex = vertices[i];
        float total = 0;
        glm::mat4 blend = blendMatrix(file, mesh, from, joints, i, total);
        if (!(total > 0)) continue;
        blend /= total;
        vertex.position = glm::vec3(blend * glm::vec4(vertex.position, 1));
        // Normals follow the cofactor matrix: right for stretched joints too.
        const glm::mat3 turn(blend);
        const glm::mat3 cofactor(glm::cross(turn[1], turn[2]), glm::cross(turn[2], turn[0]),
                                 glm::cross(turn[0], turn[1]));
        const float sign = glm::determinant(turn) < 0 ? -1.0f : 1.0f;
        vertex.normal = unitOr(sign * (cofactor * vertex.normal), vertex.normal);
        if (from.tangent.components == 0) continue;
        const glm::vec3 tangent(vertex.tangent);
        vertex.tangent = glm::vec4(unitOr(turn * tangent, tangent), sign * vertex.tangent.w);
    }
}

}  // namespace crevice::gltf
