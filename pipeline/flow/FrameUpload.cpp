// One branch per profile; each block is uploaded once.
#include "flow/FrameUpload.h"

#include "flow/CocosFrame.h"
#include "flow/FrameData.h"

namespace crevice {
namespace {

template <class Block>
void upload(GlobalSet& globals, std::string_view name, const Block& block) {
    globals.upload(name, std::as_bytes(std::span(&block, 1)));
}

}  // namespace

int uploadFrame(GlobalSet& globals, LocalSet& locals, const PipelineDesc& desc, const FrameView& view,
                const Scene& scene) {
    if (!isCocos(desc.profile)) {
        upload(globals, "CCGlobal", globalBlock(view));
        upload(globals, "CCCamera", cameraBlock(view, scene));
        return 0;
    }
    const bool hdr = cocosHdr(desc);
    if (desc.profile == Profile::Cocos33) {
        upload(globals, "CCGlobal", globalBlock(view));
        upload(globals, "CCCamera", cocosCamera33(view, scene, hdr));
    } else {
        upload(globals, "CCGlobal", cocosGlobal36(view));
        upload(globals, "CCCamera", cocosCamera36(view, scene, hdr));
    }
    int left = 0;
    locals.writeLights(cocosLights(view, scene, relevantLights(view, scene, left)));
    return left;
}

}  // namespace crevice
