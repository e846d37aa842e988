// One branch per profile; each block is uploaded once.
#include "flow/FrameUpload.h"

#include "flow/CocosFrame.h"
#include "flow/CocosMacros.h"
#include "flow/FrameData.h"

namespace crevice {
namespace {

template <class Block>
void upload(GlobalSet& globals, std::string_view name, const Block& block) {
    globals.upload(name, std::as_bytes(std::span(&block, 1)));
}

void uploadCamera(GlobalSet& globals, const PipelineDesc& desc, const FrameView& view, const Scene& scene,
                  const CocosLook& look) {
    if (desc.profile == Profile::Cocos33) {
        upload(globals, "CCGlobal", globalBlock(view));
        upload(globals, "CCCamera", cocosCamera33(view, scene, look));
    } else {
        upload(globals, "CCGlobal", cocosGlobal36(view));
        upload(globals, "CCCamera", cocosCamera36(view, scene, look));
    }
}

void uploadMainShadow(GlobalSet& globals, const PipelineDesc& desc, const FrameView& view, const Scene& scene,
                      const Aabb& bounds, bool drawn) {
    const auto seen = drawn ? directionalShadowView(scene, bounds) : std::nullopt;
    globals.upload("CCShadow", shadowBlock(desc.profile, seen ? &*seen : nullptr, mainLight(scene),
                                           shadowSettings(desc, false, view.extent)));
}

bool isForward(const PipelineDesc& desc) {
    for (const FlowDesc& flow : desc.flows)
        for (const StageDesc& stage : flow.stages)
            if (stage.stageClass == "ForwardStage" && stage.enabled) return true;
    return false;
}

FrameLights uploadSingleLights(LocalSet& locals, const PipelineDesc& desc, const FrameView& view, const Scene& scene,
                               const Aabb& bounds, const CocosLook& look) {
    FrameLights out;
    std::vector<SingleLightBlock> blocks;
    const auto seen = look.spotShadows ? spotShadowView(scene, bounds) : std::nullopt;
    const Light* shadowed = seen ? shadowedSpot(scene) : nullptr;
    for (const std::size_t index : relevantLights(view, scene, out.left, kSingleLights)) {
        const Light& light = scene.lights[index];
        blocks.push_back(singleLight(cocosLights(view, scene, {index}, look), 0));
        const bool casts = &light == shadowed;
        out.single.push_back({.reach = cocosReach(light, view.exposure),
                              .shadow = shadowBlock(desc.profile, casts ? &*seen : nullptr, &light,
                                                    shadowSettings(desc, true, view.extent))});
    }
    locals.writeSingleLights(blocks);
    return out;
}

}  // namespace

FrameLights uploadFrame(GlobalSet& globals, LocalSet& locals, const PipelineDesc& desc, const FrameView& view,
                        const Scene& scene, const Aabb& bounds, std::uint32_t environmentLevels) {
    if (!isCocos(desc.profile)) {
        upload(globals, "CCGlobal", globalBlock(view));
        upload(globals, "CCCamera", cameraBlock(view, scene));
        return {};
    }
    const CocosLook look{.hdr = cocosHdr(desc),
                         .shadows = drawsShadows(desc, "directional"),
                         .spotShadows = drawsShadows(desc, "spot"),
                         .environmentLevels = environmentLevels};
    uploadCamera(globals, desc, view, scene, look);
    uploadMainShadow(globals, desc, view, scene, bounds, look.shadows);
    FrameLights lights;
    locals.writeLights(cocosLights(view, scene, relevantLights(view, scene, lights.left), look));
    return isForward(desc) ? uploadSingleLights(locals, desc, view, scene, bounds, look) : lights;
}

}  // namespace crevice
