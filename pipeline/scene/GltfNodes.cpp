// The glTF node tree, flattened: every mesh, light and camera in world space.
#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "core/Text.h"
#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

bool allFinite(const glm::mat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

template <class T>
T posed(const std::map<int, T>& moved, int node, const T& rest) {
    const auto entry = moved.find(node);
    return entry == moved.end() ? rest : entry->second;
}

glm::mat4 composed(const glm::vec3& translation, const glm::quat& rotation, const glm::vec3& scale) {
    const glm::quat turn = glm::length(rotation) > 0 ? glm::normalize(rotation) : glm::quat(1, 0, 0, 0);
    return glm::scale(glm::translate(glm::mat4(1), translation) * glm::mat4_cast(turn), scale);
}

glm::mat4 localMatrix(const File& file, int index, const Pose& pose) {
    const NodePart& node = file.model.nodes[std::size_t(index)];
    const bool moved =
        pose.translations.contains(index) || pose.rotations.contains(index) || pose.scales.contains(index);
    const glm::mat4 matrix = node.matrix && !moved ? *node.matrix
                                                   : composed(posed(pose.translations, index, node.translation),
                                                              posed(pose.rotations, index, node.rotation),
                                                              posed(pose.scales, index, node.scale));
    if (!allFinite(matrix)) file.fail("nodes", std::size_t(index), "its matrix has a number that is not finite");
    return matrix;
}

// The default scene; else the first; else every node without a parent.
std::vector<int> rootNodes(const File& file) {
    const auto& scenes = listIn(file.json, "scenes");
    std::vector<int> roots;
    if (scenes.empty()) {
        if (!file.options.scene.empty()) findNamed(file, "scenes", "scene", file.options.scene);  // throws
        std::vector<bool> isChild(file.model.nodes.size(), false);
        for (const NodePart& node : file.model.nodes)
            for (const int child : node.children) isChild[std::size_t(child)] = true;
        for (std::size_t i = 0; i < isChild.size(); ++i)
            if (!isChild[i]) roots.push_back(int(i));
        return roots;
    }
    const int scene = file.options.scene.empty() ? intOr(file.json, "scene", 0)
                                                 : findNamed(file, "scenes", "scene", file.options.scene);
    for (const Value& node : listIn(scenes[std::size_t(scene)], "nodes")) roots.push_back(int(node.number()));
    return roots;
}

/// Builds the parts of a scene out of placed nodes.
class Builder {
public:
    Builder(const File& file, Meshes& meshes, Scene& scene)
        : file_(file), meshes_(meshes), scene_(scene), pose_(readPose(file)) {}

    void build() {
        const std::vector<Placed> placed = placeNodes(file_, pose_);
        for (const Placed& node : placed) world_[node.node] = node.world;
        meshes_.expect(wantedMeshes(placed));
        for (const Placed& node : placed) {
            const NodePart& from = file_.model.nodes[std::size_t(node.node)];
            if (from.mesh >= 0 && node.visible) addMesh(node, from);
            if (from.camera >= 0)
                if (auto camera = readCamera(file_, from.camera, node.world, nameOf(from, "camera", node.node)))
                    scene_.cameras.push_back(std::move(*camera));
            if (from.light >= 0 && node.visible)
                scene_.lights.push_back(readLight(file_, from.light, node.world, nameOf(from, "light", node.node)));
        }
        const std::size_t cameras = listIn(file_.json, "cameras").size();
        if (scene_.cameras.empty() && cameras > 0)
            file_.note(fmt::format("{} cameras are defined but no node of the scene holds one", cameras));
    }

private:
    static std::string nameOf(const NodePart& node, const char* kind, int index) {
        return node.name.empty() ? fmt::format("{} {}", kind, index) : node.name;
    }

    // As addMesh() will ask for them; joints are not known yet and do not tell meshes apart.
    std::vector<std::pair<int, Deformation>> wantedMeshes(const std::vector<Placed>& placed) const {
        std::vector<std::pair<int, Deformation>> wanted;
        for (const Placed& node : placed) {
            const NodePart& from = file_.model.nodes[std::size_t(node.node)];
            if (from.mesh >= 0 && node.visible) wanted.emplace_back(from.mesh, deformationOf(node.node, from));
        }
        return wanted;
    }

    Deformation deformationOf(int node, const NodePart& from) const {
        return {.skin = from.skin, .weights = posed(pose_.weights, node, from.weights)};
    }

    /// The joints' matrices in world space, and whether most of them mirror.
    struct Joints {
        std::vector<glm::mat4> matrices{};
        bool mirror = false;
    };

    // Each skin's once, whatever number of nodes share it. Joints that the scene does not hold stand where they would
    // alone.
    const Joints& jointsOf(int index) {
        const auto [entry, isNew] = joints_.try_emplace(index);
        if (!isNew) return entry->second;
        const Value& skin = file_.item("skins", std::size_t(index));
        const auto& joints = listIn(skin, "joints");
        const int accessor = intOr(skin, "inverseBindMatrices");
        const Floats inverse = accessor >= 0 ? readSomeFloats(file_, accessor, 0, joints.size()) : Floats{};
        file_.work.jointMatrices += joints.size();
        std::size_t mirrored = 0;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            glm::mat4 bind(1);
            for (int k = 0; k < 16 && inverse.components; ++k) bind[k / 4][k % 4] = inverse.at(i)[k];
            const int joint = int(joints[i].number());
            const auto world = world_.find(joint);
            const glm::mat4 matrix = (world == world_.end() ? localMatrix(file_, joint, pose_) : world->second) * bind;
            mirrored += glm::determinant(glm::mat3(matrix)) < 0;
            entry->second.matrices.push_back(matrix);
        }
        entry->second.mirror = mirrored * 2 > joints.size();
        return entry->second;
    }

    void addMesh(const Placed& node, const NodePart& from) {
        Deformation deformation = deformationOf(node.node, from);
        const Joints none;
        const Joints& joints = from.skin >= 0 ? jointsOf(from.skin) : none;
        deformation.joints = joints.matrices;
        // A skinned mesh stands where its joints are; its own node's place does not count.
        const bool skinned = !joints.matrices.empty() && file_.model.meshes[std::size_t(from.mesh)].jointed;
        const glm::mat4 world = skinned ? glm::mat4(1) : node.world;
        const bool mirrors = skinned && joints.mirror;
        for (const Part& part : meshes_.parts(from.mesh, deformation)) {
            const int material = materialOf(part);
            if (from.instancing.empty()) {
                addInstance(node, part.mesh, material, world, mirrors);
                continue;
            }
            for (const glm::mat4& copy : readInstancing(file_, from, node.node))
                addInstance(node, part.mesh, material, world * copy, mirrors);
        }
    }

    void addInstance(const Placed& node, int mesh, int material, const glm::mat4& world, bool mirrors) {
        if (scene_.instances.size() >= file_.options.limits.maxInstances)
            file_.fail("nodes", std::size_t(node.node),
                       fmt::format("the scene has more than {} instances", file_.options.limits.maxInstances),
                       raiseLimit("instances"));
        scene_.instances.push_back({.mesh = mesh,
                                    .material = material,
                                    .world = world,
                                    .name = nameOf(file_.model.nodes[std::size_t(node.node)], "node", node.node),
                                    .flipped = (glm::determinant(glm::mat3(world)) < 0) != mirrors,
                                    .sourceMesh = file_.model.nodes[std::size_t(node.node)].mesh});
    }

    // The material itself, or a copy for points and lines that are shaded in another way.
    int materialOf(const Part& part) {
        const int material = part.material >= 0 ? part.material : defaultMaterial();
        if (!part.unlit && !(part.noMap && scene_.materials[std::size_t(material)].normalMap)) return material;
        const auto [entry, isNew] = variants_.try_emplace({material, part.unlit}, int(scene_.materials.size()));
        if (isNew) {
            SceneMaterial copy = scene_.materials[std::size_t(material)];
            copy.normalMap = {};
            if (part.unlit) {
                copy.unlit = true;
                copy.metallicRoughnessMap = copy.occlusionMap = {};
            }
            scene_.materials.push_back(std::move(copy));
        }
        return entry->second;
    }

    // That of the specification (3.7.2.1, 3.9): every property has its default, as `{}` has.
    int defaultMaterial() {
        if (defaultMaterial_ < 0) {
            defaultMaterial_ = int(scene_.materials.size());
            SceneMaterial material;
            material.name = "default material";
            scene_.materials.push_back(material);
        }
        return defaultMaterial_;
    }

    const File& file_;
    Meshes& meshes_;
    Scene& scene_;
    Pose pose_;
    std::map<int, glm::mat4> world_;  ///< Of glTF nodes in the scene
    std::map<int, Joints> joints_;    ///< Of skins
    std::map<std::pair<int, bool>, int> variants_;
    int defaultMaterial_ = -1;
};

}  // namespace

