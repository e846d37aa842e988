// Walks the node tree twice: cameras first, since exposure and the sort of light follow from them and the globals.
#include "cocos/scene/SceneImport.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "cocos/files/TakeOver.h"
#include "cocos/scene/PrefabOverrides.h"
#include "cocos/scene/SceneComponents.h"
#include "cocos/scene/SceneModels.h"
#include "cocos/scene/SceneSurroundings.h"

namespace crevice::cocos {
namespace {

constexpr DocumentLimits kSceneLimits{.maxBytes = 256u << 20, .maxDepth = 64, .maxNodes = 8'000'000};

constexpr std::int64_t kDefaultLayer = std::int64_t(1) << 30;

/// Bookkeeping of nodes that draws nothing.
constexpr std::string_view kSilent[] = {"cc.UITransform", "cc.Widget", "cc.Animation", "cc.SkeletalAnimation"};

void switchOffShadows(std::vector<MaterialPass>& passes) {
    if (passes.empty()) passes.resize(1);
    for (MaterialPass& pass : passes) {
        if (!pass.defines.isObject()) pass.defines = Value::makeObject();
        pass.defines.set("CC_RECEIVE_SHADOW", Value::makeBool(false));
    }
}

class SceneImporter {
public:
    SceneImporter(Project& project, MaterialForm form, const LoadOptions& options, Problems& problems)
        : project_(project),
          options_(options),
          problems_(problems),
          materials_(project, out_.scene, form, problems),
          models_(project, out_.scene, materials_, options, problems) {}

    ImportedScene run(const std::filesystem::path& path) {
        const ObjectGraph graph = ObjectGraph::read(path, kSceneLimits);
        const Value* root = rootNode(graph);
        out_.scene.name = path.stem().string();
        const Value* written = root->find("_globals");
        const Value* globals = written ? graph.resolve(*written, "'_globals'", problems_) : nullptr;
        facts_.hdr = isHdr(graph, globals, problems_);
        const Inside scene{&graph};
        lights_ = false;
        walk(scene, *root, glm::mat4(1), 0);
        takeCameras();
        lights_ = true;
        walk(scene, *root, glm::mat4(1), 0);
        readSurroundings(graph, globals, facts_, project_, options_, out_, skipped_, problems_);
        noteSkipped();
        return std::move(out_);
    }

private:
    /// The file that a node lies in, and the instances of prefabs around it.
    struct Inside {
        const ObjectGraph* graph = nullptr;
        PrefabScopes scopes{};
        const MetaAsset* model = nullptr;  ///< The file is a glTF, read as a prefab.
    };

    struct Place {
        const Value* node = nullptr;
        glm::mat4 world{1};
        std::uint32_t layer = 0;
    };

    struct Prefab {
        std::unique_ptr<ObjectGraph> graph{};
        const Value* root = nullptr;  ///< Null for one that cannot be read.
    };

    const Value* rootNode(const ObjectGraph& graph) {
        const Value& first = graph.root();
        const std::string type = typeOf(first);
        const char* key = type == "cc.SceneAsset" ? "scene" : "data";
        const Value* ref = first.find(key);
        const Value* root = ref ? graph.resolve(*ref, fmt::format("'{}'", key), problems_) : nullptr;
        if (type != "cc.SceneAsset" && type != "cc.Prefab")
            throw Error(first.where(), fmt::format("this is no scene: its type is '{}'", type),
                        "a .scene begins with an object of type 'cc.SceneAsset', a .prefab with a 'cc.Prefab'");
        if (root) return root;
        problems_.throwIfErrors();
        throw Error(first.where(), fmt::format("'{}' of this '{}' is missing", key, type),
                    R"(let it name the root: { "__id__": N })");
    }

    /// `rootId`: of the root of a prefab, as its instance has it.
    void walk(const Inside& in, const Value& node, const glm::mat4& parent, int depth, const std::string& rootId = {}) {
        if (!mayEnter(node, depth, in.scopes.size())) return;
        const std::string id = rootId.empty() ? prefabIdOf(*in.graph, node, "_prefab", problems_) : rootId;
        Value changed;
        const Value& here = withChanges(in.scopes, id, node, changed);
        const FieldReader fields(here, problems_);
        if (!fields.boolean("_active", true)) return;
        if (const Value* instance = prefabInstance(*in.graph, node)) return placePrefab(in, *instance, parent, depth);
        const glm::mat4 world = parent * readTransform(here, problems_);
        path_.push_back({&node, world, std::uint32_t(fields.integer("_layer", kDefaultLayer))});
        const std::string name = fields.text("_name", "node");
        for (const Value* component : in.graph->resolveList(fields.list("_components"), "'_components'", problems_))
            visit(in, *component, world, name);
        for (const Value* child : in.graph->resolveList(fields.list("_children"), "'_children'", problems_))
            walk(in, *child, world, depth + 1);
        addMounted(in, id, world, name, depth);
        path_.pop_back();
    }

