// The glTF node tree, flattened: every mesh, light and camera in world space.
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

bool allFinite(const glm::mat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

glm::mat4 localMatrix(const File& file, std::size_t index) {
    const tinygltf::Node& node = file.model.nodes[index];
    const auto at = [](const std::vector<double>& values, std::size_t i) { return static_cast<float>(values[i]); };
    const auto check = [&](const char* key, const std::vector<double>& values, std::size_t count) {
        if (!values.empty() && values.size() != count)
            file.fail("nodes", index, fmt::format("'{}' has {} numbers, not {}", key, values.size(), count));
        return !values.empty();
    };
    glm::mat4 matrix(1);
    if (check("matrix", node.matrix, 16)) {
        for (std::size_t i = 0; i < 16; ++i) matrix[int(i / 4)][int(i % 4)] = at(node.matrix, i);
    } else {
        if (check("translation", node.translation, 3))
            matrix =
                glm::translate(matrix, {at(node.translation, 0), at(node.translation, 1), at(node.translation, 2)});
        if (check("rotation", node.rotation, 4)) {
            const glm::quat q(at(node.rotation, 3), at(node.rotation, 0), at(node.rotation, 1), at(node.rotation, 2));
            matrix *= glm::mat4_cast(glm::length(q) > 0 ? glm::normalize(q) : glm::quat(1, 0, 0, 0));
        }
        if (check("scale", node.scale, 3))
            matrix = glm::scale(matrix, {at(node.scale, 0), at(node.scale, 1), at(node.scale, 2)});
    }
    if (!allFinite(matrix)) file.fail("nodes", index, "its matrix has a number that is not finite");
    return matrix;
}

/// A node in its place.
struct Placed {
    std::size_t node = 0;
    int depth = 0;
    glm::mat4 world{1};
};

std::vector<int> rootNodes(const File& file) {
    const auto& model = file.model;
    if (!model.scenes.empty()) {
        const int scene = std::max(model.defaultScene, 0);
        if (std::size_t(scene) >= model.scenes.size())
            throw Error(file.binary ? SourceLoc{file.name} : file.json.find("scene")->where(),
                        fmt::format("'scene' is {}, the file has {}", scene, model.scenes.size()),
                        "scenes count from 0");
        return model.scenes[scene].nodes;
    }
    // A library of nodes without a scene: show every node that is nobody's child.
    std::vector<bool> isChild(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children)
            if (child >= 0 && std::size_t(child) < isChild.size()) isChild[child] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < isChild.size(); ++i)
        if (!isChild[i]) roots.push_back(int(i));
    return roots;
}

// Parents before children, children in their order. Every node is entered once: that rules out cycles.
std::vector<Placed> flatten(const File& file) {
    const std::size_t count = file.model.nodes.size();
    std::vector<bool> seen(count, false);
    std::vector<Placed> placed, stack;
    const auto push = [&](const std::vector<int>& nodes, const glm::mat4& parent, int depth, const SourceLoc& where) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
            if (*node < 0 || std::size_t(*node) >= count)
                throw Error(where, fmt::format("nodes[{}] is named, the file has {}", *node, count),
                            "nodes count from 0");
            stack.push_back({std::size_t(*node), depth, parent});
        }
    };
    push(rootNodes(file), glm::mat4(1), 1, file.where("scenes", std::size_t(std::max(file.model.defaultScene, 0))));
    while (!stack.empty()) {
        Placed next = stack.back();
        stack.pop_back();
        if (seen[next.node])
            file.fail("nodes", next.node, "it has two parents or is its own ancestor", "a node may have one parent");
        seen[next.node] = true;
        if (next.depth > file.options.limits.maxNodeDepth)
            file.fail("nodes", next.node, fmt::format("it is nested deeper than {}", file.options.limits.maxNodeDepth));
        next.world = next.world * localMatrix(file, next.node);
        if (!allFinite(next.world)) file.fail("nodes", next.node, "its place in the world is not finite");
        push(file.model.nodes[next.node].children, next.world, next.depth + 1, file.where("nodes", next.node));
        placed.push_back(next);
    }
    return placed;
}

/// Builds the parts of a scene out of placed nodes.
class Builder {
public:
    Builder(const File& file, Meshes& meshes, Scene& scene) : file_(file), meshes_(meshes), scene_(scene) {}

