// The list of built-in stages; a new one gets a line in each of the two blocks.
#include "Builtin.h"

#include "flow/StageRegistry.h"

namespace crevice {

void registerBackFaceStage(StageRegistry& registry);
void registerComputeStage(StageRegistry& registry);
void registerForwardStage(StageRegistry& registry);
void registerFullscreenStage(StageRegistry& registry);
void registerGbufferStage(StageRegistry& registry);
void registerLightingStage(StageRegistry& registry);
void registerPostProcessStage(StageRegistry& registry);
void registerShadowStage(StageRegistry& registry);
void registerSkyboxStage(StageRegistry& registry);
void registerSsaoStage(StageRegistry& registry);
void registerTransparentStage(StageRegistry& registry);

void registerBuiltinStages(StageRegistry& registry) {
    registerBackFaceStage(registry);
    registerComputeStage(registry);
    registerForwardStage(registry);
    registerFullscreenStage(registry);
    registerGbufferStage(registry);
    registerLightingStage(registry);
    registerPostProcessStage(registry);
    registerShadowStage(registry);
    registerSkyboxStage(registry);
    registerSsaoStage(registry);
    registerTransparentStage(registry);
}

}  // namespace crevice
