// Object graphs of .rpp files: both forms, every type of every version, order, references that lead nowhere or in
// circles.
#include <gtest/gtest.h>

#include "SceneTestTools.h"
#include "cocos/assets/Rpp.h"

namespace crevice::cocos {
namespace {

using test::contains;
using test::errorOf;

RppPipeline read(const std::string& text) {
    Problems problems;
    RppPipeline pipeline = parseRpp(text, "x.rpp", problems);
    problems.throwIfErrors();
    return pipeline;
}

std::string errorsOf(const std::string& text) {
    return errorOf([&] { read(text); });
}

constexpr const char* kUser = R"([
  { "__type__": "SsaoRenderPipeline", "_name": "", "_objFlags": 0, "_native": "", "_tag": 2,
    "_flows": [ { "__id__": 1 }, { "__id__": 3 } ],
    "renderTextures": [ { "__id__": 10 } ] },
  { "__type__": "ShadowFlow", "_name": "ShadowFlow", "_priority": 7, "_tag": 0, "_stages": [ { "__id__": 2 } ] },
  { "__type__": "ShadowStage", "_name": "ShadowStage", "_priority": 0, "_tag": 0 },
  { "__type__": "MainFlow", "_name": "MainFlow", "_priority": 1, "_tag": 1,
    "_stages": [ { "__id__": 4 }, { "__id__": 5 }, null, { "__id__": 6 } ] },
  { "__type__": "GbufferStage", "_name": "", "_priority": 0, "_tag": 0, "renderQueues": [ { "__id__": 7 } ] },
  { "__type__": "SsaoStage", "_name": "", "_priority": 0, "_tag": 3, "enabled": false,
    "ssaoMaterial": { "__uuid__": "10FF50D1-0000-4000-8000-000000f1736b", "__expectedType__": "cc.Material" },
    "strength": 2.5, "tint": { "__type__": "cc.Color", "r": 255, "g": 51, "b": 0, "a": 255 }, "none": null,
    "desc": { "__id__": 9 } },
  { "__type__": "LightingStage", "_name": "", "_priority": 0, "_tag": 0, "_deferredMaterial": null,
    "renderQueues": [ { "__id__": 8 } ] },
  { "__type__": "RenderQueueDesc", "isTransparent": false, "sortMode": 0, "stages": [ "default", "deferred" ] },
  { "__type__": "RenderQueueDesc", "isTransparent": true, "sortMode": 1, "stages": [ "" ] },
  { "__type__": "MyDesc", "a": 1 },
  { "__type__": "RenderTextureConfig", "name": "half", "texture": { "__uuid__": "fcmR3XADNLgJ1ByKhqcC5Z" } }
])";

TEST(CocosRpp, AUsersPipelineArrivesWhole) {
    const RppPipeline pipeline = read(kUser);
    EXPECT_EQ(pipeline.type, "SsaoRenderPipeline");
    EXPECT_EQ(pipeline.name, "x");  // the file's, where it gives none
    EXPECT_EQ(pipeline.tag, 2);
    ASSERT_EQ(pipeline.flows.size(), 2u);
    EXPECT_EQ(pipeline.flows[0].type, "ShadowFlow");
    EXPECT_EQ(pipeline.flows[0].priority, 7);  // and yet first: flows are not sorted
    ASSERT_EQ(pipeline.flows[1].stages.size(), 3u);
    EXPECT_EQ(pipeline.flows[1].stages[0].type, "GbufferStage");
    EXPECT_EQ(pipeline.flows[1].stages[1].type, "SsaoStage");
    EXPECT_EQ(pipeline.flows[1].stages[2].type, "LightingStage");
    EXPECT_TRUE(pipeline.flows[1].moved.empty());
    ASSERT_EQ(pipeline.renderTextures.size(), 1u);
    EXPECT_EQ(pipeline.renderTextures[0].name, "half");
    EXPECT_EQ(pipeline.renderTextures[0].texture.uuid, "fc991dd7-0033-4b80-9d41-c8a86a702e59");
}

