// Metadata in Cocos' terms, each expectation written down from the rules.
#include <gtest/gtest.h>

#include "CocosTestTools.h"
#include "cocos/reflection/Reflection.h"

namespace crevice::cocos {
namespace {

StageMacro macro(const std::string& name, DefineType type = DefineType::Bool) {
    StageMacro result;
    result.info.name = name;
    result.info.type = type;
    return result;
}

StageText vertexStage() {
    StageText stage = stageText(kVertexBit,
                                "precision highp float;\n"                                 // 1
                                "in vec3 a_position;\n"                                    // 2
                                "layout(location = 2) in u32vec4 a_joints;\n"              // 3
                                "in vec4 a_matWorld0;\n"                                   // 4
                                "\n"                                                       // 5 format(RGBA8)
                                "in vec4 a_instanced_color;\n"                             // 6
                                "#define COUNT 10\n"                                       // 7
                                "\n"                                                       // 8 builtin(local)
                                "layout(set = 2, binding = 0) uniform CCLocalBatched {\n"  // 9
                                "  highp mat4 cc_matWorlds[COUNT];\n"                      // 10
                                "};\n"                                                     // 11
                                "\n"                                                       // 12 builtin(global)
                                "layout(set = 0, binding = 0) uniform CCGlobal { vec4 cc_time; };\n"  // 13
                                "uniform Constants {\n"                                               // 14
                                "  vec4 tilingOffset;\n"                                              // 15
                                "  vec4 digits[20]; mat3x4 m; ivec2 mode; float last;\n"              // 16
                                "};\n"                                                                // 17
                                "out vec2 v_uv;\n");                                                  // 18
    stage.marks = {{PragmaMark::Kind::Format, "", "RGBA8", 5},
                   {PragmaMark::Kind::BuiltinLocal, "", "", 8},
                   {PragmaMark::Kind::BuiltinGlobal, "", "", 12}};
    enclose(stage, 3, 3, {"CC_USE_SKINNING"});
    enclose(stage, 4, 6, {"USE_INSTANCING"});
    enclose(stage, 7, 11, {"!USE_INSTANCING", "USE_BATCHING"});
    stage.macros = {macro("CC_USE_SKINNING"), macro("USE_INSTANCING"), macro("MORPH_COUNT", DefineType::Number)};
    stage.macros[2].info.range = {2, 8};
    stage.macros[2].info.defaultValue = "2";
    return stage;
}

StageText fragmentStage() {
    StageText stage = stageText(kFragmentBit,
                                "in vec2 v_uv;\n"                                                 // 1
                                "uniform sampler2D albedoMap;\n"                                  // 2
                                "uniform samplerCube sky;\n"                                      // 3
                                "uniform Frag { vec4 albedo; vec4 params; };\n"                   // 4
                                "uniform Constants { vec4 tilingOffset; };\n"                     // 5
                                "layout(std430) readonly buffer Lights { vec4 lights[]; };\n"     // 6
                                "layout(rgba8) writeonly uniform image2D target;\n"               // 7
                                "\n"                                                              // 8
                                "layout(set = 0, binding = 3) uniform sampler2D cc_shadowMap;\n"  // 9
                                "layout(location = 0) out vec4 color;\n");                        // 10
    stage.marks = {{PragmaMark::Kind::BuiltinGlobal, "", "", 8}};
    enclose(stage, 2, 2, {"USE_ALBEDO_MAP"});
    enclose(stage, 9, 9, {"CC_RECEIVE_SHADOW"});
    stage.macros = {macro("USE_ALBEDO_MAP"), macro("ALBEDO_UV", DefineType::String), macro("USE_INSTANCING")};
    stage.macros[1].info.options = {"v_uv", "v_uv1"};
    stage.macros[1].info.defaultValue = "v_uv";
    return stage;
}

Value reflected() {
    Problems problems;
    const Value shader = reflectShader("x|vs|fs:frag", {vertexStage(), fragmentStage()}, problems);
    EXPECT_FALSE(problems.hasErrors());
    return shader;
}

/// Both as compact text: keys in the order of the expectation.
void expectPart(const Value& shader, const char* key, const std::string& json) {
    ASSERT_NE(shader.find(key), nullptr);
    EXPECT_EQ(shader.find(key)->toJson(-1), parseJson(json, "expected").toJson(-1)) << key;
}

TEST(CocosReflection, Name) { EXPECT_EQ(reflected().find("name")->string(), "x|vs|fs:frag"); }

TEST(CocosReflection, MacrosVertexBeforeFragmentOnce) {
    expectPart(reflected(), "defines",
               R"([{"name":"CC_USE_SKINNING","type":"boolean"},{"name":"USE_INSTANCING","type":"boolean"},
                   {"name":"MORPH_COUNT","type":"number","range":[2,8]},{"name":"USE_ALBEDO_MAP","type":"boolean"},
                   {"name":"ALBEDO_UV","type":"string","options":["v_uv","v_uv1"]}])");
}

TEST(CocosReflection, Attributes) {
    expectPart(reflected(), "attributes",
               R"([{"name":"a_position","defines":[],"format":32,"location":0},
                   {"name":"a_joints","defines":["CC_USE_SKINNING"],"location":2},
                   {"name":"a_matWorld0","defines":["USE_INSTANCING"],"format":44,"isInstanced":true,"location":1},
                   {"name":"a_instanced_color","defines":["USE_INSTANCING"],"format":35,"isNormalized":true,
                    "isInstanced":true,"location":3}])");
}