    void build() {
        const std::vector<Placed> placed = flatten(file_);
        world_.assign(file_.model.nodes.size(), glm::mat4(1));
        for (const Placed& node : placed) world_[node.node] = node.world;
        for (const Placed& node : placed) {
            const tinygltf::Node& from = file_.model.nodes[node.node];
            if (from.mesh >= 0) addMesh(node);
            if (from.camera >= 0) addCamera(node);
            if (from.extensions.contains("KHR_lights_punctual")) addLight(node);
        }
        if (scene_.cameras.empty() && !file_.model.cameras.empty())
            file_.note(
                fmt::format("{} cameras are defined but no node of the scene holds one", file_.model.cameras.size()));
    }

private:
    std::string nameOf(const Placed& node, const char* kind) const {
        const std::string& name = file_.model.nodes[node.node].name;
        return name.empty() ? fmt::format("{} {}", kind, node.node) : name;
    }

    // Joint matrices in world space: the pose in which the file rests.
    std::vector<glm::mat4> jointMatrices(int index) const {
        const tinygltf::Skin& skin = file_.model.skins[index];
        Floats inverse;
        if (skin.inverseBindMatrices >= 0) {
            if (std::size_t(skin.inverseBindMatrices) >= file_.model.accessors.size())
                file_.fail("skins", index,
                           fmt::format("'inverseBindMatrices' names accessors[{}], the file has {}",
                                       skin.inverseBindMatrices, file_.model.accessors.size()));
            inverse = readFloats(file_, skin.inverseBindMatrices);
            if (inverse.components != 16 || inverse.count() < skin.joints.size())
                file_.fail("skins", index, "'inverseBindMatrices' is not one 4x4 matrix per joint");
        }
        std::vector<glm::mat4> joints;
        for (std::size_t i = 0; i < skin.joints.size(); ++i) {
            if (skin.joints[i] < 0 || std::size_t(skin.joints[i]) >= world_.size())
                file_.fail("skins", index, fmt::format("joint nodes[{}] does not exist", skin.joints[i]));
            glm::mat4 bind(1);
            for (int k = 0; k < 16 && inverse.components; ++k) bind[k / 4][k % 4] = inverse.values[i * 16 + k];
            joints.push_back(world_[skin.joints[i]] * bind);
        }
        return joints;
    }

    void addMesh(const Placed& node) {
        const tinygltf::Node& from = file_.model.nodes[node.node];
        if (std::size_t(from.mesh) >= file_.model.meshes.size())
            file_.fail("nodes", node.node,
                       fmt::format("'mesh' is {}, the file has {}", from.mesh, file_.model.meshes.size()));
        if (from.skin >= int(file_.model.skins.size()))
            file_.fail("nodes", node.node,
                       fmt::format("'skin' is {}, the file has {}", from.skin, file_.model.skins.size()));
        // A skinned mesh stands where its joints are; its own node's place does not count.
        const bool skinned = from.skin >= 0;
        const std::vector<glm::mat4> joints = skinned ? jointMatrices(from.skin) : std::vector<glm::mat4>{};
        const glm::mat4 world = skinned ? glm::mat4(1) : node.world;
        for (const Part& part : meshes_.parts(from.mesh, skinned ? from.skin : -1, joints)) {
            if (scene_.instances.size() >= file_.options.limits.maxInstances)
                file_.fail("nodes", node.node,
                           fmt::format("the scene has more than {} instances", file_.options.limits.maxInstances));
            scene_.instances.push_back({.mesh = part.mesh,
                                        .material = part.material >= 0 ? part.material : defaultMaterial(),
                                        .world = world,
                                        .name = nameOf(node, "node"),
                                        .flipped = glm::determinant(glm::mat3(world)) < 0,
                                        .sourceMesh = from.mesh});
        }
    }

    // Not metallic as the specification's default is: without an environment that would be black.
    int defaultMaterial() {
        if (defaultMaterial_ < 0) {
            defaultMaterial_ = int(scene_.materials.size());
            SceneMaterial material;
            material.name = "default material";
            material.metallic = 0;
            scene_.materials.push_back(material);
        }
        return defaultMaterial_;
    }