TEST(CocosRpp, QueuesKeepTheirPhases) {
    const RppPipeline pipeline = read(kUser);
    const RppQueue& opaque = pipeline.flows[1].stages[0].queues.at(0);
    EXPECT_FALSE(opaque.transparent);
    EXPECT_FALSE(opaque.backToFront);
    EXPECT_EQ(opaque.phases, (std::vector<std::string>{"default", "deferred"}));
    const RppQueue& blended = pipeline.flows[1].stages[2].queues.at(0);
    EXPECT_TRUE(blended.transparent);
    EXPECT_TRUE(blended.backToFront);
    EXPECT_EQ(blended.phases, std::vector<std::string>{""});
}

TEST(CocosRpp, FieldsOfAUsersClassAreKept) {
    const RppPipeline pipeline = read(kUser);
    const RppStage& stage = pipeline.flows[1].stages[1];
    EXPECT_FALSE(stage.enabled);
    EXPECT_EQ(stage.tag, 3);
    ASSERT_EQ(stage.fields.size(), 5u);
    const RppField* material = stage.field("ssaoMaterial");
    ASSERT_TRUE(material);
    EXPECT_EQ(material->value.kind, TypedValue::Kind::Asset);
    EXPECT_EQ(material->value.asset.uuid, "10ff50d1-0000-4000-8000-000000f1736b");
    EXPECT_EQ(material->value.asset.expectedType, "cc.Material");
    EXPECT_EQ(material->where.line, 11);
    EXPECT_EQ(stage.field("strength")->value.plain.number(), 2.5);
    EXPECT_EQ(stage.field("tint")->value.plain.toJson(-1), "[1,0.2,0,1]");
    EXPECT_EQ(stage.field("none")->value.kind, TypedValue::Kind::Null);
    EXPECT_EQ(stage.field("desc")->value.type, "MyDesc");
    EXPECT_EQ(stage.field("absent"), nullptr);
}

TEST(CocosRpp, ThePipelineMayStandAlone) {
    const RppPipeline pipeline = read(R"({ "__type__": "cc.RenderPipeline", "_name": "empty", "_flows": [] })");
    EXPECT_EQ(pipeline.type, "cc.RenderPipeline");
    EXPECT_EQ(pipeline.name, "empty");
    EXPECT_TRUE(pipeline.flows.empty());
}

TEST(CocosRpp, ObjectsMayBeWrittenInPlace) {
    const RppPipeline pipeline = read(R"({ "__type__": "ForwardPipeline", "_flows": [ { "__type__": "ForwardFlow",
        "_stages": [ { "__type__": "ForwardStage", "frameBuffer": "",
        "renderQueues": [ { "__type__": "RenderQueueDesc", "isTransparent": false, "stages": ["default"] } ] } ] } ] })");
    EXPECT_EQ(pipeline.flows.at(0).stages.at(0).queues.at(0).phases, std::vector<std::string>{"default"});
}

TEST(CocosRpp, StagesAreSortedByPriorityAndEqualOnesStay) {
    const RppPipeline pipeline = read(R"([ { "__type__": "P", "_flows": [ { "__id__": 1 } ] },
        { "__type__": "F", "_stages": [ { "__type__": "A", "_priority": 5 }, { "__type__": "B", "_priority": -1 },
          { "__type__": "C", "_priority": 5 }, { "__type__": "D", "_priority": 0 }, { "__type__": "E", "_priority": 5 } ] } ])");
    std::string order;
    for (const RppStage& stage : pipeline.flows[0].stages) order += stage.type;
    EXPECT_EQ(order, "BDACE");
    EXPECT_EQ(pipeline.flows[0].moved, (std::vector<std::string>{"B", "D", "A", "C"}));
}

