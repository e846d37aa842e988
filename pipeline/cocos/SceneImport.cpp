// Walks the node tree twice: cameras first, since exposure and the sort of light follow from them and the globals.
#include "cocos/SceneImport.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "cocos/PrefabOverrides.h"
#include "cocos/SceneComponents.h"
#include "cocos/SceneGlobals.h"
#include "cocos/SceneModels.h"
#include "cocos/SceneSky.h"
#include "cocos/TakeOver.h"

namespace crevice::cocos {
namespace {

constexpr DocumentLimits kSceneLimits{.maxBytes = 256u << 20, .maxDepth = 64, .maxNodes = 8'000'000};
constexpr int kMaxPrefabs = 1;  ///< Prefabs inside of prefabs are left out.

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
        hdr_ = isHdr(graph, globals);
        lights_ = false;
        walk(graph, *root, glm::mat4(1), 0, 0);
        takeCameras();
        lights_ = true;
        walk(graph, *root, glm::mat4(1), 0, 0);
        readGlobals(graph, globals);
        noteSkipped();
        return std::move(out_);
    }

private:
    struct Place {
        const Value* node = nullptr;
        glm::mat4 world{1};
    };

    const Value* rootNode(const ObjectGraph& graph) {
        const Value& first = graph.root();
        const std::string type = typeOf(first);
        const char* key = type == "cc.SceneAsset" ? "scene" : "data";
        const Value* ref = first.find(key);
        const Value* root = ref ? graph.resolve(*ref, fmt::format("'{}'", key), problems_) : nullptr;
        if (type != "cc.SceneAsset" && type != "cc.Prefab")
            throw Error(first.where(), fmt::format("this is no scene: its type is '{}'", type),
                        "a .scene begins with an object of type 'cc.SceneAsset'");
        if (root) return root;
        problems_.throwIfErrors();
        throw Error(first.where(), fmt::format("'{}' of this '{}' is missing", key, type),
                    R"(let it name the root: { "__id__": N })");
    }

    const Value* section(const ObjectGraph& graph, const Value& globals, std::initializer_list<const char*> keys) {
        for (const char* key : keys) {
            const Value* value = globals.find(key);
            if (value && !value->isNull()) return graph.resolve(*value, fmt::format("'{}'", key), problems_);
        }
        return nullptr;
    }

    bool isHdr(const ObjectGraph& graph, const Value* globals) {
        const Value* skybox = globals ? section(graph, *globals, {"_skybox", "skybox"}) : nullptr;
        if (!skybox) return true;
        const FieldReader fields(*skybox, problems_);
        return fields.boolean(fields.firstOf({"_useHDR", "_isHDR"}), true);
    }

    void walk(const ObjectGraph& graph, const Value& node, const glm::mat4& parent, int depth, int prefabs) {
        if (depth > options_.limits.maxNodeDepth) {
            problems_.error(node.where(),
                            fmt::format("nodes nested deeper than {} levels", options_.limits.maxNodeDepth),
                            "flatten the scene");
            return;
        }
        if (std::any_of(path_.begin(), path_.end(), [&](const Place& place) { return place.node == &node; })) {
            problems_.error(node.where(), "this node is one of its own children", "let '_children' name other nodes");
            return;
        }
        if (++visited_ > 2 * options_.limits.maxInstances) {
            if (visited_ == 2 * options_.limits.maxInstances + 1)
                problems_.error(node.where(), fmt::format("more than {} nodes", options_.limits.maxInstances),
                                "split the scene");
            return;
        }
        Value changed;
        const Value& here = withChanges(graph, node, "_prefab", changed);
        const FieldReader fields(here, problems_);
        if (!fields.boolean("_active", true)) return;
        if (const Value* instance = prefabInstance(graph, node))
            return placePrefab(graph, node, *instance, parent, depth, prefabs);
        const glm::mat4 world = parent * readTransform(here, problems_);
        path_.push_back({&node, world});
        for (const Value* component : graph.resolveList(fields.list("_components"), "'_components'", problems_))
            visit(graph, *component, world, fields.text("_name", "node"));
        for (const Value* child : graph.resolveList(fields.list("_children"), "'_children'", problems_))
            walk(graph, *child, world, depth + 1, prefabs);
        path_.pop_back();
    }

