// A fileId is the uuid of a path of names, each with the node's place among its siblings: "suit0/arm1/comp0".
#include "cocos/scene/GltfPrefab.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "cocos/files/NamedUuid.h"
#include "cocos/scene/GltfJson.h"

namespace crevice::cocos {
namespace {

constexpr std::string_view kSpace = "8fa06a75-f07a-44d4-82cf-d08c3c986599";  // of the editor's importer
constexpr DocumentLimits kJsonLimits{.maxBytes = 256u << 20, .maxDepth = 64, .maxNodes = 8'000'000};

const Value* member(const Value* object, const char* key) {
    return object && object->isObject() ? object->find(key) : nullptr;
}

std::vector<int> numbersIn(const Value* list) {
    std::vector<int> numbers;
    if (!list || !list->isArray()) return numbers;
    for (const Value& item : list->items())
        if (item.isInteger() && item.integer() >= 0 && item.integer() < 10'000'000)
            numbers.push_back(int(item.integer()));
    return numbers;
}

std::vector<float> floatsIn(const Value* list, std::size_t count) {
    std::vector<float> floats;
    if (!list || !list->isArray() || list->items().size() != count) return floats;
    for (const Value& item : list->items()) floats.push_back(item.isNumber() ? float(item.number()) : 0.0f);
    return floats;
}

Value typed(const char* type) {
    Value object = Value::makeObject();
    object.set("__type__", Value::makeString(type));
    return object;
}

Value reference(std::size_t id) {
    Value object = Value::makeObject();
    object.set("__id__", Value::makeInteger(std::int64_t(id)));
    return object;
}

Value vector(const char* type, std::initializer_list<float> values) {
    static constexpr const char* kNames[] = {"x", "y", "z", "w"};
    Value object = typed(type);
    std::size_t i = 0;
    for (const float value : values) object.set(kNames[i++], Value::makeNumber(double(value)));
    return object;
}

class Builder {
public:
    Builder(const MetaAsset& asset, const MetaAsset& model, const Value& json, const Limits& limits)
        : asset_(asset), model_(model), json_(json), limits_(limits) {
        if (const Value* nodes = member(&json_, "nodes"); nodes && nodes->isArray())
            for (const Value& node : nodes->items()) nodes_.push_back(&node);
        for (std::size_t i = 0; i < nodes_.size(); ++i) names_.push_back(nameOf(i));
        for (const Value* node : nodes_) makeUnique(numbersIn(member(node, "children")));
        entered_.resize(nodes_.size());
    }

    GltfPrefab build() {
        objects_ = {typed("cc.Prefab"), typed("cc.Node")};
        objects_[0].set("data", reference(1));
        const std::vector<int> roots = rootNodes();
        const Value* promote = member(&model_.userData, "promoteSingleRootNode");
        if (promote && promote->isBool() && promote->boolean() && isPromoted(roots))
            fill(1, std::size_t(roots.front()), rootName(), rootName() + "0", 0);
        else
            finish(1, rootName(), rootName() + "0", roots, {}, 0);
        Value list = Value::makeArray();
        list.items() = std::move(objects_);
        return {ObjectGraph::parse(list.toJson(-1), asset_.path.string(), kJsonLimits), std::move(meshNodes_)};
    }

private:
    std::string nameOf(std::size_t node) const {
        const Value* name = member(nodes_[node], "name");
        return name && name->isString() ? name->string() : fmt::format("Node-{}", node);
    }

    /// Children of one node differ in their names.
    void makeUnique(const std::vector<int>& children) {
        std::vector<std::string> taken;
        for (std::size_t i = 0; i < children.size() && std::size_t(children[i]) < names_.size(); ++i) {
            std::string& name = names_[std::size_t(children[i])];
            const Value* written = member(nodes_[std::size_t(children[i])], "name");
            const std::string original = written && written->isString() ? written->string() : std::string();
            if (original.empty()) name = fmt::format("(__autogen {})", i);
            for (int count = 0; std::find(taken.begin(), taken.end(), name) != taken.end(); ++count)
                name = fmt::format("{}(__autogen {}{})", original, i, count == 0 ? "" : fmt::format("-{}", count));
            taken.push_back(name);
        }
    }

    std::vector<int> rootNodes() const {
        const Value* scenes = member(&json_, "scenes");
        const Value* shown = member(&json_, "scene");
        const std::size_t scene =
            shown && shown->isInteger() && shown->integer() > 0 ? std::size_t(shown->integer()) : 0;
        if (!scenes || !scenes->isArray() || scene >= scenes->items().size()) return {};
        return numbersIn(member(&scenes->items()[scene], "nodes"));
    }

    /// Roots that are joints or move stay below a root of their own.
    bool isPromoted(const std::vector<int>& roots) const {
        if (roots.size() != 1 || std::size_t(roots.front()) >= nodes_.size()) return false;
        const Value *skins = member(&json_, "skins"), *animations = member(&json_, "animations");
        if (skins && skins->isArray())
            for (const Value& skin : skins->items())
                for (const int joint : numbersIn(member(&skin, "joints")))
                    if (joint == roots.front()) return false;
        return !animations || !animations->isArray() || animations->items().empty();
    }

    /// With several scenes in a file each has its own name.
    std::string rootName() const {
        const Value* scenes = member(&json_, "scenes");
        if (scenes && scenes->isArray() && scenes->items().size() > 1) {
            const Value* name = member(&scenes->items().front(), "name");
            return name && name->isString() ? name->string() : std::string("Scene-0");
        }
        return std::filesystem::path(model_.path).stem().stem().string();
    }

