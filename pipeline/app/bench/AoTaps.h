// How many texels a pipeline's occlusion reads, from its document.
#pragma once

#include "plan/PipelineDesc.h"

namespace crevice {

/// Samples of the technique per texel of its map: 2 · SLICES · STEPS along horizons, else the number of samples; back
/// faces double them. 0 = the document does not say.
double countTaps(const PipelineDesc& desc);

/// Of the denoiser's levels, per texel of the technique's map.
double countDenoiseTaps(const PipelineDesc& desc);

}  // namespace crevice
