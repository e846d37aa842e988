// A name is looked up below the asset roots; whatever ends like a scene file is a path.
#include "app/commands/SceneFiles.h"

#include <system_error>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/ArgumentText.h"
#include "core/Error.h"
#include "core/Text.h"
#include "scene/Primitives.h"
#include "scene/SceneAsset.h"

namespace crevice {

SceneFile findScene(const AssetRoots& roots, const std::string& argument) {
    const std::filesystem::path path = argument;
    for (const std::string ending : {".scene.json", ".gltf", ".glb", ".scene"}) {
        const std::string file = path.filename().string();
        if (!file.ends_with(ending) || file == ending) continue;
        std::error_code failed;
        if (!std::filesystem::exists(path, failed)) {
            throw Error(fmt::format("scene '{}' does not exist", argument), "check the path");
        }
        return {path, file.substr(0, file.size() - ending.size())};
    }
    if (const auto found = roots.find(AssetKind::Scene, argument)) return {*found, path.filename().string()};
    std::error_code failed;
    if (std::filesystem::exists(path, failed)) {
        throw Error(fmt::format("'{}' is not a scene that can be read", argument),
                    "scenes end in .gltf, .glb, .scene.json or .scene");
    }
    throw Error(fmt::format("no scene named '{}'", argument),
                didYouMean(argument, roots.list(AssetKind::Scene), "shipped scenes") +
                    "; files end in .gltf, .glb or .scene.json");
}

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    const auto add = [&](const char* name, std::string& value, const char* type, const char* help) {
        command.add_option(name, value, help)->type_name(type);
    };
    // `crevice validate` has its own --scene, which names a file.
    if (!command.get_option_no_throw("--scene"))
        add("--scene", options.scene, "NAME|INDEX", "Scene of a glTF with several; default the one it names");
    add("--animation", options.animation, "NAME|INDEX", "Animation that poses a glTF; default the first, with --time");
    add("--time", options.time, "SECONDS", "Moment of the animation; default the rest pose");
    command.add_flag("--strict", options.strict, "Faults of a glTF that do no harm are errors, too");
    command
        .add_option("--allow-path", options.allowedPaths, "Folder tree that the scene may read as well (repeatable)")
        ->type_name("DIR")
        ->allow_extra_args(false);
    command.add_flag("--allow-outside", options.allowOutside, "Let a .scene.json name a glTF outside its folder");
    command.add_option("--limit", options.limits, "Raise or lower a limit of `crevice limits` (repeatable)")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
}

LoadOptions makeLoadOptions(const AssetRoots& roots, const Log& log, const SceneOptions& options) {
    LoadOptions load{.log = log, .allowedRoots = roots.roots(), .allowOutside = options.allowOutside};
    for (const std::string& path : options.allowedPaths) {
        std::error_code failed;
        if (!std::filesystem::is_directory(path, failed))
            throw Error(fmt::format("--allow-path: '{}' is not a folder", path), "name a folder that exists");
        load.allowedRoots.emplace_back(path);
    }
    for (const std::string& limit : options.limits) setLimit(load.limits, limit);
    load.scene = options.scene;
    load.animation = options.animation;
    load.strict = options.strict;
    load.aspect = options.aspect;
    load.progress = options.progress;
    if (!options.time.empty()) {
        const double seconds = parseNumber("--time", options.time);
        if (!(seconds >= 0 && seconds <= 1e6))
            throw Error(fmt::format("--time: '{}' is out of range", options.time), "write seconds from 0 to 1000000");
        load.time = static_cast<float>(seconds);
    }
    return load;
}

Scene loadSceneFile(const SceneFile& file, const AssetRoots& roots, const Log& log, const SceneOptions& options) {
    return loadScene(file.path, makeLoadOptions(roots, log, options));
}

Scene makeSampleScene() {
    Scene scene;
    scene.name = "sample";
    scene.meshes.push_back(makeBox({1, 1, 1}));
    scene.materials.emplace_back();
    scene.instances.emplace_back();
    addDefaultLight(scene, false);
    return scene;
}

}  // namespace crevice