    /// What instances around a node hang below it: nodes of the files that hold the instances.
    void addMounted(const Inside& in, const std::string& id, const glm::mat4& world, const std::string& name,
                    int depth) {
        for (std::size_t i = 0; i < in.scopes.size() && !id.empty(); ++i) {
            const PrefabScope& scope = in.scopes[i];
            const Inside outside{scope.graph, {in.scopes.begin() + std::ptrdiff_t(i) + 1, in.scopes.end()}};
            for (const Value* component : scope.changes->components(scope.prefix + id))
                visit(outside, *component, world, name);
            for (const Value* child : scope.changes->children(scope.prefix + id))
                walk(outside, *child, world, depth + 1);
        }
    }

    /// `instances` of prefabs around a node cost as much as nodes do.
    bool mayEnter(const Value& node, int depth, std::size_t instances) {
        if (depth > options_.limits.maxNodeDepth) {
            problems_.error(node.where(),
                            fmt::format("nodes nested deeper than {} levels", options_.limits.maxNodeDepth),
                            "flatten the scene");
            return false;
        }
        if (std::any_of(path_.begin(), path_.end(), [&](const Place& place) { return place.node == &node; })) {
            problems_.error(node.where(), "this node is one of its own children", "let '_children' name other nodes");
            return false;
        }
        const std::size_t most = 2 * options_.limits.maxInstances, before = visited_;
        visited_ += 1 + instances;
        if (before <= most && visited_ > most)
            problems_.error(node.where(), fmt::format("more than {} nodes", options_.limits.maxInstances),
                            "split the scene");
        return visited_ <= most;
    }

    void visit(const Inside& in, const Value& written, const glm::mat4& world, const std::string& name) {
        const std::string id = prefabIdOf(*in.graph, written, "__prefab", problems_);
        if (isRemoved(in.scopes, id)) return;
        Value changed;
        const Value& component = withChanges(in.scopes, id, written, changed);
        const FieldReader fields(component, problems_);
        if (!fields.boolean("_enabled", true)) return;
        const std::string type = componentType(component);
        if (type == "cc.Camera") {
            if (!lights_) cameras_.push_back(readCamera(component, world, problems_));
            if (!lights_) cameras_.back().camera.name = name;
            return;
        }
        if (!lights_) return;
        if (auto light = readLight(component, world, facts_.hdr, facts_.exposure, problems_)) {
            light->name = name;
            const bool sun = light->type == LightType::Directional && light->castsShadow;
            facts_.cascades = facts_.cascades || (sun && fields.integer("_csmLevel", 1) > 1);
            if (fields.boolean("_useColorTemperature", false)) ++skipped_["colour temperature of lights"];
            out_.scene.lights.push_back(std::move(*light));
        } else if (isMeshRenderer(type)) {
            addRenderer(in, component, placeOf(*in.graph, component, world), name);
        } else if (std::find(std::begin(kSilent), std::end(kSilent), type) == std::end(kSilent)) {
            ++skipped_[type.empty() ? "components without a type" : type];
        }
    }

    /// Skinned vertices are posed where the model's root is: the renderer's own node does not count.
    glm::mat4 placeOf(const ObjectGraph& graph, const Value& component, const glm::mat4& world) {
        if (!isSkinnedRenderer(componentType(component))) return world;
        const Value* written = FieldReader(component, problems_).find("_skinningRoot");
        const Value* root = written ? graph.resolve(*written, "'_skinningRoot'", problems_) : nullptr;
        for (const Place& place : path_)
            if (place.node == root) return place.world;
        return world;
    }