int findNamed(const File& file, const char* list, const char* option, const std::string& wanted) {
    const auto& items = listIn(file.json, list);
    std::vector<std::string> listed;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const std::string name = textOr(items[i], "name");
        if (name == wanted) return int(i);
        listed.push_back(name.empty() ? std::to_string(i) : fmt::format("{} '{}'", i, name));
    }
    std::size_t index = 0;
    const char* last = wanted.data() + wanted.size();
    const auto [end, failed] = std::from_chars(wanted.data(), last, index);
    if (failed == std::errc() && end == last && index < items.size()) return int(index);
    throw Error(SourceLoc{file.name}, fmt::format("the file has no {} '{}'", option, wanted),
                items.empty() ? fmt::format("it has no {} at all", list) : fmt::format("{}: {}", list, join(listed)));
}

// Every node is entered once: that rules out cycles.
std::vector<Placed> placeNodes(const File& file, const Pose& pose) {
    std::vector<bool> seen(file.model.nodes.size(), false);
    std::vector<Placed> placed, stack;
    const auto push = [&](const std::vector<int>& nodes, const Placed& parent) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
            stack.push_back({*node, parent.depth + 1, parent.world, parent.visible});
    };
    push(rootNodes(file), {});
    while (!stack.empty()) {
        Placed next = stack.back();
        stack.pop_back();
        const std::size_t node = std::size_t(next.node);
        if (seen[node])
            file.fail("nodes", node, "it has two parents or is its own ancestor", "a node may have one parent");
        seen[node] = true;
        if (next.depth > file.options.limits.maxNodeDepth)
            file.fail("nodes", node, fmt::format("it is nested deeper than {}", file.options.limits.maxNodeDepth),
                      raiseLimit("node-depth"));
        next.world = next.world * localMatrix(file, next.node, pose);
        if (!allFinite(next.world)) file.fail("nodes", node, "its place in the world is not finite");
        next.visible = next.visible && file.model.nodes[node].visible;
        push(file.model.nodes[node].children, next);
        placed.push_back(next);
    }
    return placed;
}

