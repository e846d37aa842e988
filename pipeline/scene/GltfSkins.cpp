// Skins as the format wants them: joints of one tree, in every scene that shows what they bend.
#include <algorithm>

#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

/// Parents of all nodes; checkRules() made sure that there are no cycles.
std::vector<int> parentsOf(const File& file) {
    std::vector<int> parents(file.model.nodes.size(), -1);
    for (std::size_t i = 0; i < parents.size(); ++i)
        for (const int child : file.model.nodes[i].children) parents[std::size_t(child)] = int(i);
    return parents;
}

int rootOf(const std::vector<int>& parents, int node) {
    while (parents[std::size_t(node)] >= 0) node = parents[std::size_t(node)];
    return node;
}

bool isAbove(const std::vector<int>& parents, int ancestor, int node) {
    while (node >= 0 && node != ancestor) node = parents[std::size_t(node)];
    return node == ancestor;
}

std::vector<int> jointsOf(const Value& skin) {
    std::vector<int> joints;
    for (const Value& joint : listIn(skin, "joints")) joints.push_back(int(joint.number()));
    return joints;
}

void checkMatrices(const File& file, std::size_t index, int accessor, std::size_t jointCount) {
    const AccessorPart& matrices = file.model.accessors[std::size_t(accessor)];
    if (matrices.components() != 16 || matrices.componentType != kFloat || matrices.count < jointCount)
        file.fail("skins", index, "'inverseBindMatrices' is not one 4x4 matrix of floats per joint");
}

void checkSkin(const File& file, std::size_t index, const std::vector<int>& parents) {
    const Value& skin = file.item("skins", index);
    const std::vector<int> joints = jointsOf(skin);
    if (std::set<int>(joints.begin(), joints.end()).size() != joints.size())
        file.fault("skins", index, "a joint is named twice");
    if (const int accessor = intOr(skin, "inverseBindMatrices"); accessor >= 0)
        checkMatrices(file, index, accessor, joints.size());
    if (joints.empty()) return;
    const int root = rootOf(parents, joints[0]);
    for (const int joint : joints)
        if (rootOf(parents, joint) != root)
            return file.fault("skins", index,
                              fmt::format("nodes[{}] and nodes[{}] have no common root", joints[0], joint));
    const int skeleton = intOr(skin, "skeleton");
    for (const int joint : joints)
        if (skeleton >= 0 && !isAbove(parents, skeleton, joint))
            return file.fault("skins", index, fmt::format("'skeleton' is not above the joint nodes[{}]", joint));
}

// A skinned mesh stands where its joints are, so the scene that shows it must hold them.
void checkScenes(const File& file, const std::vector<int>& parents) {
    std::map<int, std::set<int>> skinsOfRoots;
    for (std::size_t i = 0; i < parents.size(); ++i) {
        const NodePart& node = file.model.nodes[i];
        if (node.skin >= 0 && node.mesh >= 0) skinsOfRoots[rootOf(parents, int(i))].insert(node.skin);
    }
    if (skinsOfRoots.empty()) return;
    const auto& scenes = listIn(file.json, "scenes");
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        std::set<int> roots, skins;
        for (const Value& node : listIn(scenes[i], "nodes")) roots.insert(int(node.number()));
        for (const int root : roots)
            if (const auto found = skinsOfRoots.find(root); found != skinsOfRoots.end())
                skins.insert(found->second.begin(), found->second.end());
        for (const int skin : skins)
            for (const int joint : jointsOf(file.item("skins", std::size_t(skin))))
                if (!roots.contains(rootOf(parents, joint))) {
                    file.fault("scenes", i, fmt::format("it shows a mesh of skins[{}], but not its joints", skin));
                    break;
                }
    }
}

}  // namespace

void checkSkins(const File& file) {
    const std::size_t count = listIn(file.json, "skins").size();
    if (count == 0) return;
    const std::vector<int> parents = parentsOf(file);
    for (std::size_t i = 0; i < count; ++i) checkSkin(file, i, parents);
    checkScenes(file, parents);
}

}  // namespace crevice::gltf