    /// A node or component, or a copy of it with what an instance of its prefab changes.
    const Value& withChanges(const ObjectGraph& graph, const Value& object, const char* key, Value& copy) {
        const std::string id = changes_ ? prefabIdOf(graph, object, key, problems_) : std::string();
        if (!changes_ || !changes_->has(id)) return object;
        copy = object;
        changes_->apply(id, copy);
        return copy;
    }

    void visit(const ObjectGraph& graph, const Value& written, const glm::mat4& world, const std::string& name) {
        Value changed;
        const Value& component = withChanges(graph, written, "__prefab", changed);
        const FieldReader fields(component, problems_);
        if (!fields.boolean("_enabled", true)) return;
        const std::string type = typeOf(component);
        if (type == "cc.Camera") {
            if (!lights_) cameras_.push_back(readCamera(component, world, problems_));
            if (!lights_) cameras_.back().camera.name = name;
            return;
        }
        if (!lights_) return;
        if (auto light = readLight(component, world, hdr_, exposure_, problems_)) {
            light->name = name;
            const bool sun = light->type == LightType::Directional && light->castsShadow;
            cascades_ = cascades_ || (sun && fields.integer("_csmLevel", 1) > 1);
            if (fields.boolean("_useColorTemperature", false)) ++skipped_["colour temperature of lights"];
            out_.scene.lights.push_back(std::move(*light));
        } else if (type == "cc.MeshRenderer" || type == "cc.SkinnedMeshRenderer" || type == "cc.ModelComponent") {
            addRenderer(component, placeOf(graph, component, world), name);
        } else if (std::find(std::begin(kSilent), std::end(kSilent), type) == std::end(kSilent)) {
            ++skipped_[type.empty() ? "components without a type" : type];
        }
    }

    /// Skinned vertices are posed where the model's root is: the renderer's own node does not count.
    glm::mat4 placeOf(const ObjectGraph& graph, const Value& component, const glm::mat4& world) {
        if (typeOf(component) != "cc.SkinnedMeshRenderer") return world;
        const Value* written = FieldReader(component, problems_).find("_skinningRoot");
        const Value* root = written ? graph.resolve(*written, "'_skinningRoot'", problems_) : nullptr;
        for (const Place& place : path_)
            if (place.node == root) return place.world;
        return world;
    }

    void addRenderer(const Value& component, const glm::mat4& world, const std::string& name) {
        const FieldReader fields(component, problems_);
        const AssetRef mesh = fields.asset("_mesh");
        if (!mesh) return;
        const std::vector<ModelPart> parts = models_.mesh(mesh, fmt::format("the mesh of '{}'", name));
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

    void placePrefab(const ObjectGraph& graph, const Value& node, const Value& info, const glm::mat4& parent, int depth,
                     int prefabs) {
        const AssetRef ref = FieldReader(info, problems_).asset("asset");
        const MetaAsset* asset = ref ? project_.find(ref, "a prefab", problems_) : nullptr;
        if (!asset) return;
        const Value* instance = graph.resolve(*info.find("instance"), "'instance'", problems_);
        if (!instance) return;
        PrefabOverrides changes(graph, *instance, problems_);
        const std::string rootId = FieldReader(info, problems_).text("fileId");
        if (SceneModels::isModel(*asset)) {
            Value placed = Value::makeObject(node.where());
            changes.apply(rootId, placed);
            const bool active = FieldReader(placed, problems_).boolean("_active", true);
            if (lights_ && active) models_.placeModel(*asset, parent * readTransform(placed, problems_), ref);
        } else if (asset->path.extension() != ".prefab" || prefabs >= kMaxPrefabs) {
            if (lights_) ++skipped_[prefabs >= kMaxPrefabs ? "prefabs inside of prefabs" : "models that are not glTF"];
            return;
        } else {
            walkPrefab(*asset, rootId, changes, parent, depth);
        }
        if (lights_ && changes.left() > 0) skipped_["changes inside of prefabs"] += changes.left();
    }

    void walkPrefab(const MetaAsset& asset, const std::string& rootId, PrefabOverrides& changes,
                    const glm::mat4& parent, int depth) {
        try {
            auto& prefab = prefabs_[asset.path];
            if (!prefab) prefab = std::make_unique<ObjectGraph>(ObjectGraph::read(asset.path, kSceneLimits));
            Value root = *rootNode(*prefab);
            changes.apply(rootId, root);
            root.erase("_prefab");
            changes_ = &changes;
            walk(*prefab, root, parent, depth + 1, kMaxPrefabs);
        } catch (const Error& error) {
            problems_.add(error);
        }
        changes_ = nullptr;
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
            showsSky_ = cameras_.front().showsSky;
        }
        out_.scene.exposureEv = float(ev);
        exposure_ = exposureOf(ev);
    }