std::vector<glm::mat4> readInstancing(const File& file, const NodePart& node, int index) {
    std::size_t count = 0;
    const auto read = [&](const char* name, int components) -> Floats {
        const auto entry = node.instancing.find(name);
        if (entry == node.instancing.end()) return {};
        const AccessorPart& accessor = file.model.accessors[std::size_t(entry->second)];
        if (accessor.components() != components || (count && accessor.count != count))
            file.fail("nodes", std::size_t(index),
                      fmt::format("EXT_mesh_gpu_instancing: type or count of '{}' does not fit", name));
        count = accessor.count;
        if (count > file.options.limits.maxInstances)
            file.fail("nodes", std::size_t(index),
                      fmt::format("the scene has more than {} instances", file.options.limits.maxInstances),
                      raiseLimit("instances"));
        return readFloats(file, entry->second);
    };
    const Floats translation = read("TRANSLATION", 3), rotation = read("ROTATION", 4), scale = read("SCALE", 3);
    std::vector<glm::mat4> copies;
    for (std::size_t i = 0; i < count; ++i) {
        const auto vector = [&](const Floats& from, const glm::vec3& otherwise) {
            return from.components ? glm::vec3(from.at(i)[0], from.at(i)[1], from.at(i)[2]) : otherwise;
        };
        const float* q = rotation.components ? rotation.at(i) : nullptr;
        copies.push_back(composed(vector(translation, glm::vec3(0)),
                                  q ? glm::quat(q[3], q[0], q[1], q[2]) : glm::quat(1, 0, 0, 0),
                                  vector(scale, glm::vec3(1))));
    }
    return copies;
}

void readNodes(const File& file, Meshes& meshes, Scene& scene) { Builder(file, meshes, scene).build(); }

}  // namespace crevice::gltf