TEST(CocosRpp, DescriptionsOfOlderVersionsAreRead) {
    const RppPipeline pipeline = read(R"([ { "__type__": "ForwardPipeline", "_flows": [],
        "materials": [ { "__type__": "MaterialConfig", "name": "m", "material": null } ],
        "textures": [ { "__type__": "RenderTextureDesc", "name": "t", "type": 1, "usage": 20, "format": 41 } ],
        "renderPasses": [ { "__id__": 1 } ],
        "framebuffers": [ { "__type__": "FrameBufferDesc", "name": "fb", "renderPass": 3, "colorTextures": ["t"],
                            "depthStencilTexture": "d", "texture": null } ] },
        { "__type__": "RenderPassDesc", "index": 3,
          "colorAttachments": [ { "__type__": "ColorDesc", "format": 35, "sampleCount": 4 } ],
          "depthStencilAttachment": { "__type__": "DepthStencilDesc", "format": 55, "depthLoadOp": 0 } } ])");
    ASSERT_EQ(pipeline.materials.size(), 1u);
    EXPECT_FALSE(pipeline.materials[0].material);
    EXPECT_EQ(pipeline.textures.at(0).format, 41);
    EXPECT_EQ(pipeline.textures.at(0).width, -1);
    const RppRenderPass& pass = pipeline.renderPasses.at(0);
    EXPECT_EQ(pass.index, 3);
    EXPECT_EQ(pass.colors.at(0).format, 35);
    EXPECT_EQ(pass.colors.at(0).sampleCount, 4);
    EXPECT_EQ(pass.colors.at(0).loadOp, 2);
    EXPECT_EQ(pass.depthStencil.at(0).format, 55);
    EXPECT_EQ(pass.depthStencil.at(0).loadOp, 0);
    EXPECT_EQ(pipeline.frameBuffers.at(0).colorTextures, std::vector<std::string>{"t"});
    EXPECT_EQ(pipeline.frameBuffers.at(0).depthStencilTexture, "d");
}

TEST(CocosRpp, ReferencesThatLeadNowhereAreErrorsAtTheirPlace) {
    const std::string text = errorsOf(R"([ { "__type__": "P",
        "_flows": [ { "__id__": 7 }, { "__id__": -1 }, { "__id__": "a" }, 5, { "__id__": 1.5 } ] } ])");
    EXPECT_TRUE(contains(text, "x.rpp:2:33: error: item 0 of '_flows' is object 7, but this file has 1")) << text;
    EXPECT_TRUE(contains(text, "item 1 of '_flows' is object -1"));
    EXPECT_TRUE(contains(text, "item 2 of '_flows' is object 'a'"));
    EXPECT_TRUE(contains(text, "item 3 of '_flows' must be an object, not a number"));
    EXPECT_TRUE(contains(text, "item 4 of '_flows' is object 1.5"));
}

TEST(CocosRpp, CirclesEndInErrors) {
    const std::string self = errorsOf(R"([ { "__type__": "P", "_flows": [ { "__id__": 0 } ] } ])");
    EXPECT_TRUE(contains(self, "this object is one of its own '_flows'")) << self;
    const std::string stage = errorsOf(R"([ { "__type__": "P", "_flows": [ { "__id__": 1 } ] },
        { "__type__": "F", "_stages": [ { "__id__": 1 } ] } ])");
    EXPECT_TRUE(contains(stage, "this object is one of its own '_stages'")) << stage;
    const std::string names =
        errorsOf(R"([ { "__type__": "P", "_flows": [ { "__id__": 1 } ] }, { "__id__": 2 }, { "__id__": 1 } ])");
    EXPECT_TRUE(contains(names, "is named in a circle")) << names;
}

TEST(CocosRpp, TheSameFlowTwiceRunsTwice) {
    const RppPipeline pipeline = read(R"([ { "__type__": "P", "_flows": [ { "__id__": 1 }, { "__id__": 1 } ] },
        { "__type__": "F", "_stages": [ { "__type__": "S" } ] } ])");
    EXPECT_EQ(pipeline.flows.size(), 2u);
}

