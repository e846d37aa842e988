// A camera comes from the scene, from --eye, or frames the scene; --fov, --ortho, --near and --far change any of them.
#include "app/commands/ViewOptions.h"

#include <charconv>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <glm/gtc/constants.hpp>

#include "app/commands/ArgumentText.h"
#include "core/Error.h"
#include "core/Text.h"
#include "scene/Framing.h"

namespace crevice {
namespace {

constexpr float kDefaultFovY = 0.785398f;  // 45°, as in Camera

std::optional<glm::vec3> readVector(const char* option, const std::string& text) {
    if (text.empty()) return std::nullopt;
    return parseVector(option, text);
}

/// A number in ]min, max[.
std::optional<float> readBetween(const char* option, const std::string& text, double min, double max,
                                 const char* help) {
    if (text.empty()) return std::nullopt;
    const double value = parseNumber(option, text);
    if (value <= min || value >= max) throw Error(fmt::format("{}: '{}' is out of range", option, text), help);
    return static_cast<float>(value);
}

void checkTogether(const ViewChoice& view) {
    if (!view.camera.empty() && view.eye) {
        throw Error("--camera and --eye contradict each other", "choose a camera of the scene or place one, not both");
    }
    if (!view.eye && (view.target || view.up)) {
        throw Error(fmt::format("{} needs --eye", view.target ? "--target" : "--up"),
                    "place the camera: --eye 0,1,4 --target 0,0,0");
    }
    if (view.fov && view.ortho) {
        throw Error("--fov and --ortho contradict each other", "--fov is for perspective, --ortho for parallel views");
    }
    if (view.eye && view.target && *view.eye == *view.target) {
        throw Error("--eye and --target are the same point",
                    "the camera looks from one to the other: move one of them");
    }
    if (view.up && *view.up == glm::vec3(0)) throw Error("--up: '0,0,0' has no direction", "write --up 0,1,0");
    if (view.near && view.far && *view.near >= *view.far) {
        throw Error("--near is not in front of --far", "--near must be the smaller distance");
    }
}

Error noSuchCamera(const std::string& wanted, const Scene& scene) {
    if (scene.cameras.empty()) {
        return Error(fmt::format("--camera: the scene has no cameras, so none named '{}'", wanted),
                     "leave --camera out, or place one with --eye and --target");
    }
    std::vector<std::string> names, listed;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        names.push_back(scene.cameras[i].name);
        listed.push_back(fmt::format("{} '{}'", i, scene.cameras[i].name));
    }
    const std::vector<std::string> near = nearestNames(wanted, names, 1);
    const std::string hint = near.empty() ? "" : fmt::format("did you mean '{}'? ", near.front());
    return Error(fmt::format("--camera: the scene has no camera '{}'", wanted), hint + "cameras: " + join(listed));
}

Camera findCamera(const std::string& wanted, const Scene& scene) {
    for (const Camera& camera : scene.cameras) {
        if (camera.name == wanted) return camera;
    }
    std::size_t index = 0;
    const char* last = wanted.data() + wanted.size();
    const auto [end, failed] = std::from_chars(wanted.data(), last, index);
    if (failed != std::errc() || end != last || index >= scene.cameras.size()) throw noSuchCamera(wanted, scene);
    return scene.cameras[index];
}

}  // namespace

void addViewOptions(CLI::App& command, ViewOptions& options, bool withBackground) {
    const auto add = [&](const char* name, std::string& value, const char* type, const char* help) {
        command.add_option(name, value, help)->type_name(type)->group("View");
    };
    add("--size", options.size, "WxH", "Pixels of the picture, 1 to 16384 each; default 1280x720");
    add("--camera", options.camera, "NAME|INDEX",
        "Camera of the scene; default the first, else one that frames the scene");
    add("--eye", options.eye, "x,y,z", "Place of the camera");
    add("--target", options.target, "x,y,z", "Point that it looks at; default the scene's centre");
    add("--up", options.up, "x,y,z", "Direction that is up in the picture; default 0,1,0");
    add("--fov", options.fov, "DEG", "Vertical field of view in degrees");
    add("--ortho", options.ortho, "HEIGHT", "Parallel projection of that many world units");
    add("--near", options.near, "DIST", "Nearest distance seen; default from the scene");
    add("--far", options.far, "DIST", "Farthest distance seen; default from the scene");
    if (!withBackground) return;
    add("--background", options.background, "COLOR",
        "Behind everything: transparent, #rrggbb, r,g,b or a name; default black");
}

ViewChoice readView(const ViewOptions& options) {
    constexpr double kMax = 1e30;
    ViewChoice view;
    if (!options.size.empty()) view.size = parseSize("--size", options.size);
    if (!options.background.empty()) view.background = parseColor("--background", options.background);
    view.camera = options.camera;
    view.eye = readVector("--eye", options.eye);
    view.target = readVector("--target", options.target);
    view.up = readVector("--up", options.up);
    view.fov = readBetween("--fov", options.fov, 0, 180, "write degrees between 0 and 180");
    if (view.fov) view.fov = glm::radians(*view.fov);
    view.ortho = readBetween("--ortho", options.ortho, 0, kMax, "write a height above 0");
    view.near = readBetween("--near", options.near, 0, kMax, "write a distance above 0");
    view.far = readBetween("--far", options.far, 0, kMax, "write a distance above 0");
    checkTogether(view);
    return view;
}

std::optional<Camera> chooseCamera(const ViewChoice& view, const Scene& scene) {
    const bool changed = view.fov || view.ortho || view.near || view.far;
    if (view.camera.empty() && !view.eye && !changed) return std::nullopt;
    const Aabb bounds = scene.bounds();
    Camera camera;
    if (!view.camera.empty()) {
        camera = findCamera(view.camera, scene);
    } else if (view.eye) {
        camera = Camera::lookAt(*view.eye, view.target.value_or(bounds.centre()), view.up.value_or(glm::vec3(0, 1, 0)));
    } else if (!scene.cameras.empty()) {
        camera = scene.cameras.front();
    } else {
        const float aspect = static_cast<float>(view.size.x) / static_cast<float>(view.size.y);
        camera = frameOutline(outlineOf(scene), bounds, view.fov.value_or(kDefaultFovY), aspect);
        camera.near = camera.far = 0;
    }
    if (view.fov) {
        camera.orthographic = false;
        camera.fovY = *view.fov;
    }
    if (view.ortho) {
        camera.orthographic = true;
        camera.orthoHeight = *view.ortho;
    }
    if (view.near) camera.near = *view.near;
    if (view.far) camera.far = *view.far;
    if (camera.near > 0 && camera.far > 0 && camera.near >= camera.far) {
        throw Error(fmt::format("the camera's near distance {} is not in front of its far distance {}", camera.near,
                                camera.far),
                    "choose --near and --far so that near < far");
    }
    return camera;
}

Camera resolveCamera(const ViewChoice& view, const Scene& scene) {
    const Aabb bounds = scene.bounds();
    std::optional<Camera> camera = chooseCamera(view, scene);
    if (!camera && !scene.cameras.empty()) camera = scene.cameras.front();
    if (!camera) {
        const float aspect = static_cast<float>(view.size.x) / static_cast<float>(view.size.y);
        camera = frameOutline(outlineOf(scene), bounds, kDefaultFovY, aspect);
    }
    fitNearFar(*camera, bounds);
    return *camera;
}

}  // namespace crevice
