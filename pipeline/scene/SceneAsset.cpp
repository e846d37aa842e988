// Reads `.scene.json`: every mistake is reported with its place, and nothing half-read is returned.
#include "scene/SceneAsset.h"

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/Text.h"
#include "scene/SceneFields.h"
#include "scene/SceneFileLookup.h"
#include "scene/ScenePlaces.h"

namespace crevice {

namespace fs = std::filesystem;

namespace {

constexpr int kMaxGroupDepth = 16;

/// Reads one document into a scene, collecting problems.
class SceneReader {
public:
    SceneReader(fs::path folder, const LoadOptions& options)
        : folder_(std::move(folder)), options_(options), places_(options.limits.maxInstances) {}

    Scene read(const Value& document) {
        ParamReader reader(document, "the scene", problems_);
        reader.take("$schema");
        std::string help;
        reader.field("help", help, {.help = "What the scene is for"});
        readGltf(reader);
        reader.field("name", scene_.name, {.help = "Name of the scene"});
        readMaterials(reader.take("materials"));
        if (const Value* objects = reader.take("objects")) readObjects(*objects, {glm::mat4(1)}, 1);
        readCameras(reader);
        readList(reader.take("lights"), "'lights'",
                 [&](const Value& item, const std::string& what) { readLight(item, what); });
        if (const Value* ambient = reader.take("ambient"))
            readStruct(*ambient, "the ambient light", scene_.ambient.emplace());
        if (const Value* fog = reader.take("fog")) readFog(*fog);
        if (const Value* sky = reader.take("sky")) {
            readStruct(*sky, "the sky", scene_.sky);
            scene_.sky.enabled = true;
        }
        if (const Value* environment = reader.take("environment")) readEnvironment(*environment);
        readExposure(reader.take("exposure"));
        reader.finish();
        problems_.throwIfErrors();
        options_.log.write(problems_);
        return std::move(scene_);
    }

private:
    template <class Fields>
    void readStruct(const Value& value, const std::string& what, Fields& fields) {
        ParamReader reader(value, what, problems_);
        visitFields(reader, fields);
        reader.finish();
    }

    template <class Each>
    void readList(const Value* list, const std::string& what, Each each) {
        if (!list) return;
        if (!list->isArray()) {
            problems_.error(list->where(), fmt::format("{} must be a list, found {}", what, list->typeName()),
                            "write [ … ]");
            return;
        }
        for (std::size_t i = 0; i < list->items().size(); ++i)
            each(list->items()[i], fmt::format("item {} of {}", i + 1, what));
    }

    void readGltf(ParamReader& reader) {
        const Value* value = reader.take("gltf");
        if (!value) return;
        if (!value->isString() && !value->isObject()) {
            problems_.error(value->where(),
                            fmt::format("'gltf' must be a string or an object, found {}", value->typeName()),
                            "name a .gltf or .glb file, or write { \"file\": …, \"animation\": …, \"time\": … }");
            return;
        }
        LoadOptions options = options_;
        Value file = *value;
        if (value->isObject()) file = Value::makeString(readGltfChoice(*value, options), value->where());
        const std::optional<fs::path> path = findSceneFile(file, folder_, options_, "the glTF", problems_);
        if (!path) return;
        try {
            scene_ = loadGltf(*path, options);
        } catch (const Error& error) {
            problems_.add(error);
        }
    }

    // What the caller asks for comes before what the document says.
    std::string readGltfChoice(const Value& value, LoadOptions& options) {
        GltfFields fields;
        readStruct(value, "'gltf'", fields);
        if (options.scene.empty()) options.scene = fields.scene;
        const bool posed = !options.animation.empty() || options.time;
        if (!posed) options.animation = fields.animation;
        if (!posed && fields.time >= 0) options.time = fields.time;
        return fields.file;
    }

