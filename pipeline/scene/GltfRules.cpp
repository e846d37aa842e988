// Rules of glTF 2.0 that span several objects. What can still be drawn rightly is a fault, the rest an error.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/Picture.h"
#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

constexpr int kIndexTarget = 34963;  // ELEMENT_ARRAY_BUFFER

void checkBufferViews(const File& file) {
    for (std::size_t i = 0; i < file.model.bufferViews.size(); ++i) {
        const BufferViewPart& view = file.model.bufferViews[i];
        if (view.byteStride % 4) file.fault("bufferViews", i, "'byteStride' is not a multiple of 4");
        if (view.byteStride && intOr(file.item("bufferViews", i), "target", 0) == kIndexTarget)
            file.fault("bufferViews", i, "'byteStride' is not for indices");
        if (view.byteStride > view.byteLength) file.fault("bufferViews", i, "'byteStride' is above 'byteLength'");
    }
}

const char* typeOf(PictureKind kind) {
    return kind == PictureKind::Png ? "image/png" : kind == PictureKind::Jpeg ? "image/jpeg" : "image/webp";
}

void checkImages(const File& file) {
    const auto& used = listIn(file.json, "extensionsUsed");
    const bool webp =
        std::any_of(used.begin(), used.end(), [](auto& name) { return name.string() == "EXT_texture_webp"; });
    for (std::size_t i = 0; i < file.model.images.size(); ++i) {
        const Value& image = file.item("images", i);
        const bool hasUri = image.find("uri") != nullptr, hasView = image.find("bufferView") != nullptr;
        if (hasUri == hasView)
            file.fault(
                "images", i,
                fmt::format("it has {} 'uri' {} 'bufferView'", hasUri ? "both" : "neither", hasUri ? "and" : "nor"));
        if (hasView && !image.find("mimeType")) file.fault("images", i, "'mimeType' is missing");
        const auto header = readPictureHeader(file.model.images[i].bytes);
        if (!header) continue;  // told when it is decoded
        const char* actual = typeOf(header->kind);
        const std::string declared = textOr(image, "mimeType", actual);
        if (declared != actual)
            file.fault("images", i,
                       fmt::format("'mimeType' says {}, the picture is {}", declared.substr(0, 80), actual));
        if (header->kind == PictureKind::WebP && !webp)
            file.fault("images", i, "it is WebP, but 'EXT_texture_webp' is not in 'extensionsUsed'");
    }
}

void checkCameras(const File& file) {
    const auto& cameras = listIn(file.json, "cameras");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const std::string type = textOr(cameras[i], "type");
        if (type != "perspective" && type != "orthographic") continue;
        const Value* lens = objectIn(&cameras[i], type);
        if (!lens) file.fail("cameras", i, fmt::format("'{}' is missing", type));
        const double near = numberOr(*lens, "znear", 0), far = numberOr(*lens, "zfar", 0);
        if (far > 0 && far <= near)
            file.fail("cameras", i, fmt::format("'znear' {} and 'zfar' {} do not fit", near, far));
        for (const char* key : {"xmag", "ymag"}) {
            if (type != "orthographic") continue;
            const double size = numberOr(*lens, key, 0);
            if (size == 0) file.fault("cameras", i, fmt::format("'{}' is 0", key));
            if (size < 0) file.note(fmt::format("cameras[{}]: '{}' is negative and read as {}", i, key, -size));
        }
        if (cameras[i].find("perspective") && cameras[i].find("orthographic"))
            file.fault("cameras", i, "it has both 'perspective' and 'orthographic'");
    }
}

void checkTargets(const File& file, std::size_t mesh, const PrimitivePart& primitive) {
    for (const AttributeMap& target : primitive.targets)
        for (const auto& [name, accessor] : target) {
            const auto base = primitive.attributes.find(name);
            if (base == primitive.attributes.end()) {
                file.fault("meshes", mesh, fmt::format("a morph target moves '{}', which is not there", name));
                continue;
            }
            const AccessorPart& moved = file.model.accessors[std::size_t(accessor)];
            if (moved.count != file.model.accessors[std::size_t(base->second)].count)
                file.fail("accessors", std::size_t(accessor),
                          fmt::format("'count' is {}, but {} of meshes[{}] has {}", moved.count, name, mesh,
                                      file.model.accessors[std::size_t(base->second)].count));
            if ((name == "POSITION" || name == "NORMAL" || name == "TANGENT") && moved.components() != 3)
                file.fail("accessors", std::size_t(accessor), fmt::format("'type' does not fit a target of {}", name));
        }
}

void checkMode(const File& file, std::size_t mesh, const PrimitivePart& primitive) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return;
    const int accessor = primitive.indices >= 0 ? primitive.indices : position->second;
    const std::size_t count = file.model.accessors[std::size_t(accessor)].count;
    const bool good = primitive.mode == kPoints      ? count > 0
                      : primitive.mode == kLines     ? count % 2 == 0
                      : primitive.mode == kTriangles ? count % 3 == 0
                      : primitive.mode < kTriangles  ? count >= 2
                                                     : count >= 3;
    if (!good)
        file.options.log.note(
            fmt::format("{}: meshes[{}]: {} vertices do not fit mode {}", file.name, mesh, count, primitive.mode));
}

/// The sets of texture coordinates that a material reads, each with a texture that reads it.
using Sets = std::map<int, std::string>;

void collectSets(const Value& object, Sets& sets) {
    for (const Member& member : object.members()) {
        if (!member.value.isObject()) continue;
        if (!member.key.ends_with("Texture")) {
            collectSets(member.value, sets);
            continue;
        }
        const Value* transform = extensionOf(member.value, "KHR_texture_transform");
        const int own = intOr(member.value, "texCoord", 0);
        sets.emplace(transform ? intOr(*transform, "texCoord", own) : own, member.key);
    }
}

