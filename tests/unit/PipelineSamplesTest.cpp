// The documents that the design was drawn with load as they stand there.
#include "PipelineTestTools.h"

namespace crevice {
namespace {

using test::stageOf;
using test::stageOrder;

constexpr const char* kDeferred = R"({
  "$schema": "../schema/pipeline.schema.json",
  "name": "deferred",
  "help": "Cocos 3.3 style deferred shading: G-buffer, lighting, post-process.",
  "output": "finalColor",
  "targets": {
    "cc_gbuffer_albedoMap":   { "format": "RGBA16F", "help": "diffuse colour" },
    "cc_gbuffer_positionMap": { "format": "RGBA16F", "help": "world position, roughness" },
    "cc_gbuffer_normalMap":   { "format": "RGBA16F", "help": "world normal, metallic" },
    "cc_gbuffer_emissiveMap": { "format": "RGBA16F", "help": "emissive, occlusion" },
    "cc_lighting_resultMap":  { "format": "RGBA16F", "sampler": "linear-clamp" },
    "viewDepth":              { "format": "R32F", "clear": 1e9, "help": "linear view depth, sky = far away; written by GbufferStage" },
    "depth":                  { "format": "D32F", "clear": 1.0 },
    "finalColor":             { "format": "RGBA8" }
  },
  "flows": [
    { "flow": "ShadowFlow", "priority": 0, "stages": [ { "stage": "ShadowStage" } ] },
    { "flow": "GbufferFlow", "priority": 1, "stages": [
      { "stage": "GbufferStage", "queues": [ { "phase": "default", "sort": "front-to-back" } ] } ] },
    { "flow": "LightingFlow", "priority": 5, "stages": [
      { "stage": "LightingStage", "effect": "deferred-lighting" },
      { "stage": "SkyboxStage" },
      { "stage": "TransparentStage", "queues": [ { "phase": "default", "sort": "back-to-front" } ] },
      { "stage": "PostProcessStage", "effect": "post-process", "material": { "exposure": 1.0 } } ] }
  ]
})";

constexpr const char* kSsaoDeferred = R"({
  "$schema": "../schema/pipeline.schema.json",
  "name": "ssao-deferred",
  "extends": "deferred",
  "help": "deferred, with blurred screen-space ambient occlusion on albedo.",
  "options": {
    "ssao": { "type": "bool", "default": true, "help": "Off renders exactly 'deferred'." }
  },
  "targets": {
    "cc_ssaoMap":     { "format": "R8", "binding": 11, "clear": [1, 1, 1, 1], "help": "1 = open, 0 = occluded; what SsaoStage writes" },
    "cc_ssaoBlurMap": { "format": "R8", "binding": 13, "clear": [1, 1, 1, 1], "help": "blurred; what the default lighting effect samples" }
  },
  "blocks": { "CCSsao": { "binding": 12 } },
  "edits": [
    { "insert": { "stage": "SsaoStage", "enabled": "$ssao", "params": { "seed": 7 }, "material": { "radius": "auto" } },
      "before": "LightingStage" },
    { "insert": { "stage": "FullscreenStage", "name": "SsaoBlur", "effect": "ssao-blur", "writes": ["cc_ssaoBlurMap"] }, "after": "SsaoStage" },
    { "set": "LightingStage", "effect": "ssao-lighting" }
  ]
})";

constexpr const char* kVignette = R"({
  "name": "ssao-vignette",
  "extends": "ssao-deferred",
  "targets": { "vignetted": { "format": "RGBA8", "like": "finalColor" } },
  "output": "vignetted",
  "edits": [
    { "insert": { "stage": "FullscreenStage", "name": "Vignette", "effect": "vignette",
                  "reads": { "inputMap": "finalColor" }, "writes": [ "vignetted" ], "material": { "strength": 0.4 } },
      "after": "PostProcessStage" }
  ]
})";

PipelineDesc load(const std::string& name, std::map<std::string, std::string> options = {}) {
    test::AssetFolder folder;
    folder.pipeline("deferred", kDeferred);
    folder.pipeline("ssao-deferred", kSsaoDeferred);
    folder.pipeline("ssao-vignette", kVignette);
    return loadPipeline(folder.roots(), {.nameOrPath = name, .options = std::move(options), .sets = {}});
}

TEST(PipelineSamples, Deferred) {
    EXPECT_EQ(stageOrder(load("deferred")),
              "ShadowFlow: ShadowStage\nGbufferFlow: GbufferStage\n"
              "LightingFlow: LightingStage SkyboxStage TransparentStage PostProcessStage\n");
}

TEST(PipelineSamples, SsaoDeferred) {
    const PipelineDesc desc = load("ssao-deferred");
    EXPECT_EQ(stageOrder(desc),
              "ShadowFlow: ShadowStage\nGbufferFlow: GbufferStage\n"
              "LightingFlow: SsaoStage SsaoBlur LightingStage SkyboxStage TransparentStage PostProcessStage\n");
    EXPECT_EQ(stageOf(desc, "LightingStage").effect, "ssao-lighting");
    EXPECT_FALSE(stageOf(load("ssao-deferred", {{"ssao", "false"}}), "SsaoStage").enabled);
}

TEST(PipelineSamples, AStageWithNoCode) {
    const PipelineDesc desc = load("ssao-vignette");
    EXPECT_EQ(desc.output, "vignetted");
    EXPECT_EQ(desc.findTarget("vignetted")->format, Format::RGBA8);
    EXPECT_EQ(stageOf(desc, "Vignette").reads.at(0).target, "finalColor");
    EXPECT_EQ(desc.flows.back().stages.back().name, "Vignette");
}

}  // namespace
}  // namespace crevice
