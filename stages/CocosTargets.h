// Names of the images that Cocos' deferred stages pass on, by profile. A document declares targets of these names.
#pragma once

#include "flow/RenderStage.h"

namespace crevice {

/// The G-buffer's colours in the order of the geometry shaders' outputs.
inline std::vector<const char*> gbufferTargets(Profile profile) {
    if (profile == Profile::Cocos36) return {"gbufferAlbedo", "gbufferNormal", "gbufferEmissive"};
    return {"cc_gbuffer_albedoMap", "cc_gbuffer_positionMap", "cc_gbuffer_normalMap", "cc_gbuffer_emissiveMap"};
}

inline const char* litTarget(Profile profile) {
    return profile == Profile::Cocos36 ? "lightingResult" : "cc_lighting_resultMap";
}

/// From 3.4 on stages bind the G-buffer to the numbers 0, 1, 2 of their material and depth to 3; before, set 0 has it.
inline void bindGbuffer(StageIo& io, DrawId draw) {
    if (io.profile() != Profile::Cocos36) return;
    std::uint32_t number = 0;
    for (const char* target : gbufferTargets(io.profile())) io.input(draw, number++, target);
    io.input(draw, number, "depth");
}

/// One queue for each that the document lists, else the given one.
inline std::vector<QueueId> declareQueues(StageIo& io, const char* phase, QueueSort sort, const char* effect) {
    std::vector<QueueId> queues;
    const std::size_t count = std::max<std::size_t>(1, io.documentQueues().size());
    while (queues.size() < count) queues.push_back(io.queue(phase, sort, effect));
    return queues;
}

}  // namespace crevice