// All sets that the material reads must be there, or its textures would show one colour.
void checkTexcoords(const File& file, std::size_t mesh, const PrimitivePart& primitive, const Sets& sets) {
    for (const auto& [set, texture] : sets)
        if (!primitive.attributes.contains(fmt::format("TEXCOORD_{}", set)))
            file.fault("meshes", mesh,
                       fmt::format("'{}' of its material reads TEXCOORD_{}, which is not there", texture, set));
}

std::vector<Sets> setsOfMaterials(const File& file) {
    std::vector<Sets> all;
    for (const Value& material : listIn(file.json, "materials")) collectSets(material, all.emplace_back());
    return all;
}

void checkMeshes(const File& file) {
    const std::vector<Sets> sets = setsOfMaterials(file);
    for (std::size_t i = 0; i < file.model.meshes.size(); ++i) {
        const MeshPart& mesh = file.model.meshes[i];
        for (const PrimitivePart& primitive : mesh.primitives) {
            checkTargets(file, i, primitive);
            checkMode(file, i, primitive);
            if (primitive.targets.size() != mesh.primitives[0].targets.size())
                file.fail("meshes", i, "its primitives have different numbers of morph targets");
            if (primitive.material >= 0) checkTexcoords(file, i, primitive, sets[std::size_t(primitive.material)]);
        }
        if (!mesh.weights.empty() && !mesh.primitives.empty() &&
            mesh.weights.size() != mesh.primitives[0].targets.size())
            file.fail("meshes", i,
                      fmt::format("it has {} weights for {} morph targets", mesh.weights.size(),
                                  mesh.primitives[0].targets.size()));
    }
}

// A matrix that turns and stretches only: its axes stay at right angles. Sheared ones are drawn as they are.
bool isDecomposable(const glm::mat4& m) {
    const glm::vec3 x(m[0]), y(m[1]), z(m[2]);
    const float lengths = glm::length(x) * glm::length(y) + glm::length(y) * glm::length(z) + 1e-20f;
    const float skew = std::abs(glm::dot(x, y)) + std::abs(glm::dot(y, z)) + std::abs(glm::dot(z, x));
    return skew <= 1e-3f * lengths && m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
}

void checkNode(const File& file, std::size_t index, const NodePart& node) {
    const Value& item = file.item("nodes", index);
    const bool parts = item.find("translation") || item.find("rotation") || item.find("scale");
    if (node.matrix && parts) file.fail("nodes", index, "it has both 'matrix' and translation, rotation or scale");
    if (node.matrix && (node.matrix->operator[](0)[3] != 0 || (*node.matrix)[1][3] != 0 || (*node.matrix)[2][3] != 0 ||
                        (*node.matrix)[3][3] != 1))
        file.fail("nodes", index, "the last row of its 'matrix' is not 0 0 0 1");
    if (node.matrix && !isDecomposable(*node.matrix)) file.fault("nodes", index, "its 'matrix' shears");
    if (std::abs(glm::length(node.rotation) - 1) > 5e-4f)
        file.fault("nodes", index, "its 'rotation' is not of unit length");
    if (node.mesh < 0) {
        if (node.skin >= 0 || !node.weights.empty()) file.fault("nodes", index, "'skin' and 'weights' need a 'mesh'");
        return;
    }
    const auto& primitives = file.model.meshes[std::size_t(node.mesh)].primitives;
    const std::size_t targets = primitives.empty() ? 0 : primitives[0].targets.size();
    if (!node.weights.empty() && node.weights.size() != targets)
        file.fail("nodes", index, fmt::format("it has {} weights for {} morph targets", node.weights.size(), targets));
    if (node.skin >= 0 && !file.model.meshes[std::size_t(node.mesh)].jointed)
        file.fault("nodes", index, "it has a 'skin' but its mesh has no joints");
}

// Each node has at most one parent, no node is its own ancestor, scenes begin at roots.
void checkTrees(const File& file) {
    const std::size_t count = file.model.nodes.size();
    std::vector<int> parent(count, -1);
    for (std::size_t i = 0; i < count; ++i)
        for (const int child : file.model.nodes[i].children) {
            if (parent[std::size_t(child)] >= 0 || std::size_t(child) == i)
                file.fail("nodes", std::size_t(child), "it has two parents or is its own ancestor",
                          "a node may have one parent");
            parent[std::size_t(child)] = int(i);
        }
    std::vector<char> safe(count, 0);  // leads to a root
    for (std::size_t i = 0; i < count; ++i) {
        std::vector<std::size_t> path;
        std::size_t at = i;
        while (!safe[at]) {
            path.push_back(at);
            if (path.size() > count)
                file.fail("nodes", i, "it has two parents or is its own ancestor", "a node may have one parent");
            if (parent[at] < 0) break;
            at = std::size_t(parent[at]);
        }
        for (const std::size_t node : path) safe[node] = 1;
    }
    const auto& scenes = listIn(file.json, "scenes");
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        std::set<int> roots;
        for (const Value& node : listIn(scenes[i], "nodes")) {
            if (parent[std::size_t(node.number())] >= 0)
                file.fail("scenes", i, fmt::format("nodes[{}] is not a root: it has a parent", node.number()));
            if (!roots.insert(int(node.number())).second)
                file.fail("scenes", i, fmt::format("nodes[{}] is named twice", node.number()));
        }
    }
}

}  // namespace

void checkRules(const File& file) {
    checkBufferViews(file);
    checkImages(file);
    checkCameras(file);
    checkMeshes(file);
    for (std::size_t i = 0; i < file.model.nodes.size(); ++i) checkNode(file, i, file.model.nodes[i]);
    checkTrees(file);
}

}  // namespace crevice::gltf