TEST(CocosRpp, WrongTypesAreErrors) {
    const std::string text =
        errorsOf(R"({ "__type__": "P", "_tag": "x", "_flows": [ { "__type__": "F", "_priority": 1.5,
        "_stages": [ { "_name": 5 } ] } ], "renderTextures": [ { "__type__": "MaterialConfig" } ] })");
    EXPECT_TRUE(contains(text, "'_tag' must be a whole number, not a string")) << text;
    EXPECT_TRUE(contains(text, "'_priority' must be a whole number"));
    EXPECT_TRUE(contains(text, "a stage without '__type__'"));
    EXPECT_TRUE(contains(text, "'_name' must be a string, not a number"));
    EXPECT_TRUE(contains(text, "an item of 'renderTextures' is of type 'MaterialConfig'"));
}

TEST(CocosRpp, OtherFilesAreRefused) {
    EXPECT_TRUE(contains(errorsOf("[]"), "this is no file of Cocos' editor"));
    EXPECT_TRUE(contains(errorsOf("5"), "this is no file of Cocos' editor"));
    EXPECT_TRUE(contains(errorsOf(R"([ { "a": 1 } ])"), "this is no file of Cocos' editor"));
    EXPECT_TRUE(contains(errorsOf(R"({ "__type__": "cc.Material" })"), "'x.rpp' is no render pipeline"));
    EXPECT_TRUE(contains(errorsOf("{"), "x.rpp:1:"));
}

TEST(CocosRpp, DeepAndLargeFilesAreBounded) {
    EXPECT_TRUE(
        contains(errorsOf(R"({ "__type__": "P", "_flows": )" + std::string(100, '[') + std::string(100, ']') + "}"),
                 "nests deeper than"));
    std::string many = R"({ "__type__": "P", "_flows": [)";
    for (int i = 0; i < 5000; ++i) many += std::string(i ? "," : "") + R"({"__type__":"F"})";
    EXPECT_TRUE(contains(errorsOf(many + "]}"), "more than 4096 flows and stages"));
}

TEST(CocosRpp, EarlyAssetsListDescriptionsAmongTheRenderTextures) {
    const RppPipeline pipeline = read(R"([ { "__type__": "ForwardPipeline", "_flows": [], "renderTextures": [
      { "__id__": 1 }, { "__id__": 2 } ] },
      { "__type__": "RenderTextureDesc", "name": "mirror", "type": 1, "viewType": 1, "usage": 16, "format": 35, "width": -1, "height": 64 },
      { "__type__": "RenderTextureConfig", "name": "screen", "texture": null } ])");
    ASSERT_EQ(pipeline.textures.size(), 1u);
    EXPECT_EQ(pipeline.textures[0].name, "mirror");
    EXPECT_EQ(pipeline.textures[0].format, 35);
    EXPECT_EQ(pipeline.textures[0].height, 64);
    ASSERT_EQ(pipeline.renderTextures.size(), 1u);
    EXPECT_EQ(pipeline.renderTextures[0].name, "screen");
}

TEST(CocosRpp, QueuesOfAScriptsClassAreQueues) {
    Problems problems;
    const RppPipeline pipeline = parseRpp(R"([ { "__type__": "DeferredPipeline", "_flows": [ { "__id__": 1 } ] },
      { "__type__": "MainFlow", "_stages": [ { "__type__": "MirrorStage", "renderQueues": [ { "__id__": 2 } ] } ] },
      { "__type__": "MirrorQueueDesc", "isTransparent": false, "sortMode": 1, "stages": [ "mirror" ] } ])",
                                          "x.rpp", problems);
    problems.throwIfErrors();
    ASSERT_EQ(pipeline.flows.at(0).stages.at(0).queues.size(), 1u);
    EXPECT_EQ(pipeline.flows[0].stages[0].queues[0].phases, std::vector<std::string>{"mirror"});
    ASSERT_EQ(problems.all().size(), 1u);
    EXPECT_TRUE(contains(problems.all()[0].message, "'MirrorQueueDesc' is a script"));
}

}  // namespace
}  // namespace crevice::cocos