TEST(CocosReflection, BlocksWithMembersAndStages) {
    expectPart(reflected(), "blocks",
               R"([{"name":"Constants","defines":[],"stageFlags":17,"binding":0,"members":[
                     {"name":"tilingOffset","type":16,"count":1},{"name":"digits","type":16,"count":20},
                     {"name":"m","type":22,"count":1},{"name":"mode","type":6,"count":1},
                     {"name":"last","type":13,"count":1}]},
                   {"name":"Frag","defines":[],"stageFlags":16,"binding":1,"members":[
                     {"name":"albedo","type":16,"count":1},{"name":"params","type":16,"count":1}]}])");
}

TEST(CocosReflection, Resources) {
    const Value shader = reflected();
    expectPart(shader, "samplerTextures",
               R"([{"name":"albedoMap","type":28,"count":1,"defines":["USE_ALBEDO_MAP"],"stageFlags":16,"binding":2},
                   {"name":"sky","type":31,"count":1,"defines":[],"stageFlags":16,"binding":3}])");
    expectPart(shader, "buffers", R"([{"name":"Lights","memoryAccess":1,"defines":[],"stageFlags":16,"binding":4}])");
    expectPart(shader, "images",
               R"([{"name":"target","type":41,"count":1,"memoryAccess":2,"defines":[],"stageFlags":16,"binding":5}])");
    for (const char* none : {"samplers", "textures", "subpassInputs"}) expectPart(shader, none, "[]");
}

TEST(CocosReflection, ASubpassInputSpeaksForTheSamplerOfItsNumber) {
    Problems problems;
    const Value shader =
        reflectShader("s|v|f",
                      {stageText(kFragmentBit,
                                 "layout(input_attachment_index = 0, binding = 1) uniform subpassInput near;\n"
                                 "layout(binding = 1) uniform sampler2D nearMap;\nuniform sampler2D noise;\n"
                                 "readonly buffer b_lamps { vec4 lamps[]; };\n")},
                      problems);
    expectPart(shader, "samplerTextures",
               R"([{"name":"noise","type":28,"count":1,"defines":[],"stageFlags":16,"binding":0}])");
    expectPart(shader, "buffers", R"([{"name":"b_lamps","memoryAccess":1,"defines":[],"stageFlags":16,"binding":2}])");
    expectPart(shader, "subpassInputs", R"([{"name":"near","count":1,"defines":[],"stageFlags":16,"binding":1}])");
}

TEST(CocosReflection, Builtins) {
    // Registers of all branches: CCLocalBatched 40, CCGlobal 1, Constants 1 + 20 + 3 + 1 + 1; Frag 2, Constants 1.
    expectPart(reflected(), "builtins",
               R"({"statistics":{"CC_EFFECT_USED_VERTEX_UNIFORM_VECTORS":67,
                                 "CC_EFFECT_USED_FRAGMENT_UNIFORM_VECTORS":3},
                   "globals":{"blocks":[{"name":"CCGlobal","defines":[]}],
                     "samplerTextures":[{"name":"cc_shadowMap","defines":["CC_RECEIVE_SHADOW"]}],
                     "buffers":[],"images":[]},
                   "locals":{"blocks":[{"name":"CCLocalBatched","defines":["!USE_INSTANCING","USE_BATCHING"]}],
                     "samplerTextures":[],"buffers":[],"images":[]}})");
}

