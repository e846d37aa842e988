// Cocos' block CCShadow for one light: where its map was drawn from and how it is looked up.
#pragma once

#include <cstddef>
#include <vector>

#include "flow/CocosBlocks.h"
#include "flow/FrameBlocks.h"
#include "flow/ShadowView.h"
#include "plan/PipelineDesc.h"

namespace crevice {

/// What the ShadowStage of a light says; a light's own LightShadow is over it.
struct ShadowSettings {
    float bias = 0.0008f;  ///< Share of the light's depth range.
    int pcf = 2;           ///< Cocos' PCFType.
    glm::vec2 size{1};     ///< Texels of the map.
};

/// Cocos' number of ShadowStage's `pcf`: 0 is 1x1, 1 is 3x3, 2 is 5x5.
int pcfType(int choice);
/// Of the enabled ShadowStage for that light in a document; the defaults of the stage when there is none. `frame` in
/// pixels: a map without a size of its own is a part of it.
ShadowSettings shadowSettings(const PipelineDesc& desc, bool spot, glm::uvec2 frame);

/// 304 bytes of 3.3.1 or 256 of 3.6.1, by profile. Null: everything counts as lit.
std::vector<std::byte> shadowBlock(Profile profile, const ShadowView* view, const Light* light,
                                   const ShadowSettings& settings);

}  // namespace crevice
