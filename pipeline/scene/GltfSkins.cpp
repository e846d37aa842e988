// Skins as the format wants them: joints of one tree, in every scene that shows what they bend.
#include <algorithm>

#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

/// Trees that are looked for in scenes, over all of them: scenes may show the same hundreds of skins again and again.
/// With --strict files of more are refused, as File::spend() does.
constexpr std::size_t kMostLooks = 10'000'000;

/// The trees of all nodes, walked once: chains of a million nodes with as many joints are asked about in no time.
/// checkRules() made sure that there are no cycles and that each node has one parent.
class Trees {
public:
    explicit Trees(const File& file)
        : work_(file.work), roots_(file.model.nodes.size(), -1), first_(roots_.size(), 0), behind_(roots_.size(), 0) {
        std::vector<char> isChild(roots_.size(), 0);
        for (const NodePart& node : file.model.nodes)
            for (const int child : node.children) isChild[std::size_t(child)] = 1;
        for (std::size_t i = 0; i < roots_.size(); ++i)
            if (!isChild[i]) walk(file.model.nodes, int(i));
    }

    int rootOf(int node) const {
        ++work_.treeSteps;
        return roots_[std::size_t(node)];
    }
    /// `ancestor` is above `node`, or the same.
    bool isAbove(int ancestor, int node) const {
        ++work_.treeSteps;
        const int at = first_[std::size_t(node)];
        return first_[std::size_t(ancestor)] <= at && at < behind_[std::size_t(ancestor)];
    }

private:
    // Numbers the nodes, parents first: those below a node follow it without a gap.
    void walk(const std::vector<NodePart>& nodes, int root) {
        std::vector<int> stack{root};
        while (!stack.empty()) {
            ++work_.treeSteps;
            const std::size_t node = std::size_t(stack.back());
            if (roots_[node] >= 0) {  // all below it have their numbers
                behind_[node] = next_;
                stack.pop_back();
                continue;
            }
            roots_[node] = root;
            first_[node] = next_++;
            stack.insert(stack.end(), nodes[node].children.begin(), nodes[node].children.end());
        }
    }

    WorkDone& work_;
    std::vector<int> roots_, first_, behind_;
    int next_ = 0;
};

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

void checkSkin(const File& file, std::size_t index, const Trees& trees) {
    const Value& skin = file.item("skins", index);
    const std::vector<int> joints = jointsOf(skin);
    if (std::set<int>(joints.begin(), joints.end()).size() != joints.size())
        file.fault("skins", index, "a joint is named twice");
    if (const int accessor = intOr(skin, "inverseBindMatrices"); accessor >= 0)
        checkMatrices(file, index, accessor, joints.size());
    if (joints.empty()) return;
    const int root = trees.rootOf(joints[0]);
    for (const int joint : joints)
        if (trees.rootOf(joint) != root)
            return file.fault("skins", index,
                              fmt::format("nodes[{}] and nodes[{}] have no common root", joints[0], joint));
    const int skeleton = intOr(skin, "skeleton");
    for (const int joint : joints)
        if (skeleton >= 0 && !trees.isAbove(skeleton, joint))
            return file.fault("skins", index, fmt::format("'skeleton' is not above the joint nodes[{}]", joint));
}

/// The root of a skin's joints, or -1. They have one, or checkSkin() told it.
std::vector<int> rootsOfSkins(const File& file, const Trees& trees) {
    std::vector<int> roots;
    for (const Value& skin : listIn(file.json, "skins")) {
        const auto& joints = listIn(skin, "joints");
        roots.push_back(joints.empty() ? -1 : trees.rootOf(int(joints[0].number())));
    }
    return roots;
}

// A skinned mesh stands where its joints are, so the scene that shows it must hold them.
void checkScenes(const File& file, const Trees& trees) {
    const std::vector<int> rootsOf = rootsOfSkins(file, trees);
    std::map<int, std::map<int, int>> wanted;  // of a tree: the other trees that its skins need, and one such skin
    for (std::size_t i = 0; i < file.model.nodes.size(); ++i) {
        const NodePart& node = file.model.nodes[i];
        if (node.skin < 0 || node.mesh < 0) continue;
        const int own = trees.rootOf(int(i)), joints = rootsOf[std::size_t(node.skin)];
        if (joints >= 0 && joints != own) wanted[own].emplace(joints, node.skin);
    }
    if (wanted.empty()) return;
    const auto& scenes = listIn(file.json, "scenes");
    std::vector<std::size_t> lastScene(file.model.nodes.size(), scenes.size());  // that shows a node
    std::size_t looks = kMostLooks;
    for (std::size_t i = 0; i < scenes.size() && looks > 0; ++i) {
        const auto& roots = listIn(scenes[i], "nodes");
        for (const Value& root : roots) lastScene[std::size_t(root.number())] = i;
        const auto findMissing = [&]() -> int {
            for (const Value& root : roots)
                if (const auto found = wanted.find(int(root.number())); found != wanted.end())
                    for (const auto& [tree, skin] : found->second) {
                        if (lastScene[std::size_t(tree)] != i) return skin;
                        if (--looks == 0) return -1;
                    }
            return -1;
        };
        if (const int skin = findMissing(); skin >= 0)
            file.fault("scenes", i, fmt::format("it shows a mesh of skins[{}], but not its joints", skin));
    }
    if (looks == 0 && file.options.strict)
        throw Error(SourceLoc{file.name},
                    fmt::format("its scenes show skins so often that their joints are looked for more than {} times",
                                kMostLooks),
                    "leave --strict out: it looks for all of them");
}

}  // namespace

void checkSkins(const File& file) {
    const std::size_t count = listIn(file.json, "skins").size();
    if (count == 0) return;
    const Trees trees(file);
    for (std::size_t i = 0; i < count; ++i) checkSkin(file, i, trees);
    checkScenes(file, trees);
}

}  // namespace crevice::gltf