    void readMaterials(const Value* materials) {
        if (!materials) return;
        if (!materials->isObject()) {
            problems_.error(materials->where(),
                            fmt::format("'materials' must be an object, found {}", materials->typeName()),
                            "write { \"name\": { \"baseColor\": [ … ] }, … }");
            return;
        }
        for (const Member& member : materials->members()) {
            MaterialFields fields;
            readStruct(member.value, fmt::format("material '{}'", member.key), fields);
            ownMaterials_[member.key] = int(scene_.materials.size());
            scene_.materials.push_back(fields.make(member.key));
        }
    }

    int findMaterial(const Value* name) {
        if (!name) return defaultMaterial();
        if (!name->isString()) {
            problems_.error(name->where(), fmt::format("'material' must be a string, found {}", name->typeName()),
                            "name one of \"materials\"");
            return 0;
        }
        if (const auto own = ownMaterials_.find(name->string()); own != ownMaterials_.end()) return own->second;
        std::vector<std::string> names;
        for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
            if (scene_.materials[i].name == name->string()) return int(i);
            names.push_back(scene_.materials[i].name);
        }
        problems_.error(name->where(), fmt::format("no material '{}'", name->string()),
                        didYouMean(name->string(), names, "materials"));
        return 0;
    }

    int defaultMaterial() {
        if (defaultMaterial_ < 0) {
            defaultMaterial_ = int(scene_.materials.size());
            scene_.materials.push_back(MaterialFields{}.make("default material"));
        }
        return defaultMaterial_;
    }

    void readObjects(const Value& list, const std::vector<glm::mat4>& parents, int depth) {
        if (depth > kMaxGroupDepth) {
            problems_.error(list.where(), fmt::format("'objects' are nested deeper than {}", kMaxGroupDepth),
                            "flatten the groups");
            return;
        }
        readList(&list, "'objects'",
                 [&](const Value& item, const std::string& what) { readObject(item, what, parents, depth); });
    }

    // A primitive or a group of objects; either stands once per parent, array cell and instance.
    void readObject(const Value& value, const std::string& what, const std::vector<glm::mat4>& parents, int depth) {
        ParamReader reader(value, what, problems_);
        std::string name;
        reader.field("name", name, {.help = "For messages"});
        const std::vector<glm::mat4> worlds = readPlaces(reader, value, what, parents);
        const Value* children = reader.take("objects");
        if (children) {
            readObjects(*children, worlds, depth + 1);
        } else {
            const std::size_t problemsBefore = problems_.all().size();
            const PrimitiveFields primitive = readPrimitive(reader, value, what);
            const int material = findMaterial(reader.take("material"));
            if (problems_.all().size() == problemsBefore)
                addInstances(primitive, material, name, worlds, value.where());
        }
        reader.finish();
    }

    PlacementFields readPlacement(ParamReader& reader, const Value& object) {
        PlacementFields placement;
        visitFields(reader, placement);
        const Value* scale = object.isObject() ? object.find("scale") : nullptr;
        if (scale && scale->isNumber()) {
            reader.take("scale");
            placement.scale = glm::vec3(float(scale->number()));
        } else {
            reader.field("scale", placement.scale, {.help = "Scaled first; one number or three"});
        }
        for (int i = 0; i < 3 && scale; ++i)
            if (!(std::abs(placement.scale[i]) >= 1e-6f && std::abs(placement.scale[i]) <= 1e6f)) {
                problems_.error(scale->where(), "'scale' may not be 0 or beyond a million",
                                "leave thickness to \"size\", or write a small number");
                break;
            }
        return placement;
    }

