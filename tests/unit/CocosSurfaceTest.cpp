// Which passes of a material a queue takes, with which macros, states and values: Cocos' rules, one by one.
#include "flow/CocosSurface.h"

#include "flow/CocosMacros.h"

#include <gtest/gtest.h>

#include "flow/MaterialStates.h"

namespace crevice {
namespace {

EffectPass passOf(const std::string& phase, bool blends = false, int priority = 128) {
    EffectPass pass;
    pass.phase = phase;
    pass.priority = priority;
    if (blends) pass.state.blendTargets.push_back({.blend = true});
    return pass;
}

std::vector<std::size_t> taken(const EffectTechnique& technique, const MaterialEffect& material, QueueDesc queue) {
    Problems problems;
    std::vector<std::size_t> passes;
    for (const ChosenPass& chosen : choosePasses(technique, material, queue, problems)) passes.push_back(chosen.pass);
    EXPECT_FALSE(problems.hasErrors());
    return passes;
}

QueueDesc opaque(std::vector<std::string> phases) { return {.phases = std::move(phases), .where = {}}; }
QueueDesc blended(std::vector<std::string> phases) {
    return {.phases = std::move(phases), .sort = QueueSort::BackToFront, .where = {}};
}

MaterialEffect materialWith(std::size_t pass, MaterialPass values) {
    MaterialEffect material;
    material.passes.resize(pass + 1);
    material.passes[pass] = std::move(values);
    return material;
}

TEST(CocosQueues, TakePassesByPhaseAndBlending) {
    EffectTechnique technique;
    technique.passes = {passOf("default"), passOf("default", true), passOf("deferred"), passOf("default")};
    EXPECT_EQ(taken(technique, {}, opaque({"default"})), (std::vector<std::size_t>{0, 3}));
    EXPECT_EQ(taken(technique, {}, blended({"default"})), (std::vector<std::size_t>{1}));
    EXPECT_EQ(taken(technique, {}, opaque({"default", "deferred"})), (std::vector<std::size_t>{0, 2, 3}));
    EXPECT_EQ(taken(technique, {}, blended({""})), std::vector<std::size_t>{});  // a phase of its own
}

TEST(CocosQueues, LeaveOutPassesOfARenderGraphAndThoseSwitchedOff) {
    EffectTechnique technique;
    technique.passes = {passOf("default"), passOf("default"), passOf("default"), passOf("default")};
    technique.passes[0].passName = "gbuffer";
    technique.passes[1].passName = "default";
    technique.passes[2].switchMacro = "USE_OUTLINE";
    technique.passes[3].switchMacro = "USE_RIM";
    technique.passes[3].embeddedMacros["USE_RIM"] = "1";
    EXPECT_EQ(taken(technique, {}, opaque({"default"})), (std::vector<std::size_t>{1, 3}));
    MaterialPass on{.defines = Value::makeObject(), .states = {}, .properties = {}};
    on.defines.set("USE_OUTLINE", Value::makeBool(true));
    EXPECT_EQ(taken(technique, materialWith(2, on), opaque({"default"})), (std::vector<std::size_t>{1, 2, 3}));
    on.defines.set("USE_OUTLINE", Value::makeBool(false));
    EXPECT_EQ(taken(technique, materialWith(2, on), opaque({"default"})), (std::vector<std::size_t>{1, 3}));
}

TEST(CocosQueues, BlendingIsThatOfTheMaterial) {
    EffectTechnique technique;
    technique.passes = {passOf("default")};
    const MaterialPass glass{.defines = {},
                             .states = parseJson(R"({"blendState": {"targets": [{"blend": true, "blendSrc": 2,
                                                    "blendDst": 4}]}, "depthStencilState": {"depthWrite": false}})",
                                                 "a.mtl"),
                             .properties = {}};
    EXPECT_TRUE(taken(technique, materialWith(0, glass), opaque({"default"})).empty());
    Problems problems;
    const auto chosen = choosePasses(technique, materialWith(0, glass), blended({"default"}), problems);
    ASSERT_EQ(chosen.size(), 1u);
    EXPECT_EQ(chosen[0].state.blendTargets[0].src, BlendFactor::SrcAlpha);
    EXPECT_EQ(chosen[0].state.blendTargets[0].dst, BlendFactor::OneMinusSrcAlpha);
    EXPECT_FALSE(chosen[0].state.depthWrite);
    EXPECT_TRUE(chosen[0].state.depthTest);
}

TEST(CocosQueues, SortKeyIsPriorityThenSubModelThenPass) {
    EffectTechnique technique;
    technique.passes = {passOf("default"), passOf("default"), passOf("default", false, 245)};
    const MaterialPass late{.defines = {}, .states = parseJson(R"({"priority": 130})", "a.mtl"), .properties = {}};
    Problems problems;
    const auto chosen = choosePasses(technique, materialWith(1, late), opaque({"default"}), problems);
    ASSERT_EQ(chosen.size(), 3u);
    EXPECT_EQ(chosen[0].order, 128u << 16 | 128u << 8 | 0u);
    EXPECT_EQ(chosen[1].order, 130u << 16 | 128u << 8 | 1u);
    EXPECT_EQ(chosen[2].order, 245u << 16 | 128u << 8 | 2u);  // as a skybox' max - 10
}