    void addCamera(const Placed& node) {
        const int index = file_.model.nodes[node.node].camera;
        if (std::size_t(index) >= file_.model.cameras.size())
            file_.fail("nodes", node.node,
                       fmt::format("'camera' is {}, the file has {}", index, file_.model.cameras.size()));
        const tinygltf::Camera& from = file_.model.cameras[index];
        const glm::vec3 eye(node.world[3]), backward(node.world[2]), up(node.world[1]);
        crevice::Camera to = crevice::Camera::lookAt(eye, eye - backward, up);
        to.name = from.name.empty() ? nameOf(node, "camera") : from.name;
        if (from.type == "orthographic") {
            to.orthographic = true;
            to.orthoHeight = static_cast<float>(2 * std::abs(from.orthographic.ymag));
            to.near = static_cast<float>(from.orthographic.znear);
            to.far = static_cast<float>(from.orthographic.zfar);
            if (!(to.orthoHeight > 0)) file_.fail("cameras", index, "'ymag' is 0 or missing");
        } else {
            to.fovY = static_cast<float>(from.perspective.yfov);
            to.near = static_cast<float>(from.perspective.znear);
            to.far = static_cast<float>(from.perspective.zfar);
            if (!(to.fovY > 0 && to.fovY < glm::pi<float>()))
                file_.fail("cameras", index, "'yfov' is not between 0 and pi");
        }
        if (!(to.near >= 0) || !(to.far >= 0) || (to.far > 0 && to.far <= to.near))
            file_.fail("cameras", index, fmt::format("'znear' {} and 'zfar' {} do not fit", to.near, to.far));
        scene_.cameras.push_back(to);
    }

    void addLight(const Placed& node) {
        const tinygltf::Value& reference = file_.model.nodes[node.node].extensions.at("KHR_lights_punctual");
        const int index = reference.Has("light") ? reference.Get("light").GetNumberAsInt() : -1;
        if (index < 0 || std::size_t(index) >= file_.model.lights.size())
            file_.fail(
                "nodes", node.node,
                fmt::format("'KHR_lights_punctual.light' is {}, the file has {}", index, file_.model.lights.size()));
        const tinygltf::Light& from = file_.model.lights[index];
        crevice::Light to;
        if (from.type == "point")
            to.type = LightType::Point;
        else if (from.type == "spot")
            to.type = LightType::Spot;
        else if (from.type != "directional")
            throw Error(
                SourceLoc{file_.name},
                fmt::format("lights[{}]: 'type' is '{}'; it may be directional, point or spot", index, from.type));
        for (std::size_t i = 0; i < 3 && from.color.size() == 3; ++i)
            to.color[int(i)] = static_cast<float>(from.color[i]);
        to.intensity = static_cast<float>(from.intensity);
        to.range = static_cast<float>(from.range);
        to.innerAngle = static_cast<float>(from.spot.innerConeAngle);
        to.outerAngle = static_cast<float>(from.spot.outerConeAngle);
        if (!(to.intensity >= 0) || !(to.range >= 0) || !(to.innerAngle >= 0) ||
            !(to.outerAngle <= glm::half_pi<float>() + 1e-4f) ||
            (to.type == LightType::Spot && !(to.innerAngle < to.outerAngle)))
            throw Error(SourceLoc{file_.name},
                        fmt::format("lights[{}]: intensity, range or cone angles are out of range", index),
                        "KHR_lights_punctual: intensity and range from 0, cone angles 0 <= inner < outer <= pi/2");
        to.position = glm::vec3(node.world[3]);
        const glm::vec3 direction = -glm::vec3(node.world[2]);
        to.direction = glm::length(direction) > 0 ? glm::normalize(direction) : glm::vec3(0, 0, -1);
        to.name = from.name.empty() ? nameOf(node, "light") : from.name;
        scene_.lights.push_back(to);
    }

    const File& file_;
    Meshes& meshes_;
    Scene& scene_;
    std::vector<glm::mat4> world_;  ///< Per glTF node
    int defaultMaterial_ = -1;
};

}  // namespace

void readNodes(const File& file, Meshes& meshes, Scene& scene) { Builder(file, meshes, scene).build(); }

}  // namespace crevice::gltf
