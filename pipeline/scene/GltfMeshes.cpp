// glTF primitives as indexed points, lines or triangles with one vertex layout.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "scene/GltfRelease.h"

namespace crevice::gltf {

namespace {

/// Types that an attribute may have: components of an element, and of numbers " f" and normalised or plain integers.
struct AttributeRule {
    const char* name;
    int least, most;
};
constexpr AttributeRule kAttributeRules[] = {{"POSITION", 3, 3}, {"NORMAL", 3, 3}, {"TANGENT", 4, 4},
                                             {"TEXCOORD", 2, 2}, {"COLOR", 3, 4},  {"JOINTS", 4, 4},
                                             {"WEIGHTS", 4, 4}};

// An attribute that may be absent: -1. All of a primitive have the count of POSITION.
int findAttribute(const File& file, int mesh, const PrimitivePart& primitive, const std::string& name,
                  std::size_t count) {
    const auto entry = primitive.attributes.find(name);
    if (entry == primitive.attributes.end()) return -1;
    const std::size_t index = std::size_t(entry->second);
    const AccessorPart& accessor = file.model.accessors[index];
    if (count && accessor.count != count)
        file.fail("accessors", index,
                  fmt::format("'count' is {}, but POSITION of meshes[{}] has {}", accessor.count, mesh, count));
    for (const AttributeRule& rule : kAttributeRules)
        if (name.starts_with(rule.name) &&
            (accessor.columns != 1 || accessor.rows < rule.least || accessor.rows > rule.most))
            file.fail("accessors", index,
                      fmt::format("'type' does not fit {} of meshes[{}]: it is '{}'", name, mesh,
                                  textOr(file.item("accessors", index), "type")));
    return entry->second;
}

FloatStream readAttribute(const File& file, int mesh, const PrimitivePart& primitive, const std::string& name,
                          std::size_t count) {
    const int accessor = findAttribute(file, mesh, primitive, name, count);
    return accessor < 0 ? FloatStream{} : readFloatStream(file, accessor);
}

void readJoints(const File& file, int mesh, const PrimitivePart& primitive, std::size_t count, Attributes& to) {
    for (int set = 0;; ++set) {
        const int joints = findAttribute(file, mesh, primitive, fmt::format("JOINTS_{}", set), count);
        const int weights = findAttribute(file, mesh, primitive, fmt::format("WEIGHTS_{}", set), count);
        if (joints < 0 || weights < 0) return;
        to.joints.push_back(readIntegers(file, joints));
        to.weights.push_back(readFloatStream(file, weights));
    }
}

Attributes readAttributes(const File& file, int mesh, const PrimitivePart& primitive, std::span<const int> sets,
                          bool skinned) {
    Attributes to;
    to.position = readAttribute(file, mesh, primitive, "POSITION", 0);
    const std::size_t count = to.position.count;
    to.normal = readAttribute(file, mesh, primitive, "NORMAL", count);
    // Without normals tangents do not count: glTF 2.0 specification, 3.7.2.1. More than two sets of texture coordinates
    // take their place: the frame then follows from derivatives.
    if (to.normal.components && sets.size() <= 2) to.tangent = readAttribute(file, mesh, primitive, "TANGENT", count);
    for (std::size_t set = 0; set < sets.size(); ++set)
        to.uv[set] = readAttribute(file, mesh, primitive, fmt::format("TEXCOORD_{}", sets[set]), count);
    to.color = readAttribute(file, mesh, primitive, "COLOR_0", count);
    if (skinned) readJoints(file, mesh, primitive, count, to);
    return to;
}

MeshTopology topologyOf(int mode) {
    return mode == kPoints ? MeshTopology::Points : mode < kTriangles ? MeshTopology::Lines : MeshTopology::Triangles;
}

// glTF 2.0 specification, 3.7.2.1: how strips, loops and fans become lists. What is left over is dropped.
std::vector<std::uint32_t> toList(int mode, std::vector<std::uint32_t> indices) {
    const std::size_t count = indices.size();
    if (mode == kPoints) return indices;
    if (mode == kLines || mode == kTriangles) {
        const std::size_t group = mode == kLines ? 2 : 3;
        indices.resize(count / group * group);
        return indices;
    }
    std::vector<std::uint32_t> list;
    if (mode == kLineStrip || mode == kLineLoop) {
        for (std::size_t i = 0; i + 1 < count; ++i) list.insert(list.end(), {indices[i], indices[i + 1]});
        if (mode == kLineLoop && count > 1) list.insert(list.end(), {indices.back(), indices.front()});
        return list;
    }
    for (std::size_t i = 0; i + 2 < count; ++i) {
        if (mode == kTriangleStrip)
            list.insert(list.end(), {indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
        else
            list.insert(list.end(), {indices[i + 1], indices[i + 2], indices[0]});
    }
    return list;
}

/// Of so many the bytes are given back together.
constexpr std::size_t kVerticesAtOnce = 1 << 16;

Vertex makeVertex(const Attributes& from, std::size_t i) {
    Vertex vertex;
    vertex.position = from.position.at<3>(i);
    if (from.normal.components) vertex.normal = unitOr(from.normal.at<3>(i), {0, 0, 1});
    if (from.tangent.components) {
        const glm::vec4 tangent = from.tangent.at<4>(i);
        vertex.tangent = glm::vec4(unitOr(glm::vec3(tangent), {1, 0, 0}), tangent.w < 0 ? -1.0f : 1.0f);
    }
    const auto uv = [&](int set) { return from.uv[set].components ? from.uv[set].at<2>(i) : glm::vec2(0); };
    vertex.uv0 = uv(0);
    vertex.uv1 = uv(1);
    if (from.uv[2].components || from.uv[3].components) vertex.tangent = glm::vec4(uv(2), uv(3));
    if (from.color.components == 3) vertex.color = glm::vec4(from.color.at<3>(i), 1);
    if (from.color.components == 4) vertex.color = from.color.at<4>(i);
    vertex.color = glm::clamp(vertex.color, 0.0f, 1.0f);  // glTF 2.0 specification, 3.7.2.1
    return vertex;
}

glm::vec3 flatNormal(const Vertex* corner) {
    return unitOr(glm::cross(corner[1].position - corner[0].position, corner[2].position - corner[0].position),
                  {0, 0, 1});
}

bool sharesNothing(const Mesh& mesh) {
    if (mesh.vertices.size() != mesh.indices.size()) return false;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        if (mesh.indices[i] != i) return false;
    return true;
}

// Without normals glTF asks for flat ones: every triangle gets its own three vertices.
void makeFlat(Mesh& mesh) {
    if (sharesNothing(mesh)) {
        for (std::size_t i = 0; i + 2 < mesh.vertices.size(); i += 3) {
            const glm::vec3 normal = flatNormal(&mesh.vertices[i]);
            for (std::size_t k = 0; k < 3; ++k) mesh.vertices[i + k].normal = normal;
        }
        return;
    }
    std::vector<Vertex> vertices;
    vertices.reserve(mesh.indices.size());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        Vertex corner[3] = {mesh.vertices[mesh.indices[i]], mesh.vertices[mesh.indices[i + 1]],
                            mesh.vertices[mesh.indices[i + 2]]};
        const glm::vec3 normal = flatNormal(corner);
        for (Vertex& vertex : corner) {
            vertex.normal = normal;
            vertices.push_back(vertex);
        }
    }
    mesh.vertices = std::move(vertices);
    mesh.indices.resize(mesh.vertices.size());
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
}

// Morphs and skins may leave what floats can hold.
void addToBounds(const File& file, int mesh, Mesh& to) {
    for (std::size_t i = 0; i < to.vertices.size(); ++i) {
        const glm::vec3& p = to.vertices[i].position;
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            file.fail("meshes", std::size_t(mesh), fmt::format("the place of vertex {} is not a finite number", i));
        to.bounds.add(p);
    }
}

std::vector<std::uint32_t> readIndices(const File& file, int mesh, const PrimitivePart& primitive,
                                       std::size_t vertexCount) {
    std::vector<std::uint32_t> indices;
    if (primitive.indices < 0) {
        indices.resize(vertexCount);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }
    const std::size_t accessor = std::size_t(primitive.indices);
    if (file.model.accessors[accessor].components() != 1)
        file.fail("accessors", accessor, "'type' of indices is not SCALAR");
    indices = readIntegers(file, primitive.indices);
    std::uint32_t largest = 0;
    for (const std::uint32_t index : indices) largest = std::max(largest, index);
    for (std::size_t i = 0; largest >= vertexCount && i < indices.size(); ++i)
        if (indices[i] >= vertexCount)
            file.fail("accessors", accessor,
                      fmt::format("index {} at {} is not below the {} vertices of meshes[{}]", indices[i], i,
                                  vertexCount, mesh));
    return indices;
}

// How often as many attributes are read as there are vertices: sets of joints and morph targets beyond the first count
// as vertices, as they take as much time.
std::size_t timesRead(const PrimitivePart& primitive, const Deformation& deformation, std::span<const float> weights) {
    std::size_t times = 1;
    if (!deformation.joints.empty())
        for (const auto& [name, accessor] : primitive.attributes) times += name.starts_with("JOINTS_");
    for (std::size_t i = 0; i < std::min(weights.size(), primitive.targets.size()); ++i) times += weights[i] != 0;
    return times;
}

std::string nameOf(const MeshPart& mesh, int index, std::size_t primitive) {
    std::string name = mesh.name.empty() ? fmt::format("mesh {}", index) : mesh.name;
    if (mesh.primitives.size() > 1) name += fmt::format("/{}", primitive);
    return name;
}

}  // namespace

// Nodes of different skins read a mesh once each: a small file can have its primitives and targets read any number of
// times without many vertices. To pass over 64 targets of weight 0 takes as long as to read one of a few vertices.
void Meshes::countReadings(std::size_t times, std::size_t passedOver, int mesh) {
    const std::size_t most = std::max<std::size_t>(4 * file_.options.limits.maxInstances, 1000);
    readings_ += times + passedOver / 64;
    if (readings_ > most)
        file_.fail("meshes", std::size_t(mesh),
                   fmt::format("nodes deform meshes so often that more than {} primitives and targets are read", most),
                   raiseLimit("instances"));
}

void Meshes::countVertices(std::size_t vertices, std::size_t times, std::size_t indices, int mesh) {
    const std::size_t limit = file_.options.limits.maxVertices;
    const bool tooMany = vertices > (limit - vertexCount_) / times || indices > 6 * limit - indexCount_;
    if (tooMany)
        file_.fail("meshes", std::size_t(mesh), fmt::format("the scene has more than {} vertices", limit),
                   raiseLimit("vertices"));
    vertexCount_ += vertices * times;
    indexCount_ += indices;
}

std::optional<Mesh> Meshes::readPrimitive(int meshIndex, std::size_t index, const Deformation& deformation,
                                          Part& part) {
    const MeshPart& from = file_.model.meshes[std::size_t(meshIndex)];
    const PrimitivePart& primitive = from.primitives[index];
    static constexpr int kFirstSets[] = {0, 1};
    const std::span<const int> sets = primitive.material < 0 ? std::span<const int>(kFirstSets)
                                                             : materials_.texcoords[std::size_t(primitive.material)];

    const std::span<const float> weights = deformation.weights.empty() ? from.weights : deformation.weights;
    const std::size_t times = timesRead(primitive, deformation, weights);
    countReadings(times, std::min(weights.size(), primitive.targets.size()) + primitive.attributes.size(), meshIndex);
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return std::nullopt;  // legal, and nothing to draw
    const std::size_t count = file_.model.accessors[std::size_t(position->second)].count;
    Release::Reading reading(release_, primitive);
    countVertices(count, times, 0, meshIndex);
    Attributes attributes = readAttributes(file_, meshIndex, primitive, sets, !deformation.joints.empty());
    morph(file_, meshIndex, primitive, weights, sets, attributes);

    Mesh mesh;
    mesh.name = nameOf(from, meshIndex, index);
    mesh.topology = topologyOf(primitive.mode);
    mesh.indices = toList(primitive.mode, readIndices(file_, meshIndex, primitive, count));
    if (mesh.indices.empty()) return std::nullopt;
    mesh.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (i % kVerticesAtOnce == 0) {
            if (attributes.weights.empty()) reading.passed(i);
            file_.tell("converting geometry", double(made_ + i) / double(expected_));
        }
        mesh.vertices.push_back(makeVertex(attributes, i));
    }
    made_ += count;
    bend(file_, meshIndex, attributes, deformation.joints, mesh.vertices);
    const bool hasNormals = attributes.normal.components != 0;
    if (!hasNormals && mesh.topology == MeshTopology::Triangles) makeFlat(mesh);
    countVertices(mesh.vertices.size() - std::min(count, mesh.vertices.size()), 1, mesh.indices.size(), meshIndex);
    mesh.hasTangents = attributes.tangent.components == 4;
    // glTF 2.0 specification, 3.9.7: how points and lines are shaded.
    if (mesh.topology != MeshTopology::Triangles) {
        part.unlit = !hasNormals;
        part.noMap = !mesh.hasTangents;
    }
    addToBounds(file_, meshIndex, mesh);
    return mesh;
}

void Meshes::expect(const std::vector<std::pair<int, Deformation>>& wanted) {
    std::set<Key> keys;
    std::map<int, std::size_t> times;
    for (const auto& [mesh, deformation] : wanted)
        if (keys.insert({mesh, deformation.skin, deformation.weights}).second) ++times[mesh];
    release_.expect(times);
    for (const auto& [mesh, count] : times)
        for (const PrimitivePart& primitive : file_.model.meshes[std::size_t(mesh)].primitives)
            if (const auto position = primitive.attributes.find("POSITION"); position != primitive.attributes.end())
                expected_ += count * file_.model.accessors[std::size_t(position->second)].count;
}

const std::vector<Part>& Meshes::parts(int mesh, const Deformation& deformation) {
    const auto [entry, isNew] = parts_.try_emplace({mesh, deformation.skin, deformation.weights});
    if (!isNew) return entry->second;
    const auto& primitives = file_.model.meshes[std::size_t(mesh)].primitives;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        Part part{.mesh = int(meshes_.size()), .material = primitives[i].material};
        if (auto read = readPrimitive(mesh, i, deformation, part)) {
            entry->second.push_back(part);
            meshes_.push_back(std::move(*read));
        }
    }
    return entry->second;
}

}  // namespace crevice::gltf
