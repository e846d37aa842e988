// An environment as Cocos' effects look it up: cubes of colours that they square.
#pragma once

#include <cstdint>
#include <vector>

#include "core/Image.h"
#include "scene/Environment.h"
#include "scene/EnvironmentCube.h"

namespace crevice {

/// RGBA16F; [level][face]. A texel squared, times `scale`, is radiance: turned and with the intensity in it.
struct CocosCubes {
    std::vector<std::vector<Image>> mirrored;  ///< cc_environment: level l of n holds roughness l / (n - 1).
    std::vector<std::vector<Image>> diffuse;   ///< cc_diffuseMap: one level of irradiance / pi.
};
CocosCubes cocosCubes(const Environment& environment, const EnvironmentCube& cube, float scale);

}  // namespace crevice
