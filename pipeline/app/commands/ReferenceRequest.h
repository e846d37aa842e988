// What `crevice reference` was asked for: options as text, and checked.
#pragma once

#include <string>
#include <vector>

#include "app/commands/Console.h"
#include "app/commands/SceneFiles.h"
#include "app/commands/ViewOptions.h"
#include "core/Image.h"
#include "truth/AmbientReference.h"
#include "truth/HeightfieldReference.h"

namespace crevice {

struct ReferenceOptions {
    std::string scene, out, samples = "1024", seed = "1", depth, heightfield, thickness = "0.5", slices = "64";
    std::vector<std::string> radius, falloff, measure, heat;
    ViewOptions view;
    ConsoleOptions console;
    bool noCache = false;
    SceneOptions loading;
};

/// A map to make: its radius as it was written, for the name of its file.
struct WantedMap {
    std::string radiusText;
    AmbientTerm term;
};

/// All that is checked before a scene is loaded.
struct ReferenceRequest {
    ViewChoice view;
    std::vector<WantedMap> wanted;
    std::vector<WantedMap> radii{};  ///< One per radius: the heightfield knows the hard falloff alone.
    std::vector<std::string> names{}, heightfieldNames{};
    AmbientSettings settings{};
    HeightfieldSettings heightfield{};
    std::vector<std::vector<float>> measured{};
    Image depth{};
};

/// Throws Error.
ReferenceRequest readRequest(const ReferenceOptions& options);

}  // namespace crevice
