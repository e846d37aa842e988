// The shapes that pipelines of Cocos' versions have, and what cannot become a document.
#include "CocosImportTools.h"

#include <gtest/gtest.h>

namespace crevice::cocos {
namespace {

using test::contains;
using test::errorOf;

/// The shape of 3.3.1's deferred pipeline: three flows, the lighting's own phases, the material null.
TEST(CocosImport, TheShapeOf331BecomesThreeStages) {
    ProjectFolder project;
    const PipelineDesc desc = load(project
                                       .import(R"([
      { "__type__": "DeferredPipeline", "_name": "", "_objFlags": 0, "_native": "", "_tag": 0,
        "_flows": [ { "__id__": 1 }, { "__id__": 3 }, { "__id__": 6 } ], "renderTextures": [] },
      { "__type__": "ShadowFlow", "_name": "ShadowFlow", "_priority": 0, "_tag": 0, "_stages": [ { "__id__": 2 } ] },
      { "__type__": "ShadowStage", "_name": "ShadowStage", "_priority": 0, "_tag": 0 },
      { "__type__": "GbufferFlow", "_name": "GbufferFlow", "_priority": 1, "_tag": 0, "_stages": [ { "__id__": 4 } ] },
      { "__type__": "GbufferStage", "_name": "GbufferStage", "_priority": 0, "_tag": 0, "renderQueues": [ { "__id__": 5 } ] },
      { "__type__": "RenderQueueDesc", "isTransparent": false, "sortMode": 0, "stages": [ "deferred" ] },
      { "__type__": "LightingFlow", "_name": "LightingFlow", "_priority": 1, "_tag": 0, "_stages": [ { "__id__": 7 }, { "__id__": 9 } ] },
      { "__type__": "LightingStage", "_name": "LightingStage", "_priority": 0, "_tag": 0, "renderQueues": [ { "__id__": 8 } ], "_deferredMaterial": null },
      { "__type__": "RenderQueueDesc", "isTransparent": true, "sortMode": 1, "stages": [ "default", "deferred" ] },
      { "__type__": "PostprocessStage", "_name": "PostprocessStage", "_priority": 0, "_tag": 0, "_postProcessMaterial": null, "renderQueues": [] } ])")
                                       .text);
    EXPECT_EQ(desc.profile, Profile::Cocos33);
    EXPECT_EQ(stagesOf(desc),
              "ShadowFlow: ShadowStage; GbufferFlow: GbufferStage; LightingFlow: LightingStage PostprocessStage; ");
    EXPECT_EQ(stage(desc, "GbufferStage").queues.at(0).phases, std::vector<std::string>{"deferred"});
    EXPECT_EQ(stage(desc, "LightingStage").queues.at(0).phases, (std::vector<std::string>{"default", "deferred"}));
    EXPECT_EQ(stage(desc, "PostprocessStage").stageClass, "PostProcessStage");
}

/// Forward pipelines of all versions; the template's second queue has the planar shadows' phase as well.
TEST(CocosImport, TheShapeOfForwardPipelinesKeepsItsPhases) {
    ProjectFolder project;
    const PipelineDesc desc = load(project
                                       .import(R"([
      { "__type__": "ForwardPipeline", "_flows": [ { "__id__": 1 }, { "__id__": 3 } ], "materials": [] },
      { "__type__": "ShadowFlow", "_priority": 0, "_stages": [ { "__id__": 2 } ] },
      { "__type__": "ShadowStage" },
      { "__type__": "ForwardFlow", "_name": "ForwardFlow", "_priority": 1, "_material": null, "_stages": [ { "__id__": 4 } ] },
      { "__type__": "ForwardStage", "_name": "ForwardStage", "frameBuffer": "", "renderQueues": [ { "__id__": 5 }, { "__id__": 6 } ] },
      { "__type__": "RenderQueueDesc", "isTransparent": false, "sortMode": 0, "stages": [ "default" ] },
      { "__type__": "RenderQueueDesc", "isTransparent": true, "sortMode": 1, "stages": [ "default", "planarShadow" ] } ])")
                                       .text);
    EXPECT_EQ(stagesOf(desc), "ShadowFlow: SpotShadowStage ShadowStage; ForwardFlow: ForwardStage TransparentStage; ");
    EXPECT_EQ(stage(desc, "TransparentStage").queues.at(0).phases,
              (std::vector<std::string>{"default", "planarShadow"}));
    EXPECT_FALSE(contains(project.notes, "frameBuffer")) << project.notes;
}