    void readGlobals(const ObjectGraph& graph, const Value* globals) {
        const Value none = Value::makeObject();
        const Value* shadows = globals ? section(graph, *globals, {"shadows", "_shadows"}) : nullptr;
        takeShadows(readShadows(shadows ? *shadows : none, problems_));
        const Value* ambient = globals ? section(graph, *globals, {"ambient", "_ambient"}) : nullptr;
        const Value& light = ambient ? *ambient : none;
        out_.scene.ambient = readAmbient(light, hdr_, exposure_, problems_);
        if (const Value* fog = globals ? section(graph, *globals, {"fog", "_fog"}) : nullptr)
            out_.scene.fog = readFog(*fog, exposure_, problems_);
        if (const Value* skybox = globals ? section(graph, *globals, {"_skybox", "skybox"}) : nullptr)
            takeSky(*skybox, readSkyIlluminance(light, hdr_, exposure_, problems_));
        noteDarkness(light);
    }

    /// The exposure of a .scene is that of daylight: nothing else would say why the picture is black.
    void noteDarkness(const Value& ambient) {
        const Ambient& around = *out_.scene.ambient;
        const bool dark = around.sky == glm::vec3(0) && around.ground == glm::vec3(0) && !litByEnvironment(out_.scene);
        if (!out_.scene.lights.empty() || problems_.hasErrors()) return;
        if (dark)
            problems_.warning(ambient.where(),
                              "nothing lights this scene: it has no lights, and its ambient light is 0",
                              "add a light, or raise '_skyIllum'");
        else
            problems_.note({}, "the scene has no lights: its ambient light or its sky alone lights it");
    }

    void takeShadows(const ImportedShadows& shadows) {
        if (shadows.planar) ++skipped_["planar shadows"];
        if (shadows.maps && shadows.size != glm::uvec2(0)) out_.shadowMap = shadows.size;
        if (shadows.maps && cascades_) ++skipped_["cascades of shadow maps: the light has one map"];
        for (Light& light : out_.scene.lights) {
            light.castsShadow = light.castsShadow && shadows.maps;
            if (!light.shadow) light.shadow = shadows.look;
        }
    }

    void takeSky(const Value& info, double illuminance) {
        const ImportedSky sky = readSkybox(info, hdr_, problems_);
        if (!sky.enabled || (!sky.lights && !showsSky_)) return;
        if (sky.ownEffect) ++skipped_["the material of the sky"];
        const MetaAsset* asset = sky.picture ? project_.metas().find(sky.picture.uuid) : nullptr;
        if (!asset || !isPanorama(asset->path)) {
            noteSky(sky, asset);
            return;
        }
        try {
            out_.scene.environment = readSky(*asset, options_.log, options_.limits);
            out_.scene.environment->intensity = float(illuminance);
            out_.scene.environment->rotation = float(glm::radians(sky.rotation));
            out_.scene.environment->visible = showsSky_;
            out_.scene.environment->lights = sky.lights;
        } catch (const Error& error) {
            const Problem& why = error.problems().front();
            problems_.warning(sky.picture.where, fmt::format("the sky is left out: {}", why.message), why.help);
        }
    }

    void noteSky(const ImportedSky& sky, const MetaAsset* asset) {
        const std::string what = asset         ? fmt::format("'{}' is no panorama", asset->path.filename().string())
                                 : sky.picture ? fmt::format("no .meta has its uuid '{}'", sky.picture.uuid)
                                               : "it has no picture";
        problems_.note(sky.picture.where, fmt::format("the sky is left out: {}", what),
                       asset || !sky.picture ? "skies are .hdr, .exr, .png, .jpg or .webp, twice as wide as high"
                                             : "the engine's own skies are in its folder: --engine DIR");
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
    std::map<std::filesystem::path, std::unique_ptr<ObjectGraph>> prefabs_;
    PrefabOverrides* changes_ = nullptr;  ///< Of the prefab that is walked.
    std::vector<Place> path_;             ///< From the root to the node that is visited.
    std::map<int, int> unshadowed_;       ///< Material → the same without CC_RECEIVE_SHADOW.
    std::size_t visited_ = 0;
    bool hdr_ = true, lights_ = false, showsSky_ = true, cascades_ = false;
    double exposure_ = 1;
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