    void addRenderer(const Inside& in, const Value& component, const glm::mat4& world, const std::string& name) {
        const FieldReader fields(component, problems_);
        const AssetRef mesh = fields.asset("_mesh");
        if (!mesh) return;
        if ((path_.back().layer & ~visibility_) != 0) {
            ++skipped_["renderers on layers that the first camera does not see"];
            return;
        }
        const bool ofModel = in.model && mesh.uuid == in.model->uuid;
        const std::vector<ModelPart> parts =
            ofModel ? models_.partsOfNode(*in.model, int(fields.integer(kGltfNode, -1)), mesh)
                    : models_.mesh(mesh, fmt::format("the mesh of '{}'", name));
        const Value* materials = fields.list("_materials");
        const bool casts = fields.integer("_shadowCastingMode", 0) != 0;
        const bool receives = fields.integer("_shadowReceivingMode", 1) != 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const Value* ref = materials && i < materials->items().size() ? &materials->items()[i] : nullptr;
            out_.scene.instances.push_back({.mesh = parts[i].mesh,
                                            .material = receiving(materialOf(ref, parts[i], name), receives),
                                            .world = world,
                                            .name = name,
                                            .flipped = glm::determinant(glm::mat3(world)) < 0,
                                            .castsShadow = casts});
        }
    }

    int materialOf(const Value* ref, const ModelPart& part, const std::string& name) {
        if (!ref || ref->isNull()) return part.material >= 0 ? part.material : materials_.addDefault();
        if (!isAssetRef(*ref)) {
            problems_.error(ref->where(), fmt::format("a material of '{}' must be an asset or null", name),
                            R"(write { "__uuid__": "…" })");
            return materials_.addDefault();
        }
        const AssetRef asset = readAssetRef(*ref);
        if (const int own = models_.material(asset); own >= 0) return own;
        const MetaAsset* file = project_.metas().find(asset.uuid);
        if (file && file->importer == "gltf-material" && !SceneModels::isModel(*file)) {
            ++skipped_["materials of models that are not glTF"];
            return materials_.addDefault();
        }
        const int index = materials_.add(asset, fmt::format("the material of '{}'", name));
        return index >= 0 ? index : materials_.addDefault();
    }

    /// Whether shadows fall on it is a renderer's to say, and a macro of its material's here.
    int receiving(int material, bool receives) {
        std::vector<SceneMaterial>& all = out_.scene.materials;
        if (receives || !all[std::size_t(material)].effect) return material;
        const auto [known, isNew] = unshadowed_.try_emplace(material, int(all.size()));
        if (!isNew) return known->second;
        all.push_back(SceneMaterial(all[std::size_t(material)]));
        switchOffShadows(all.back().effect->passes);
        return known->second;
    }

    /// The cc.PrefabInfo of a node that stands for a prefab, or null.
    const Value* prefabInstance(const ObjectGraph& graph, const Value& node) {
        const Value* ref = node.find("_prefab");
        const Value* info = ref && !ref->isNull() ? graph.resolve(*ref, "'_prefab'", problems_) : nullptr;
        const Value* instance = info ? info->find("instance") : nullptr;
        return instance && !instance->isNull() ? info : nullptr;
    }

    void placePrefab(const Inside& in, const Value& info, const glm::mat4& parent, int depth) {
        const FieldReader fields(info, problems_);
        const AssetRef ref = fields.asset("asset");
        const MetaAsset* asset = ref ? project_.find(ref, "a prefab", problems_) : nullptr;
        const Value* instance = asset ? in.graph->resolve(*info.find("instance"), "'instance'", problems_) : nullptr;
        if (!instance) return;
        if (std::find(prefabPath_.begin(), prefabPath_.end(), asset->path) != prefabPath_.end()) {
            problems_.error(ref.where, fmt::format("prefab '{}' is a part of itself", asset->path.string()),
                            "let one of its nodes name another prefab");
            return;
        }
        PrefabOverrides own(*in.graph, *instance, problems_);
        Inside inside{nullptr,
                      enterInstance(in.scopes, own, *in.graph, FieldReader(*instance, problems_).text("fileId"))};
        const std::string rootId = fields.text("fileId");
        const bool isModel = SceneModels::isModel(*asset);
        if (!isModel && asset->path.extension() != ".prefab") {
            if (lights_) ++skipped_["models that are not glTF"];
            return;
        }
        prefabPath_.push_back(asset->path);
        try {
            if (isModel)
                placeModel(*asset, rootId, inside, parent, depth, ref);
            else
                walkPrefab(*asset, rootId, inside, parent, depth);
        } catch (const Error& error) {
            problems_.add(error);
        }
        prefabPath_.pop_back();
        if (lights_ && own.left() > 0) skipped_["changes inside of prefabs"] += own.left();
    }

