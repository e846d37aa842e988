// What the occlusion benchmark compares: techniques in their presets, and presets with options changed.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/Files.h"
#include "plan/PipelineAsset.h"

namespace crevice {

/// One column of pictures: a technique, a preset of it and options besides.
struct AoCase {
    std::string technique, quality;
    std::string extras;                          ///< "guard=25 backFaces=true", as given; may be empty.
    std::map<std::string, std::string> options;  ///< All of it, for the pipeline.
    std::vector<StageSet> sets;
    double scale = 1;         ///< Of the raw map's sides: 0.5 = half resolution.
    double taps = 0;          ///< Samples per texel of the raw map; 0 = unknown.
    double denoiseTaps = 0;   ///< Of the blur per texel of the raw map.
    double guard = 0;         ///< Percent of the frame's height.
    bool everyRadius = true;  ///< Otherwise the middle one only.

    std::string label() const;
    double tapsPerPixel() const { return taps * scale * scale; }
};

/// As asked for on the command line; empty lists = what the pipeline offers.
struct AoCaseChoice {
    std::vector<std::string> techniques, qualities, variants;
};

/// The pipeline that renders nothing but the map. Throws Error when it is not below the asset roots.
std::string aoMapPipeline(const AssetRoots& roots);

/// Techniques and presets are those of the pipeline's options; the preset "reference" only when asked for.
/// Throws Error with near names.
std::vector<AoCase> listAoCases(const AssetRoots& roots, const AoCaseChoice& choice);

/// The same case without guard.
AoCase withoutGuard(AoCase c);

/// "TECHNIQUE QUALITY NAME=VALUE …"; a name with a dot is a field of a stage. Throws Error.
AoCase parseAoCase(const AssetRoots& roots, std::string_view text);

/// A list of cases whose cost grows: samples without blur, or blurs over the same samples.
struct AoCurve {
    std::string name;
    std::vector<AoCase> cases;
};
std::vector<AoCurve> listAoCurves(const AssetRoots& roots, const std::vector<AoCase>& cases);

}  // namespace crevice
