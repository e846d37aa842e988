// Cameras, lights and ambient light are read as in a scene document.
#include "app/bench/AoViews.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "app/commands/SceneFiles.h"
#include "core/Document.h"
#include "core/Error.h"
#include "scene/Framing.h"
#include "scene/SceneAsset.h"
#include "scene/SceneFields.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKinds[] = {"room", "thin"};
constexpr const char* kSets[] = {"calibration", "evaluation"};
constexpr const char* kShots[] = {"any", "close-up", "grazing"};

class ViewReader {
public:
    ViewReader(const Value& document, fs::path folder, const Log& log)
        : document_(document), folder_(std::move(folder)), log_(log) {}

    AoViewList read() {
        ParamReader reader(document_, "the list of views", problems_);
        std::string help;
        reader.field("help", help, {.help = "What the views are for"});
        readList(reader.take("folders"), "'folders'", [&](const Value& item) { readFolder(item); });
        readList(reader.take("radii"), "'radii'", [&](const Value& item) { readRadius(item); });
        readList(reader.take("scenes"), "'scenes'", [&](const Value& item) { readScene(item); });
        reader.finish();
        if (document_.isObject() && !document_.find("radii"))
            problems_.error(document_.where(), "no 'radii'", "write \"radii\": [0.025]");
        problems_.throwIfErrors();
        std::sort(list_.radii.begin(), list_.radii.end());
        return std::move(list_);
    }

private:
    template <class Each>
    void readList(const Value* list, const char* what, Each each) {
        if (!list) return;
        if (!list->isArray()) {
            problems_.error(list->where(), fmt::format("{} must be a list, found {}", what, list->typeName()),
                            "write [ … ]");
            return;
        }
        for (const Value& item : list->items()) each(item);
    }

    void readFolder(const Value& item) {
        if (item.isString()) return folders_.push_back(folder_ / item.string());
        problems_.error(item.where(), "a folder must be a string", "the path is relative to the list of views");
    }

    void readRadius(const Value& item) {
        if (item.isNumber() && item.number() > 0 && item.number() <= 1) return list_.radii.push_back(item.number());
        problems_.error(item.where(), "a radius must be a number above 0 and at most 1",
                        "radii are shares of the diagonal of the scene's bounding box");
    }

    void readScene(const Value& item) {
        AoScene scene;
        int kind = 0;
        std::string file;
        ParamReader reader(item, "a scene of the list of views", problems_);
        reader.field("name", scene.name, {.help = "Name of the scene"});
        reader.field("file", file, {.help = "Its file"});
        reader.choice("kind", kind, kKinds, {.help = "Which mean its views belong to"});
        readList(reader.take("lights"), "'lights'",
                 [&](const Value& light) { scene.lights.push_back(readStruct<LightFields>(light, "a light").make()); });
        if (const Value* ambient = reader.take("ambient")) {
            scene.ambient = readStruct<Ambient>(*ambient, "the ambient light");
        }
        readList(reader.take("views"), "'views'", [&](const Value& view) { scene.views.push_back(readView(view)); });
        reader.finish();
        scene.kind = kKinds[kind];
        if (scene.name.empty() || file.empty() || scene.views.empty()) {
            problems_.error(item.where(), "a scene needs 'name', 'file' and 'views'", "see tests/bench/ao-views.json");
        } else if (!find(file, scene.path)) {
            log_.note(fmt::format("scene '{}' is left out: there is no file '{}'", scene.name, file));
        } else {
            list_.scenes.push_back(std::move(scene));
        }
    }

    AoView readView(const Value& item) {
        AoView view;
        CameraFields camera;
        int set = 1, shot = 0;
        ParamReader reader(item, "a view", problems_);
        visitFields(reader, camera);
        reader.choice("set", set, kSets, {.help = "Whether techniques may be tuned on it"});
        reader.choice("shot", shot, kShots, {.help = "What is special about it"});
        reader.finish();
        view.name = camera.name;
        view.set = kSets[set];
        view.camera = camera.make();
        return view;
    }

    template <class Fields>
    Fields readStruct(const Value& value, const char* what) {
        Fields fields;
        ParamReader reader(value, what, problems_);
        visitFields(reader, fields);
        reader.finish();
        return fields;
    }

    bool find(const std::string& file, fs::path& found) const {
        std::error_code failed;
        std::vector<fs::path> folders{folder_};
        folders.insert(folders.end(), folders_.begin(), folders_.end());
        for (const fs::path& folder : folders) {
            found = folder / file;
            if (fs::is_regular_file(found, failed)) return true;
        }
        return false;
    }

    const Value& document_;
    fs::path folder_;
    const Log& log_;
    std::vector<fs::path> folders_;
    Problems problems_;
    AoViewList list_;
};

}  // namespace

AoViewList readAoViews(const fs::path& path, const Log& log) {
    const Value document = parseJson(readText(path), path.string());
    return ViewReader(document, path.parent_path(), log).read();
}

void chooseScenes(AoViewList& list, const std::vector<std::string>& wanted, const AssetRoots& roots) {
    if (wanted.empty()) return;
    std::vector<AoScene> chosen;
    for (const std::string& name : wanted) {
        const auto listed =
            std::find_if(list.scenes.begin(), list.scenes.end(), [&](const AoScene& s) { return s.name == name; });
        if (listed != list.scenes.end()) {
            chosen.push_back(*listed);
            continue;
        }
        const SceneFile file = findScene(roots, name);
        AoScene scene;
        scene.name = file.name;
        scene.path = file.path;
        chosen.push_back(std::move(scene));
    }
    list.scenes = std::move(chosen);
}

Scene loadAoScene(AoScene& wanted, const AssetRoots& roots, const Log& log) {
    Scene scene = loadScene(wanted.path, {.log = log, .allowedRoots = roots.roots(), .allowOutside = true});
    for (SceneMaterial& material : scene.materials) material.normalMap = {};
    scene.lights.insert(scene.lights.end(), wanted.lights.begin(), wanted.lights.end());
    if (wanted.ambient) scene.ambient = wanted.ambient;
    if (wanted.views.empty()) {
        for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
            const Camera& camera = scene.cameras[i];
            wanted.views.push_back(
                {camera.name.empty() ? fmt::format("camera {}", i) : camera.name, "evaluation", camera});
        }
        if (wanted.views.empty()) {
            constexpr float kFovY = 0.785398f, kAspect = 16.0f / 9;
            wanted.views.push_back({"framed", "evaluation", frameBounds(scene.bounds(), kFovY, kAspect)});
        }
    }
    for (AoView& view : wanted.views) fitNearFar(view.camera, scene.bounds());
    return scene;
}

}  // namespace crevice