    void finish(std::size_t id, const std::string& name, const std::string& path, const std::vector<int>& children,
                Value components, int depth) {
        Value list = Value::makeArray();
        for (std::size_t i = 0; i < children.size(); ++i) {
            const std::size_t child = std::size_t(children[i]);
            if (child >= nodes_.size() || entered_[child])
                throw Error(SourceLoc{.file = asset_.path.string()},
                            fmt::format("node {} is missing, has two parents or is its own ancestor", child),
                            "a node may have one parent");
            const std::size_t at = objects_.size();
            objects_.push_back(typed("cc.Node"));
            list.items().push_back(reference(at));
            fill(at, child, names_[child], fmt::format("{}/{}{}", path, names_[child], i), depth + 1);
        }
        Value info = typed("cc.PrefabInfo");
        info.set("fileId", Value::makeString(compressUuid(namedUuid(kSpace, path))));
        objects_[id].set("_name", Value::makeString(name));
        objects_[id].set("_children", std::move(list));
        if (components.isArray()) objects_[id].set("_components", std::move(components));
        objects_[id].set("_prefab", std::move(info));
    }

    void fill(std::size_t id, std::size_t node, const std::string& name, const std::string& path, int depth) {
        if (depth > limits_.maxNodeDepth)
            throw Error(SourceLoc{.file = asset_.path.string()}, "nodes are nested too deeply", "flatten the model");
        entered_[node] = true;
        const Value& from = *nodes_[node];
        setPlace(from, objects_[id]);
        Value components;
        const Value* mesh = member(&from, "mesh");
        if (mesh && mesh->isInteger()) {
            meshNodes_.push_back({int(node), int(mesh->integer())});
            components = Value::makeArray();
            components.items().push_back(renderer(from, node, path));
        }
        finish(id, name, path, numbersIn(member(&from, "children")), std::move(components), depth);
    }

    /// Null for each primitive: the model's own.
    Value materialSlots(const Value& from) const {
        Value slots = Value::makeArray();
        const Value *meshes = member(&json_, "meshes"), *mesh = member(&from, "mesh");
        const bool known = meshes && meshes->isArray() && mesh->integer() >= 0 &&
                           std::size_t(mesh->integer()) < meshes->items().size();
        const Value* parts = known ? member(&meshes->items()[std::size_t(mesh->integer())], "primitives") : nullptr;
        if (parts && parts->isArray()) slots.items().resize(parts->items().size());
        return slots;
    }

    Value renderer(const Value& from, std::size_t node, const std::string& path) const {
        const bool skinned = member(&from, "skin") != nullptr;
        Value out = typed(skinned ? "cc.SkinnedMeshRenderer" : "cc.MeshRenderer");
        if (skinned) out.set("_skinningRoot", reference(1));
        Value mesh = Value::makeObject();
        mesh.set("__uuid__", Value::makeString(asset_.uuid));
        out.set("_mesh", std::move(mesh));
        out.set("_materials", materialSlots(from));
        out.set(kGltfNode, Value::makeInteger(std::int64_t(node)));
        Value info = typed("cc.CompPrefabInfo");
        info.set("fileId", Value::makeString(compressUuid(namedUuid(kSpace, path + "/comp0"))));
        out.set("__prefab", std::move(info));
        return out;
    }

    static void setPlace(const Value& from, Value& node) {
        std::vector<float> t = floatsIn(member(&from, "translation"), 3), r = floatsIn(member(&from, "rotation"), 4),
                           s = floatsIn(member(&from, "scale"), 3);
        if (const std::vector<float> m = floatsIn(member(&from, "matrix"), 16); !m.empty()) {
            const glm::mat4 matrix = glm::make_mat4(m.data());
            glm::mat3 axes(matrix);
            glm::vec3 scale(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
            if (glm::determinant(axes) < 0) scale.x = -scale.x;
            for (int i = 0; i < 3; ++i) axes[i] = scale[i] != 0 ? axes[i] / scale[i] : glm::vec3(0);
            const glm::quat turn = glm::quat_cast(axes);
            t = {m[12], m[13], m[14]};
            r = {turn.x, turn.y, turn.z, turn.w};
            s = {scale.x, scale.y, scale.z};
        }
        if (!t.empty()) node.set("_lpos", vector("cc.Vec3", {t[0], t[1], t[2]}));
        if (!r.empty()) node.set("_lrot", vector("cc.Quat", {r[0], r[1], r[2], r[3]}));
        if (!s.empty()) node.set("_lscale", vector("cc.Vec3", {s[0], s[1], s[2]}));
    }

    const MetaAsset& asset_;
    const MetaAsset& model_;
    const Value& json_;
    const Limits& limits_;
    std::vector<const Value*> nodes_;
    std::vector<std::string> names_;
    std::vector<bool> entered_;
    std::vector<Value> objects_;
    std::vector<GltfPrefab::MeshNode> meshNodes_;
};

}  // namespace

GltfPrefab makeGltfPrefab(const MetaAsset& asset, const MetaAsset& model, const Limits& limits) {
    const GltfJson file = readGltfJson(asset.path, limits);
    return Builder(asset, model, file.json, limits).build();
}

}  // namespace crevice::cocos
