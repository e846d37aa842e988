// glTF 2.0 files (.gltf and .glb) as scenes. Hostile files end in an Error, never in a crash; see docs/scenes.md for
// what is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/Limits.h"
#include "core/Log.h"
#include "scene/Scene.h"

namespace crevice {

/// What a scene file may ask for before it is refused.
using LoadLimits = Limits;

/// Is told now and then what is being done and how much of that is, 0 … 1; on the thread that loads.
using LoadProgress = std::function<void(std::string_view what, float share)>;

struct LoadOptions {
    const Log& log;  ///< Receives warnings and notes.
    LoadLimits limits{};
    /// Folder trees that files may be read from, besides the scene's own.
    std::vector<std::filesystem::path> allowedRoots{};
    /// A `.scene.json` may name a glTF anywhere ("../…"). For trusted scenes only.
    bool allowOutside = false;
    std::string scene{};          ///< Name or index of the glTF's scene to show; empty = its default one.
    std::string animation{};      ///< Name or index of the animation to pose by; empty = the first, if `time` is given.
    std::optional<float> time{};  ///< Seconds into the animation; nothing = the rest pose (0 if `animation` is given).
    bool strict = false;          ///< Formal faults that do no harm are errors, not warnings.
    /// Width / height of the pictures to be taken. All that a glTF's camera frames is then in them: one that is wider
    /// than the picture sees more above and below. 0 = unknown: the camera's height counts.
    float aspect = 0;
    LoadProgress progress{};
};

/// Throws Error with the file and the path inside it (`accessors[3]`).
Scene loadGltf(const std::filesystem::path& path, const LoadOptions& options);

}  // namespace crevice