    std::vector<glm::mat4> readPlaces(ParamReader& reader, const Value& value, const std::string& what,
                                      const std::vector<glm::mat4>& parents) {
        const glm::mat4 own = readPlacement(reader, value).matrix();
        ArrayFields array;
        if (const Value* cells = reader.take("array")) {
            readStruct(*cells, "'array' of " + what, array);
            if (array.count != glm::floor(array.count))
                problems_.error(cells->where(), fmt::format("'count' in 'array' of {} has a fraction", what),
                                "write whole numbers: \"count\": [5, 1, 1]");
        }
        std::vector<glm::mat4> instances;
        const Value* list = reader.take("instances");
        readList(list, "'instances' of " + what, [&](const Value& item, const std::string& itemName) {
            instances.push_back(readInstance(item, itemName));
        });
        if (!list) instances.push_back(glm::mat4(1));

        const glm::uvec3 count(glm::max(array.count, glm::vec3(1)));
        const double total = double(parents.size()) * count.x * count.y * count.z * double(instances.size());
        if (!places_.take(total, value, what, problems_)) return {};
        const std::vector<glm::mat4> cells = arrayCells(array.step, count);
        std::vector<glm::mat4> worlds;
        for (const glm::mat4& parent : parents)
            for (const glm::mat4& cell : cells)
                for (const glm::mat4& instance : instances) worlds.push_back(parent * own * cell * instance);
        return worlds;
    }

    // [x, y, z], or an object with position, rotation and scale.
    glm::mat4 readInstance(const Value& item, const std::string& what) {
        PlacementFields placement;
        if (!item.isArray()) {
            ParamReader reader(item, what, problems_);
            placement = readPlacement(reader, item);
            reader.finish();
            return placement.matrix();
        }
        for (std::size_t i = 0; i < 3; ++i) {
            if (item.items().size() != 3 || !item.items()[i].isNumber()) {
                problems_.error(item.where(), what + " must be a position of three numbers", "write [x, y, z]");
                break;
            }
            placement.position[int(i)] = float(item.items()[i].number());
        }
        return placement.matrix();
    }

    PrimitiveFields readPrimitive(ParamReader& reader, const Value& value, const std::string& what) {
        PrimitiveFields fields;
        if (!value.isObject() || !value.find("primitive")) {
            if (value.isObject())
                problems_.error(value.where(), fmt::format("{} has neither 'primitive' nor 'objects'", what),
                                "primitives: " + join({std::begin(kPrimitiveNames), std::end(kPrimitiveNames)}));
            return fields;
        }
        reader.choice("primitive", fields.kind, kPrimitiveNames, {.help = "The shape"});
        visitFields(reader, fields);
        if (fields.kind == kLathe) readProfile(reader.take("profile"), value, what, fields.profile);
        return fields;
    }

    void readProfile(const Value* list, const Value& object, const std::string& what, std::vector<glm::vec2>& profile) {
        constexpr const char* kHelp = "write [[radius, height], …] from bottom to top along the outside";
        readList(list, "'profile' of " + what, [&](const Value& item, const std::string& itemName) {
            const bool isPoint = item.isArray() && item.items().size() == 2 && item.items()[0].isNumber() &&
                                 item.items()[1].isNumber() && item.items()[0].number() >= 0;
            if (!isPoint)
                problems_.error(item.where(), itemName + " must be a radius of at least 0 and a height", kHelp);
            else
                profile.push_back({float(item.items()[0].number()), float(item.items()[1].number())});
        });
        if (!list || (list->isArray() && list->items().size() < 2))
            problems_.error((list ? *list : object).where(), what + " needs a 'profile' of two points or more", kHelp);
    }

    void addInstances(const PrimitiveFields& primitive, int material, const std::string& name,
                      const std::vector<glm::mat4>& worlds, const SourceLoc& where) {
        if (scene_.instances.size() + worlds.size() > options_.limits.maxInstances) {
            problems_.error(where, fmt::format("the scene has more than {} instances", options_.limits.maxInstances),
                            "lower \"count\" of its arrays, or " + raiseLimit("instances"));
            return;
        }
        const int mesh = findMesh(primitive);
        for (const glm::mat4& world : worlds)
            scene_.instances.push_back({.mesh = mesh,
                                        .material = material,
                                        .world = world,
                                        .name = name,
                                        .flipped = glm::determinant(glm::mat3(world)) < 0});
    }