TEST(CocosStates, AreGivenByNumberOrByWord) {
    Problems problems;
    RenderState state = withStates(
        {},
        parseJson(R"({"rasterizerState": {"cullMode": 0}, "depthStencilState": {"depthFunc": 4}, "primitive": 1})",
                  "a.mtl"),
        problems);
    EXPECT_EQ(state.cullMode, CullMode::None);
    EXPECT_EQ(state.depthFunc, CompareOp::Greater);
    EXPECT_EQ(state.topology, Topology::LineList);
    state = withStates(
        {}, parseJson(R"({"rasterizerState": {"cullMode": "Front"}, "primitive": "TRIANGLE_STRIP"})", "a.mtl"),
        problems);
    EXPECT_EQ(state.cullMode, CullMode::Front);
    EXPECT_EQ(state.topology, Topology::TriangleStrip);
    EXPECT_FALSE(problems.hasErrors());
    withStates({}, parseJson(R"({"rasterizerState": {"cullMode": 7}})", "a.mtl"), problems);
    ASSERT_TRUE(problems.hasErrors());
    EXPECT_EQ(problems.all()[0].message, "7 is no value for 'cullMode'");
}

TEST(CocosStates, BlendTargetsAreMergedOneByOne) {
    RenderState base;
    base.blendTargets = {{.blend = true, .src = BlendFactor::SrcAlpha}, {.colorMask = 3}};
    Problems problems;
    const RenderState state = withStates(
        base, parseJson(R"({"blendState": {"targets": [{}, {"blend": true}, {"blendColorMask": 8}]}})", "a.mtl"),
        problems);
    ASSERT_EQ(state.blendTargets.size(), 3u);
    EXPECT_TRUE(state.blendTargets[0].blend);
    EXPECT_EQ(state.blendTargets[0].src, BlendFactor::SrcAlpha);
    EXPECT_TRUE(state.blendTargets[1].blend);
    EXPECT_EQ(state.blendTargets[1].colorMask, 3);
    EXPECT_EQ(state.blendTargets[2].colorMask, 8);
}

TEST(CocosValues, LinearColoursAreSquaredAndTexturesTakenOut) {
    EffectPass pass;
    const auto add = [&](const char* name, Value value, const char* target, bool linear) {
        EffectProperty property;
        property.name = name;
        property.value = std::move(value);
        property.target = target;
        property.linear = linear;
        pass.properties.push_back(property);
    };
    add("mainColor", parseJson("[1, 1, 1, 1]", "e"), "albedo", true);
    add("roughness", Value::makeReal(0.8), "pbrParams.y", false);
    add("mainTexture", Value::makeString("white"), "albedoMap", false);
    add("pbrMap", Value::makeString("grey"), "", false);
    const PassValues values = passValues(
        parseJson(
            R"({"mainColor": [0.5, 0.25, 1, 0.5], "roughness": 0.5, "mainTexture": 3, "pbrMap": "black", "gone": 1})",
            "m"),
        pass);
    EXPECT_EQ(values.numbers.find("mainColor")->toJson(-1), "[0.25,0.0625,1.0,0.5]");  // alpha stays
    EXPECT_EQ(values.numbers.find("roughness")->number(), 0.5);
    EXPECT_EQ(values.numbers.find("pbrMap")->string(), "black");
    EXPECT_EQ(values.numbers.find("gone"), nullptr);
    ASSERT_EQ(values.textures.size(), 1u);
    EXPECT_EQ(values.textures[0].first, "albedoMap");
    EXPECT_EQ(values.textures[0].second.texture, 3);
}

TEST(CocosMacros, OfThePipelineSayHowItShades) {
    PipelineDesc desc;
    desc.profile = Profile::Cocos36;
    EXPECT_EQ(pipelineMacros(desc, nullptr).at("CC_PIPELINE_TYPE"), "0");
    FlowDesc flow;
    flow.stages.emplace_back().stageClass = "GbufferStage";
    desc.flows.push_back(flow);
    const Defines macros = pipelineMacros(desc, nullptr);
    EXPECT_EQ(macros.at("CC_PIPELINE_TYPE"), "1");
    EXPECT_EQ(macros.at("CC_USE_HDR"), "1");
    EXPECT_EQ(macros.at("CC_USE_FOG"), "4");  // none
    EXPECT_EQ(macros.at("CC_RECEIVE_SHADOW"), "0");
    desc.macros = parseJson(R"({"CC_USE_FOG": 1, "CC_USE_IBL": true})", "p");
    EXPECT_EQ(pipelineMacros(desc, nullptr).at("CC_USE_FOG"), "1");
    EXPECT_EQ(pipelineMacros(desc, nullptr).at("CC_USE_IBL"), "1");
}

}  // namespace
}  // namespace crevice