    /// As it is in its file, unless instances change more of it than its root.
    void placeModel(const MetaAsset& asset, const std::string& rootId, Inside& inside, const glm::mat4& parent,
                    int depth, const AssetRef& ref) {
        const bool changed = std::any_of(inside.scopes.begin(), inside.scopes.end(), [&](const PrefabScope& scope) {
            return scope.changes->reachesBeside(scope.prefix, scope.prefix + rootId);
        });
        inside.graph = changed ? models_.prefab(asset, ref) : nullptr;
        if (inside.graph) {
            inside.model = &asset;
            return walk(inside, *rootNode(*inside.graph), parent, depth + 1, rootId);
        }
        const Value root = Value::makeObject();
        Value copy;
        const Value& placed = withChanges(inside.scopes, rootId, root, copy);
        const bool active = FieldReader(placed, problems_).boolean("_active", true);
        if (lights_ && active) models_.placeModel(asset, parent * readTransform(placed, problems_), ref);
    }

    void walkPrefab(const MetaAsset& asset, const std::string& rootId, Inside& inside, const glm::mat4& parent,
                    int depth) {
        const auto [known, isNew] = prefabs_.try_emplace(asset.path);
        Prefab& prefab = known->second;
        if (isNew) {  // one that cannot be read is said once, not for each instance
            prefab.graph = std::make_unique<ObjectGraph>(ObjectGraph::read(asset.path, kSceneLimits));
            prefab.root = rootNode(*prefab.graph);
        }
        if (!prefab.root) return;
        inside.graph = prefab.graph.get();
        walk(inside, *prefab.root, parent, depth + 1, rootId);
    }

    void takeCameras() {
        std::stable_sort(cameras_.begin(), cameras_.end(),
                         [](const ImportedCamera& a, const ImportedCamera& b) { return a.priority < b.priority; });
        // Cameras of user interfaces are orthographic and draw over the others.
        std::stable_partition(cameras_.begin(), cameras_.end(),
                              [](const ImportedCamera& camera) { return !camera.camera.orthographic; });
        for (const ImportedCamera& camera : cameras_) out_.scene.cameras.push_back(camera.camera);
        double ev = std::log2(16.0 * 16 * 125);
        if (!cameras_.empty()) {
            ev = cameras_.front().ev;
            out_.background = cameras_.front().clearColor;
            facts_.showsSky = cameras_.front().showsSky;
            if (cameras_.front().visibility != 0) visibility_ = cameras_.front().visibility;  // 0: earlier than layers
        }
        out_.scene.exposureEv = float(ev);
        facts_.exposure = exposureOf(ev);
    }

    void noteSkipped() {
        for (const auto& [what, count] : skipped_)
            problems_.note({}, fmt::format("left out: {}{}", what, count > 1 ? fmt::format(", {} times", count) : ""));
    }

    Project& project_;
    const LoadOptions& options_;
    Problems& problems_;
    ImportedScene out_;
    SceneMaterials materials_;
    SceneModels models_;
    std::vector<ImportedCamera> cameras_;
    std::map<std::string, std::size_t> skipped_;
    std::map<std::filesystem::path, Prefab> prefabs_;
    std::vector<Place> path_;                        ///< From the root to the node that is visited.
    std::vector<std::filesystem::path> prefabPath_;  ///< The prefabs that node is inside of.
    std::map<int, int> unshadowed_;                  ///< Material → the same without CC_RECEIVE_SHADOW.
    std::size_t visited_ = 0;
    bool lights_ = false;
    std::uint32_t visibility_ = ~0u;  ///< Layers that the first camera sees.
    SceneFacts facts_;
};

}  // namespace

ImportedScene importScene(const std::filesystem::path& path, Project& project, MaterialForm form,
                          const LoadOptions& options, Problems& problems) {
    Problems own;  // said twice by the two walks
    try {
        ImportedScene scene = SceneImporter(project, form, options, own).run(path);
        takeOverOnce(own, problems);
        return scene;
    } catch (const Error& error) {
        own.add(error);
        takeOverOnce(own, problems);
    }
    return {};
}

}  // namespace crevice::cocos
