// A .rpp file as plain structs: pipeline, flows, stages, queues, in the order written. No class is looked up here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cocos/assets/TypedValue.h"

namespace crevice::cocos {

/// RenderQueueDesc.
struct RppQueue {
    bool transparent = false;
    bool backToFront = false;           ///< `sortMode` 1.
    std::vector<std::string> phases{};  ///< The field `stages`, as written: an empty word is a phase of its own.
    SourceLoc where{};
};

/// A field that only the class knows, such as a user's `ssaoMaterial`.
struct RppField {
    std::string name{};
    TypedValue value{};
    SourceLoc where{};  ///< Of the name.
};

struct RppStage {
    std::string type{}, name{};
    std::int64_t priority = 0, tag = 0;
    bool enabled = true;
    std::vector<RppQueue> queues{};
    std::vector<RppField> fields{};  ///< All others but the editor's bookkeeping; null ones too.
    SourceLoc where{};               ///< Of its type.
    const RppField* field(std::string_view wanted) const;
};

struct RppFlow {
    std::string type{}, name{};
    std::int64_t priority = 0, tag = 0;
    AssetRef material{};               ///< Of templates of old versions; nothing uses it.
    std::vector<RppStage> stages{};    ///< In order of execution: by ascending priority, equal ones as written.
    std::vector<std::string> moved{};  ///< Stages that their priority put elsewhere than where they are written.
    SourceLoc where{};
};

/// RenderTextureConfig: a texture asset that the pipeline draws into.
struct RppRenderTexture {
    std::string name{};
    AssetRef texture{};
    SourceLoc where{};
};

/// RenderTextureDesc: an image described in place; -1 = as large as the frame.
struct RppTextureDesc {
    std::string name{};
    std::int64_t type = 1, usage = 0, format = 0;
    std::int64_t width = -1, height = -1;
    SourceLoc where{};
};

/// MaterialConfig (3.3's forward pipeline).
struct RppMaterial {
    std::string name{};
    AssetRef material{};
    SourceLoc where{};
};

/// ColorDesc and DepthStencilDesc: enums are Cocos' integers, defaults its own.
struct RppAttachment {
    std::int64_t format = 0, loadOp = 2, storeOp = 0, stencilLoadOp = 2, stencilStoreOp = 0, sampleCount = 1;
    SourceLoc where{};
};

/// RenderPassDesc.
struct RppRenderPass {
    std::int64_t index = -1;
    std::vector<RppAttachment> colors{};
    std::vector<RppAttachment> depthStencil{};  ///< One or none.
    SourceLoc where{};
};

/// FrameBufferDesc.
struct RppFrameBuffer {
    std::string name{};
    std::int64_t renderPass = 0;
    std::vector<std::string> colorTextures{};
    std::string depthStencilTexture{};
    AssetRef texture{};
    SourceLoc where{};
};

struct RppPipeline {
    std::string type{}, name{}, path{};
    std::int64_t tag = 0;
    std::vector<RppFlow> flows{};  ///< As written: priorities of flows sort nothing.
    std::vector<RppRenderTexture> renderTextures{};
    std::vector<RppTextureDesc> textures{};
    std::vector<RppMaterial> materials{};
    std::vector<RppRenderPass> renderPasses{};
    std::vector<RppFrameBuffer> frameBuffers{};
    std::vector<RppField> fields{};  ///< Of a user's class.
    SourceLoc where{};
};

/// Throws Error for a file that is no pipeline at all; collects what is wrong inside one.
RppPipeline readRpp(const std::filesystem::path& path, Problems& problems);
RppPipeline parseRpp(std::string_view text, const std::string& file, Problems& problems);

}  // namespace crevice::cocos
