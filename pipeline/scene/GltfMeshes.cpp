// glTF primitives as indexed triangle lists with one vertex layout.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "scene/GltfParts.h"
#include "scene/Primitives.h"

namespace crevice::gltf {

namespace {

/// The accessors of one primitive, read.
struct Attributes {
    FloatStream position, normal, tangent, uv0, uv1, color, joints, weights;
};

constexpr int kAnyCount = 0;

// An attribute that may be absent. All of a primitive have the count of POSITION.
FloatStream readAttribute(const File& file, int mesh, const tinygltf::Primitive& primitive, const char* name,
                          int components, std::size_t count) {
    const auto entry = primitive.attributes.find(name);
    if (entry == primitive.attributes.end()) return {};
    if (entry->second < 0 || std::size_t(entry->second) >= file.model.accessors.size())
        file.fail(
            "meshes", mesh,
            fmt::format("'{}' names accessors[{}], the file has {}", name, entry->second, file.model.accessors.size()));
    if (count && file.model.accessors[entry->second].count != count)
        file.fail("accessors", entry->second,
                  fmt::format("'count' is {}, but POSITION of meshes[{}] has {}",
                              file.model.accessors[entry->second].count, mesh, count));
    FloatStream floats = readFloatStream(file, entry->second);
    const bool fits =
        components == kAnyCount ? floats.components == 3 || floats.components == 4 : floats.components == components;
    if (!fits)
        file.fail("accessors", entry->second,
                  fmt::format("'type' does not fit {} of meshes[{}]: {} components", name, mesh, floats.components));
    return floats;
}

// glTF 2.0 specification, 3.7.2.1: how strips and fans become triangles.
std::vector<std::uint32_t> toTriangleList(int mode, std::vector<std::uint32_t> indices) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        indices.resize(indices.size() / 3 * 3);
        return indices;
    }
    std::vector<std::uint32_t> list;
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
            list.insert(list.end(), {indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
        else
            list.insert(list.end(), {indices[i + 1], indices[i + 2], indices[0]});
    }
    return list;
}

glm::vec3 unitOr(const glm::vec3& vector, const glm::vec3& otherwise) {
    const float length = glm::length(vector);
    return length > 0 && std::isfinite(length) ? vector / length : otherwise;
}

Vertex makeVertex(const Attributes& from, std::size_t i) {
    Vertex vertex;
    vertex.position = from.position.at<3>(i);
    if (from.normal.components) vertex.normal = unitOr(from.normal.at<3>(i), {0, 0, 1});
    if (from.tangent.components) {
        const glm::vec4 tangent = from.tangent.at<4>(i);
        vertex.tangent = glm::vec4(unitOr(glm::vec3(tangent), {1, 0, 0}), tangent.w < 0 ? -1.0f : 1.0f);
    }
    if (from.uv0.components) vertex.uv0 = from.uv0.at<2>(i);
    if (from.uv1.components) vertex.uv1 = from.uv1.at<2>(i);
    if (from.color.components == 3) vertex.color = glm::vec4(from.color.at<3>(i), 1);
    if (from.color.components == 4) vertex.color = from.color.at<4>(i);
    return vertex;
}

// Linear blend skinning, glTF 2.0 specification, 3.7.3.3: done once, in the pose of the file.
void skin(const File& file, int mesh, const Attributes& from, const std::vector<glm::mat4>& joints, std::size_t i,
          Vertex& vertex) {
    glm::mat4 blend(0);
    float total = 0;
    const glm::vec4 weights = from.weights.at<4>(i), indices = from.joints.at<4>(i);
    for (int k = 0; k < 4; ++k) {
        const float weight = weights[k];
        const auto joint = static_cast<std::size_t>(indices[k]);
        if (weight == 0) continue;
        if (joint >= joints.size())
            file.fail("meshes", mesh, fmt::format("JOINTS_0 names joint {}, the skin has {}", joint, joints.size()));
        blend += weight * joints[joint];
        total += weight;
    }
    if (total <= 0) return;
    blend /= total;
    vertex.position = glm::vec3(blend * glm::vec4(vertex.position, 1));
    vertex.normal = unitOr(glm::mat3(blend) * vertex.normal, vertex.normal);
    vertex.tangent =
        glm::vec4(unitOr(glm::mat3(blend) * glm::vec3(vertex.tangent), glm::vec3(vertex.tangent)), vertex.tangent.w);
}

// Without normals glTF asks for flat ones: every triangle gets its own three vertices.
void makeFlat(Mesh& mesh) {
    std::vector<Vertex> vertices;
    vertices.reserve(mesh.indices.size());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        Vertex corner[3] = {mesh.vertices[mesh.indices[i]], mesh.vertices[mesh.indices[i + 1]],
                            mesh.vertices[mesh.indices[i + 2]]};
        const glm::vec3 normal = unitOr(
            glm::cross(corner[1].position - corner[0].position, corner[2].position - corner[0].position), {0, 0, 1});
        for (Vertex& vertex : corner) {
            vertex.normal = normal;
            vertices.push_back(vertex);
        }
    }
    mesh.vertices = std::move(vertices);
    mesh.indices.resize(mesh.vertices.size());
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
}