/// 3.7 and later have a flow of reflection probes; a bloom stage has its material and, in some versions, queues.
TEST(CocosImport, LaterFlowsThatAreNotDrawnAreNotes) {
    ProjectFolder project;
    const PipelineDesc desc = load(project
                                       .import(R"([
      { "__type__": "DeferredPipeline", "_flows": [ { "__id__": 1 }, { "__id__": 3 } ] },
      { "__type__": "ReflectionProbeFlow", "_stages": [ { "__id__": 2 } ] },
      { "__type__": "ReflectionProbeStage", "renderQueues": [] },
      { "__type__": "MainFlow", "_stages": [ { "__type__": "GbufferStage" },
          { "__type__": "BloomStage", "_bloomMaterial": null, "renderQueues": [] } ] } ])")
                                       .text);
    EXPECT_EQ(stagesOf(desc), "MainFlow: GbufferStage; ");
    EXPECT_TRUE(contains(project.notes, "flow 'ReflectionProbeFlow' is left out")) << project.notes;
    EXPECT_TRUE(contains(project.notes, "stage 'BloomStage' is left out"));
}

TEST(CocosImport, APipelineThatDrawsNothingIsAnError) {
    ProjectFolder project;
    const std::string text = errorOf([&] {
        project.import(
            R"({ "__type__": "DeferredPipeline", "_flows": [ { "__type__": "F", "_stages": [ { "__type__": "BloomStage" } ] } ] })");
    });
    EXPECT_TRUE(contains(text, "no stage of pipeline 'mine' is drawn")) << text;
}

TEST(CocosImport, FlowsThatCannotBeReadAreNotReplaced) {
    ProjectFolder project;
    const std::string text =
        errorOf([&] { project.import(R"({ "__type__": "DeferredPipeline", "_flows": [ { "__id__": 4 } ] })"); });
    EXPECT_TRUE(contains(text, "item 0 of '_flows' is object 4, but this file has 1")) << text;
    EXPECT_FALSE(contains(text, "default ones"));
}

TEST(CocosImport, TheEnginesEffectsAreAskedFor) {
    ProjectFolder project;
    const std::string lighting =
        R"({ "__type__": "DeferredPipeline", "_flows": [ { "__type__": "F", "_stages": [ { "__type__": "LightingStage" } ] } ] })";
    project.import(lighting);
    EXPECT_TRUE(contains(project.notes, "effect 'pipeline/deferred-lighting' of stage 'LightingStage' is the engine's"))
        << project.notes;
    project.notes.clear();
    project.write("engine/editor/assets/effects/pipeline/deferred-lighting.effect", "");
    project.import(lighting, "", project.folder.path() / "engine");
    EXPECT_FALSE(contains(project.notes, "is the engine's")) << project.notes;
}

TEST(CocosImport, AMaterialOfAnotherKindThanAnEffectIsSaidSo) {
    ProjectFolder project;
    project.write(
        "assets/pipeline/ssao.mtl",
        std::string(R"({ "__type__": "cc.Material", "_effectAsset": { "__uuid__": ")") + kMaterial + "\" } }");
    const std::string text = errorOf([&] { project.import(mainFlow(kSsao)); });
    EXPECT_TRUE(contains(text, "the effect of material 'ssao' is '")) << text;
    EXPECT_TRUE(contains(text, "ssao.mtl', which is none"));
    EXPECT_TRUE(contains(text, "name an .effect file"));
}

}  // namespace
}  // namespace crevice::cocos
