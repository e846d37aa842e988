// From where a scene is looked at, how large the picture is and what stands behind it.
#pragma once

#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "scene/Scene.h"

namespace CLI {
class App;
}

namespace crevice {

/// As given; empty = not given.
struct ViewOptions {
    std::string size, camera, eye, target, up, fov, ortho, near, far, background;
};
/// Without --background where no picture is made.
void addViewOptions(CLI::App& command, ViewOptions& options, bool withBackground = true);

/// The checked numbers of ViewOptions.
struct ViewChoice {
    glm::uvec2 size{1280, 720};
    glm::vec4 background{0, 0, 0, 1};
    std::string camera;  ///< Name or index.
    std::optional<glm::vec3> eye, target, up;
    std::optional<float> fov, ortho, near, far;  ///< fov in radians.
};
/// Throws Error.
ViewChoice readView(const ViewOptions& options);

/// The camera for a scene; nothing when the options leave it open. Throws Error: no such camera, near behind far.
std::optional<Camera> chooseCamera(const ViewChoice& view, const Scene& scene);

/// The camera that Renderer takes for the same choice: the scene's first or one that frames it where the options leave
/// it open, with near and far filled in. Throws Error.
Camera resolveCamera(const ViewChoice& view, const Scene& scene);

}  // namespace crevice