[[noreturn]] void failPosition(const File& file, int mesh, std::size_t vertex) {
    file.fail("meshes", mesh, fmt::format("POSITION of vertex {} is not a finite number", vertex));
}

bool isFinite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

std::vector<std::uint32_t> readIndices(const File& file, int mesh, const tinygltf::Primitive& primitive,
                                       std::size_t vertexCount) {
    std::vector<std::uint32_t> indices;
    if (primitive.indices < 0) {
        indices.resize(vertexCount);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }
    if (std::size_t(primitive.indices) >= file.model.accessors.size())
        file.fail("meshes", mesh,
                  fmt::format("'indices' names accessors[{}], the file has {}", primitive.indices,
                              file.model.accessors.size()));
    if (file.model.accessors[primitive.indices].type != TINYGLTF_TYPE_SCALAR)
        file.fail("accessors", primitive.indices, "'type' of indices is not SCALAR");
    indices = readIntegers(file, primitive.indices);
    std::uint32_t largest = 0;
    for (const std::uint32_t index : indices) largest = std::max(largest, index);
    for (std::size_t i = 0; largest >= vertexCount && i < indices.size(); ++i)
        if (indices[i] >= vertexCount)
            file.fail("accessors", primitive.indices,
                      fmt::format("index {} at {} is not below the {} vertices of meshes[{}]", indices[i], i,
                                  vertexCount, mesh));
    return indices;
}

}  // namespace

void Meshes::countVertices(std::size_t vertices, std::size_t indices, int mesh) {
    vertexCount_ += vertices;
    indexCount_ += indices;
    const std::size_t limit = file_.options.limits.maxVertices;
    if (vertexCount_ > limit || indexCount_ > 6 * limit)
        file_.fail("meshes", mesh, fmt::format("the scene has more than {} vertices", limit));
}

std::optional<Mesh> Meshes::readPrimitive(int meshIndex, std::size_t index, const std::vector<glm::mat4>& joints) {
    const tinygltf::Mesh& from = file_.model.meshes[meshIndex];
    const tinygltf::Primitive& primitive = from.primitives[index];
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        file_.fail("meshes", meshIndex, fmt::format("'mode' {} of a primitive is not 0 … 6", primitive.mode));
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        if (!notedLines_) file_.note("points and lines are not drawn");
        notedLines_ = true;
        return std::nullopt;
    }
    if (!primitive.targets.empty() && !notedMorph_) {
        file_.note("morph targets are not read: meshes are shown in their base shape");
        notedMorph_ = true;
    }

    const auto read = [&](const char* name, int components, std::size_t count) {
        return readAttribute(file_, meshIndex, primitive, name, components, count);
    };
    Attributes attributes;
    attributes.position = read("POSITION", 3, 0);
    const std::size_t count = attributes.position.count;
    if (count == 0) return std::nullopt;  // legal, and nothing to draw
    countVertices(count, 0, meshIndex);
    attributes.normal = read("NORMAL", 3, count);
    if (attributes.normal.components) attributes.tangent = read("TANGENT", 4, count);
    attributes.uv0 = read("TEXCOORD_0", 2, count);
    attributes.uv1 = read("TEXCOORD_1", 2, count);
    attributes.color = read("COLOR_0", kAnyCount, count);
    if (!joints.empty()) {
        attributes.joints = read("JOINTS_0", 4, count);
        attributes.weights = read("WEIGHTS_0", 4, count);
    }

    Mesh mesh;
    mesh.name = from.name.empty() ? fmt::format("mesh {}", meshIndex) : from.name;
    if (from.primitives.size() > 1) mesh.name += fmt::format("/{}", index);
    mesh.indices = toTriangleList(primitive.mode, readIndices(file_, meshIndex, primitive, count));
    if (mesh.indices.empty()) return std::nullopt;
    mesh.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        mesh.vertices.push_back(makeVertex(attributes, i));
        Vertex& vertex = mesh.vertices.back();
        if (attributes.joints.components && attributes.weights.components)
            skin(file_, meshIndex, attributes, joints, i, vertex);
        if (!isFinite(vertex.position)) failPosition(file_, meshIndex, i);
        mesh.bounds.add(vertex.position);
    }
    if (!attributes.normal.components) {
        makeFlat(mesh);
        updateBounds(mesh);  // of the corners in use
    }
    countVertices(mesh.vertices.size() - std::min(count, mesh.vertices.size()), mesh.indices.size(), meshIndex);
    mesh.hasTangents = attributes.tangent.components == 4;
    return mesh;
}

const std::vector<Part>& Meshes::parts(int mesh, int skin, const std::vector<glm::mat4>& joints) {
    const auto [entry, isNew] = parts_.try_emplace({mesh, skin});
    if (!isNew) return entry->second;
    const auto& primitives = file_.model.meshes[mesh].primitives;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const int material = primitives[i].material;
        if (material >= int(file_.model.materials.size()))
            file_.fail("meshes", mesh,
                       fmt::format("'material' is {}, the file has {}", material, file_.model.materials.size()));
        if (auto read = readPrimitive(mesh, i, joints)) {
            entry->second.push_back({.mesh = int(meshes_.size()), .material = std::max(material, -1)});
            meshes_.push_back(std::move(*read));
        }
    }
    return entry->second;
}

}  // namespace crevice::gltf