TEST(CocosReflection, BlockSizesThatAMacroDecidesAreNotCounted) {
    Problems problems;
    const Value shader =
        reflectShader("x",
                      {stageText(kVertexBit,
                                 "#if A\n#define N 1\n#else\n#define N 10\n#endif\nuniform L { vec4 pos[N]; vec4 "
                                 "other; };\n")},
                      problems);
    EXPECT_EQ(shader.find("builtins")->find("statistics")->find("CC_EFFECT_USED_VERTEX_UNIFORM_VECTORS")->integer(), 1);
}

TEST(CocosReflection, ADefineThatIsKeptFromTheCompilerIsNotCounted) {
    Problems problems;
    const Value shader = reflectShader(
        "x", {stageText(kVertexBit, "# define N 4\nuniform L { vec4 pos[N]; vec4 other; };\n")}, problems);
    EXPECT_EQ(shader.find("builtins")->find("statistics")->find("CC_EFFECT_USED_VERTEX_UNIFORM_VECTORS")->integer(), 1);
}

TEST(CocosReflection, MacrosInSizesAreTheirWords) {
    Problems problems;
    const Value shader = reflectShader(
        "x",
        {stageText(kVertexBit,
                   "#define SUM 1 + 1\n#define ROWS 8\n#define COLS 10\n#define CELLS ROWS * COLS / 4\n"
                   "#define MANY SUM * 3\n#define ROUND_A ROUND_B\n#define ROUND_B ROUND_A\nconst int KNOWN = 1 + 1;\n"
                   "uniform L { vec4 a[SUM * 3]; vec4 b[CELLS]; vec4 c[MANY]; vec4 d[(SUM) * 3]; vec4 e[KNOWN * 3];\n"
                   "  vec4 f[1 << 2]; vec4 g[SUM << SUM]; vec4 h[ROUND_A]; };\n")},
        problems);
    std::vector<std::int64_t> counts;
    for (const Value& member : shader.find("blocks")->items()[0].find("members")->items())
        counts.push_back(member.find("count")->integer());
    // As in C: 1 + 1 * 3, 8 * 10 / 4, (1 + 1) * 3; a constant has a value; sums bind before shifts: 2 << 2.
    EXPECT_EQ(counts, (std::vector<std::int64_t>{4, 20, 4, 6, 6, 4, 8, 1}));
}

const UniformTypes kUniforms = {
    {"albedo", 16}, {"scaleAndCutoff", 16}, {"params", 16}, {"albedoMap", 28}, {"mainColor", 16},
    {"sky", 31},    {"last", 13},           {"mode", 6},    {"turn", 17},      {"lens", 25}};

void expectProperties(const std::string& yaml, const std::string& json) {
    EXPECT_EQ(reflectProperties(parseYaml(yaml, "written"), kUniforms).toJson(-1),
              parseJson(json, "expected").toJson(-1));
}

TEST(CocosReflection, PropertiesOfTheirOwnName) {
    expectProperties(
        "mainColor: { value: [1, 1, 1, 0.5], linear: true, editor: { type: color } }\n"
        "last: { value: 0.5 }\nsky: { value: white }\nmode: {}\n",
        R"({"mainColor":{"value":[1,1,1,0.5],"linear":true,"type":16},"last":{"value":[0.5],"type":13},
                         "sky":{"value":"white","type":31},"mode":{"type":6}})");
}