    // Equal primitives share one mesh; their fields as text tell.
    int findMesh(PrimitiveFields primitive) {
        ParamTable table;
        visitFields(table, primitive);
        std::string key = kPrimitiveNames[primitive.kind];
        for (const ParamRow& row : table.rows()) key += fmt::format(" {}={}", row.key, row.defaultValue);
        for (const glm::vec2& point : primitive.profile) key += fmt::format(" {},{}", point.x, point.y);
        const auto [entry, isNew] = meshes_.emplace(key, int(scene_.meshes.size()));
        if (!isNew) return entry->second;
        scene_.meshes.push_back(makePrimitive(primitive));
        vertexCount_ += scene_.meshes.back().vertices.size();
        if (vertexCount_ > options_.limits.maxVertices)
            throw Error(SourceLoc{}, fmt::format("the scene has more than {} vertices", options_.limits.maxVertices),
                        "lower \"segments\" of its primitives, or " + raiseLimit("vertices"));
        return entry->second;
    }

    void readCameras(ParamReader& reader) {
        std::vector<Camera> cameras;
        const auto add = [&](const Value& value, const std::string& what) {
            CameraFields fields;
            readStruct(value, what, fields);
            if (fields.far > 0 && fields.far <= fields.near)
                problems_.error(value.where(),
                                fmt::format("'far' {} of {} is not beyond 'near' {}", fields.far, what, fields.near),
                                "exchange the two, or leave them out: they follow from the scene");
            cameras.push_back(fields.make());
        };
        if (const Value* one = reader.take("camera")) add(*one, "the camera");
        readList(reader.take("cameras"), "'cameras'", add);
        // The document's own come before the glTF's: the first camera is the one that is used.
        scene_.cameras.insert(scene_.cameras.begin(), cameras.begin(), cameras.end());
    }

    void readLight(const Value& value, const std::string& what) {
        LightFields fields;
        readStruct(value, what, fields);
        const Light light = fields.make();
        if (light.type == LightType::Spot && light.innerAngle >= light.outerAngle)
            problems_.error(value.where(), fmt::format("'innerAngle' of {} is not below 'outerAngle'", what),
                            "the light is full within the inner and dark beyond the outer angle");
        scene_.lights.push_back(light);
    }

    void readFog(const Value& value) {
        FogFields fields;
        readStruct(value, "the fog", fields);
        scene_.fog = fields.make();
        if (scene_.fog.type == FogType::Linear && scene_.fog.end <= scene_.fog.start)
            problems_.error(value.where(), "'end' of the fog is not beyond 'start'", "exchange the two");
    }

    void readEnvironment(const Value& value) {
        EnvironmentFields fields;
        const std::size_t problemsBefore = problems_.all().size();
        readStruct(value, "the environment", fields);
        if (problems_.all().size() != problemsBefore) return;
        try {
            if (fields.isSky()) {
                scene_.environment = skyEnvironment(scene_.sky);
            } else if (const auto path =
                           findSceneFile(*value.find("file"), folder_, options_, "the environment", problems_)) {
                scene_.environment = loadEnvironment(*path, options_.log, options_.limits);
            }
        } catch (const Error& error) {
            problems_.add(error);
        }
        if (scene_.environment) fields.apply(*scene_.environment);
    }

    void readExposure(const Value* value) {
        if (!value || (value->isString() && value->string() == "auto")) return;
        if (value->isNumber() && std::abs(value->number()) <= 32)
            scene_.exposureEv = float(value->number());
        else
            problems_.error(value->where(), "'exposure' must be a number of stops from -32 to 32, or 'auto'",
                            "write \"exposure\": 0 or \"exposure\": \"auto\"");
    }

    fs::path folder_;
    const LoadOptions& options_;
    Problems problems_;
    Scene scene_;
    std::map<std::string, int> ownMaterials_;
    std::map<std::string, int> meshes_;
    std::size_t vertexCount_ = 0;  ///< Of the primitives' meshes.
    PlaceBudget places_;
    int defaultMaterial_ = -1;
};

}  // namespace

Scene readSceneAsset(const Value& document, const fs::path& folder, const LoadOptions& options) {
    return SceneReader(folder, options).read(document);
}

}  // namespace crevice
