// The pipelines that Crevice ships load, in every combination of their options, and are what they claim to be.
#include "PipelineTestTools.h"

namespace crevice {
namespace {

using test::stageOf;
using test::stageOrder;

PipelineDesc shipped(const std::string& name, std::map<std::string, std::string> options = {}) {
    return loadPipeline(AssetRoots::standard(), {.nameOrPath = name, .options = std::move(options), .sets = {}});
}

TEST(PipelineShipped, Deferred) {
    const PipelineDesc desc = shipped("deferred");
    EXPECT_EQ(stageOrder(desc),
              "ShadowFlow: ShadowStage SpotShadowStage\nGbufferFlow: GbufferStage\n"
              "LightingFlow: LightingStage SkyboxStage TransparentStage PostProcessStage Fxaa\n");
    EXPECT_EQ(desc.output, "finalColor");
    EXPECT_EQ(desc.findTarget("cc_shadowMap")->size, glm::uvec2(1024, 1024));
    EXPECT_EQ(desc.findTarget("viewDepth")->clear.x, 1e9f);
    EXPECT_EQ(desc.findTarget("cc_lighting_resultMap")->sampler, SamplerKind::LinearClamp);
    EXPECT_EQ(stageOf(desc, "TransparentStage").queues.at(0).sort, QueueSort::BackToFront);
    EXPECT_EQ(stageOf(desc, "PostProcessStage").writes, std::vector<std::string>{"toneMapped"});
}

TEST(PipelineShipped, WithoutFxaaToneMappingWritesThePicture) {
    const PipelineDesc desc = shipped("deferred", {{"fxaa", "false"}});
    EXPECT_FALSE(stageOf(desc, "Fxaa").enabled);
    EXPECT_EQ(stageOf(desc, "PostProcessStage").writes, std::vector<std::string>{"finalColor"});
}

TEST(PipelineShipped, WithoutShadowsTheFlowIsOff) {
    const PipelineDesc desc = shipped("deferred", {{"shadows", "false"}});
    EXPECT_FALSE(stageOf(desc, "ShadowStage").enabled);
    EXPECT_FALSE(stageOf(desc, "SpotShadowStage").enabled);
    EXPECT_TRUE(stageOf(desc, "GbufferStage").enabled);
}

TEST(PipelineShipped, SsaoDeferred) {
    const PipelineDesc desc = shipped("ssao-deferred");
    EXPECT_EQ(stageOrder(desc),
              "ShadowFlow: ShadowStage SpotShadowStage\nGbufferFlow: GbufferStage\n"
              "LightingFlow: SsaoStage SsaoBlurX SsaoBlurY LightingStage SkyboxStage TransparentStage PostProcessStage "
              "Fxaa\n");
    EXPECT_EQ(desc.findTarget("cc_ssaoMap")->binding, 11u);
    EXPECT_EQ(desc.findTarget("cc_ssaoBlurMap")->binding, 13u);
    EXPECT_EQ(desc.blocks.at(0).name, "CCSsao");
    EXPECT_EQ(desc.blocks.at(0).binding, 12u);
    EXPECT_EQ(stageOf(desc, "LightingStage").effect, "ssao-lighting");
    EXPECT_EQ(stageOf(desc, "SsaoBlurY").reads.at(0).target, "ssaoBlurX");
    // Targets of the parent come first: a child changes no number of its parent.
    EXPECT_EQ(desc.targets.at(0).name, "cc_shadowMap");
    EXPECT_EQ(desc.targets.back().name, "ssaoBlurX");
}

TEST(PipelineShipped, SsaoOffLeavesDeferred) {
    const PipelineDesc desc = shipped("ssao-deferred", {{"ssao", "false"}});
    for (const char* name : {"SsaoStage", "SsaoBlurX", "SsaoBlurY"}) EXPECT_FALSE(stageOf(desc, name).enabled) << name;
    EXPECT_TRUE(stageOf(desc, "LightingStage").enabled);
}

TEST(PipelineShipped, ArticleForm) {
    const PipelineDesc desc = shipped("ssao-deferred", {{"form", "article"}});
    const StageDesc& ssao = stageOf(desc, "SsaoStage");
    EXPECT_EQ(ssao.effect, "ssao-article");
    EXPECT_EQ(ssao.material.toJson(-1), Value(parseJson(R"({"radius":1.0})", "")).toJson(-1));
    EXPECT_FALSE(stageOf(desc, "SsaoBlurX").enabled);
    EXPECT_FALSE(stageOf(desc, "SsaoBlurY").enabled);
    EXPECT_EQ(stageOf(desc, "LightingStage").effect, "ssao-lighting-article");
    EXPECT_EQ(stageOf(desc, "LightingStage").defines.find("APPLY_TO"), nullptr);
}

TEST(PipelineShipped, ApplyTo) {
    const auto define = [](const char* choice) {
        return stageOf(shipped("ssao-deferred", {{"applyTo", choice}}), "LightingStage")
            .defines.find("APPLY_TO")
            ->integer();
    };
    EXPECT_EQ(define("albedo"), 0);
    EXPECT_EQ(define("ambient"), 1);
}

TEST(PipelineShipped, Forward) {
    EXPECT_EQ(stageOrder(shipped("forward")),
              "ShadowFlow: ShadowStage SpotShadowStage\n"
              "ForwardFlow: ForwardStage SkyboxStage TransparentStage PostProcessStage\n");
}

TEST(PipelineShipped, AoOnly) {
    // What a view does not show is not computed.
    const std::pair<const char*, const char*> views[] = {{"raw", "SsaoStage -SsaoBlurX -SsaoBlurY"},
                                                         {"blurred", "SsaoStage SsaoBlurX SsaoBlurY"},
                                                         {"depth", "-SsaoStage -SsaoBlurX -SsaoBlurY"},
                                                         {"normal", "-SsaoStage -SsaoBlurX -SsaoBlurY"}};
    for (const auto& [view, stages] : views) {
        const PipelineDesc desc = shipped("ao-only", {{"view", view}});
        EXPECT_EQ(stageOrder(desc), std::string("GbufferFlow: GbufferStage\nLightingFlow: ") + stages + " DebugView\n");
        EXPECT_EQ(stageOf(desc, "DebugView").defines.find("VIEW")->string(), view);
    }
    EXPECT_THROW(shipped("ao-only", {{"fxaa", "false"}}), Error);
    EXPECT_EQ(stageOf(shipped("ao-only", {{"form", "article"}}), "SsaoStage").effect, "ssao-article");
}

TEST(PipelineShipped, FlattenedTextIsAFixedPoint) {
    for (const std::string& name : AssetRoots::standard().list(AssetKind::Pipeline)) {
        for (const FlattenOptions mode : {FlattenOptions::Keep, FlattenOptions::Resolve}) {
            const Value once =
                flattenPipeline(AssetRoots::standard(), {.nameOrPath = name, .options = {}, .sets = {}}, mode);
            const Value twice = flattenParsed(flattenText(once), "flat.json", AssetRoots({}), {}, mode);
            EXPECT_EQ(once.toJson(), twice.toJson()) << name;
            EXPECT_EQ(once.find("extends"), nullptr);
            EXPECT_EQ(once.find("edits"), nullptr);
            EXPECT_EQ(once.find("options") == nullptr, mode == FlattenOptions::Resolve);
        }
    }
}

TEST(PipelineShipped, FlattenedOptionsStillWork) {
    const Value flat =
        flattenPipeline(AssetRoots::standard(), {.nameOrPath = "ssao-deferred", .options = {}, .sets = {}});
    const PipelineDesc desc = parsePipeline(flattenText(flat), "flat.json", AssetRoots({}),
                                            {.nameOrPath = "", .options = {{"form", "article"}}, .sets = {}});
    EXPECT_EQ(stageOf(desc, "SsaoStage").effect, "ssao-article");
}

}  // namespace
}  // namespace crevice