TEST(CocosReflection, TargetsGetHandlesAndAMergedDefault) {
    expectProperties(
        "color: { value: [1, 0.5, 0, 1], target: albedo }\n"
        "scale: { value: [2, 3, 4], target: scaleAndCutoff.xyz }\n"
        "threshold: { value: 0.5, target: scaleAndCutoff.w }\n"
        "metallic: { value: 0.6, target: params.z }\n"
        "texture: { value: grey, target: albedoMap }\n",
        R"({"color":{"value":[1,0.5,0,1],"type":16,"handleInfo":["albedo",0,16]},
                         "scale":{"value":[2,3,4],"type":15,"handleInfo":["scaleAndCutoff",0,15]},
                         "threshold":{"value":[0.5],"type":13,"handleInfo":["scaleAndCutoff",3,13]},
                         "metallic":{"value":[0.6],"type":13,"handleInfo":["params",2,13]},
                         "texture":{"value":"grey","type":28,"handleInfo":["albedoMap",0,28]},
                         "albedo":{"type":16,"value":[1,0.5,0,1]},
                         "scaleAndCutoff":{"type":16,"value":[2,3,4,0.5]},
                         "params":{"type":16,"value":[0,0,0.6,0]},
                         "albedoMap":{"type":28,"value":"grey"}})");
}

TEST(CocosReflection, MatricesAreTargetsToo) {
    expectProperties("mirror: { value: [1, 0, 0, -1], target: turn }\nfocus: { target: lens }\n",
                     R"({"mirror":{"value":[1,0,0,-1],"type":17,"handleInfo":["turn",0,17]},
                         "focus":{"type":25,"handleInfo":["lens",0,25]},
                         "turn":{"type":17,"value":[1,0,0,-1]},
                         "lens":{"type":25,"value":[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]}})");
}

TEST(CocosReflection, WhatTheEditorIsToldOfAllIsNoProperty) {
    expectProperties("__metadata__: { editor: { visible: false } }\nmainColor: { value: [1, 1, 1, 1] }\n",
                     R"({"mainColor":{"value":[1,1,1,1],"type":16}})");
}

TEST(CocosReflection, AnAliasOfAPropertyIsNoNewDefault) {
    expectProperties("mainColor: { value: [1, 1, 1, 1] }\ncolor: { target: mainColor, linear: true }\n",
                     R"({"mainColor":{"value":[1,1,1,1],"type":16},
                         "color":{"linear":true,"type":16,"handleInfo":["mainColor",0,16]}})");
}

TEST(CocosReflection, SamplersArePacked) {
    // point 1, linear 2 << 2, none, clamp 2 << 6, mirror 1 << 8, anisotropy 8 << 12 when nothing is given
    EXPECT_EQ(samplerHash(parseYaml("{ minFilter: point, addressU: clamp, addressV: Mirror }", "written")),
              1 + (2 << 2) + (2 << 6) + (1 << 8) + (8 << 12));
}

TEST(CocosReflection, PassesWithNumbersForWords) {
    const Value pass = parseYaml(
        "vert: a\nfrag: b\nphase: shadow-add\npropertyIndex: 0\nswitch: USE_OUTLINE\npriority: max - 10\n"
        "primitive: LINE_LIST\nembeddedMacros: { CC_FORWARD_ADD: true, CC_PIPELINE_TYPE: 1 }\n"
        "rasterizerState: { cullMode: Front }\n"
        "depthStencilState: { depthTest: false, depthFunc: less_equal, stencilTestFront: true, stencilFuncFront: "
        "not_equal,\n  stencilPassOpFront: replace, stencilRef: 0x80, stencilRefBack: 1 }\n"
        "blendState: { targets: [ { blend: true, blendSrc: src_alpha, blendDst: one_minus_src_alpha, blendEq: max,\n"
        "  blendColorMask: none } ] }\nmigrations: { macros: { A: {} } }\nunknown: 1\n",
        "written");
    EXPECT_EQ(reflectPass(pass, "x|a|b", 245, {}).toJson(-1),
              parseJson(R"({"phase":"shadow-add","propertyIndex":0,"switch":"USE_OUTLINE","priority":245,"primitive":1,
                  "embeddedMacros":{"CC_FORWARD_ADD":true,"CC_PIPELINE_TYPE":1},"rasterizerState":{"cullMode":1},
                  "depthStencilState":{"depthTest":false,"depthFunc":3,"stencilTestFront":true,"stencilFuncFront":5,
                    "stencilPassOpFront":2,"stencilRefBack":128,"stencilRefFront":128},
                  "blendState":{"targets":[{"blend":true,"blendSrc":2,"blendDst":4,"blendEq":4,"blendColorMask":0}]},
                  "unknown":1,"program":"x|a|b"})",
                        "expected")
                  .toJson(-1));
}

}  // namespace
}  // namespace crevice::cocos
