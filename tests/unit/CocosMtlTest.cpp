// Materials: what is read from a .mtl, and the engine's rules of merging it with its effect.
#include <gtest/gtest.h>

#include "SceneTestTools.h"
#include "cocos/assets/Mtl.h"
#include "cocos/assets/MtlInstance.h"

namespace crevice::cocos {
namespace {

using test::contains;
using test::errorOf;

Mtl read(const std::string& text) {
    Problems problems;
    Mtl mtl = parseMtl(text, "m.mtl", problems);
    problems.throwIfErrors();
    return mtl;
}

Mtl withProps(const std::string& props, const std::string& defines = "[{}]") {
    return read(R"({ "__type__": "cc.Material", "_defines": )" + defines + R"(, "_props": )" + props + "}");
}

EffectProperty property(const std::string& name, const std::string& value, const std::string& target = "") {
    EffectProperty made;
    made.name = name;
    made.value = value.empty() ? Value() : parseYaml(value, "e");
    made.target = target;
    return made;
}

/// One technique: a pass, one that borrows from it, one behind a switch.
EffectAsset effect() {
    EffectAsset asset;
    EffectPass first;
    first.properties = {
        property("mainColor", "[1, 1, 1, 1]", "albedo"), property("metallic", "0.5", "pbrParams.z"),
        property("tiling", "[1, 1]", "tilingOffset.xy"), property("offset", "[0, 0]", "tilingOffset.zw"),
        property("glow", "[0, 0, 0]", "glowParams.rgb"), property("glowScale", "1", "glowParams.a"),
        property("mainTexture", "grey", "albedoMap"),    property("normalMap", "normal")};
    EffectPass second = first;
    second.propertyIndex = 0;
    second.embeddedMacros = {{"CC_FORWARD_ADD", "1"}, {"USE_ALBEDO_MAP", "0"}};
    EffectPass third = first;
    third.switchMacro = "USE_OUTLINE_PASS";
    asset.techniques.push_back({"opaque", {first, second, third}});
    return asset;
}

MaterialEffect make(const Mtl& mtl, const TextureUser& textures = {}) {
    Problems problems;
    MaterialEffect made = instantiate(mtl, effect(), "builtin-standard", textures, problems);
    problems.throwIfErrors();
    return made;
}

TEST(CocosMtl, EveryFieldArrives) {
    const Mtl mtl = read(R"({
      "__type__": "cc.Material", "_name": "wall", "_objFlags": 0, "_native": "",
      "_effectAsset": { "__uuid__": "1baf0fc9-befa-459c-8bdd-af1a450a0319", "__expectedType__": "cc.EffectAsset" },
      "_techIdx": 1,
      "_defines": [ { "USE_ALBEDO_MAP": true, "LAYERS": 3, "ALBEDO_UV": "v_uv1" }, {} ],
      "_states": [ { "rasterizerState": { "cullMode": 0 }, "blendState": { "targets": [ {} ] } } ],
      "_props": [ { "mainColor": { "__type__": "cc.Color", "r": 255, "g": 0, "b": 51, "a": 102 }, "metallic": 0.25,
        "mainTexture": { "__uuid__": "fcmR3XADNLgJ1ByKhqcC5Z@6c48a" }, "list": [1, 2], "empty": null }, {}, {} ] })");
    EXPECT_EQ(mtl.name, "wall");
    EXPECT_EQ(mtl.effect.uuid, "1baf0fc9-befa-459c-8bdd-af1a450a0319");
    EXPECT_EQ(mtl.effect.expectedType, "cc.EffectAsset");
    EXPECT_EQ(mtl.technique, 1u);
    ASSERT_EQ(mtl.passes.size(), 3u);
    EXPECT_EQ(mtl.passes[0].defines.toJson(-1), R"({"USE_ALBEDO_MAP":true,"LAYERS":3,"ALBEDO_UV":"v_uv1"})");
    EXPECT_EQ(mtl.passes[0].states.find("rasterizerState")->toJson(-1), R"({"cullMode":0})");
    ASSERT_EQ(mtl.passes[0].properties.size(), 5u);
    EXPECT_EQ(mtl.passes[0].properties[0].value.plain.toJson(-1), "[1,0,0.2,0.4]");
    EXPECT_EQ(mtl.passes[0].properties[1].value.plain.number(), 0.25);
    EXPECT_EQ(mtl.passes[0].properties[2].value.asset.uuid, "fc991dd7-0033-4b80-9d41-c8a86a702e59@6c48a");
    EXPECT_EQ(mtl.passes[0].properties[3].value.items.size(), 2u);
    EXPECT_EQ(mtl.passes[0].properties[4].value.kind, TypedValue::Kind::Null);
}

TEST(CocosMtl, ListsMayBeMissing) {
    const Mtl mtl = read(R"({ "__type__": "cc.Material", "_effectAsset": null, "_states": null })");
    EXPECT_EQ(mtl.name, "m");
    EXPECT_FALSE(mtl.effect);
    EXPECT_TRUE(mtl.passes.empty());
}

TEST(CocosMtl, EveryVectorAndMatrixTypeIsNumbers) {
    const Mtl mtl = withProps(R"([ {
      "v2": { "__type__": "cc.Vec2", "x": 1, "y": 2 }, "v3": { "__type__": "cc.Vec3", "x": 1, "y": 2, "z": 3 },
      "v4": { "__type__": "cc.Vec4", "x": 1, "y": 2, "z": 3, "w": 4 }, "q": { "__type__": "cc.Quat", "x": 1 },
      "m3": { "__type__": "cc.Mat3", "m00": 2, "m08": 5 }, "m4": { "__type__": "cc.Mat4", "m01": 7 },
      "c": { "__type__": "cc.Color", "r": 255 }, "o": { "__type__": "cc.Gradient" } } ])");
    const auto& props = mtl.passes[0].properties;
    EXPECT_EQ(props[0].value.plain.toJson(-1), "[1,2]");
    EXPECT_EQ(props[1].value.plain.toJson(-1), "[1,2,3]");
    EXPECT_EQ(props[2].value.plain.toJson(-1), "[1,2,3,4]");
    EXPECT_EQ(props[3].value.plain.toJson(-1), "[1,0,0,1]");
    EXPECT_EQ(props[4].value.plain.toJson(-1), "[2,0,0,0,1,0,0,0,5]");
    EXPECT_EQ(props[5].value.plain.toJson(-1), "[1,7,0,0,0,1,0,0,0,0,1,0,0,0,0,1]");
    EXPECT_EQ(props[6].value.plain.toJson(-1), "[1,0,0,1]");
    EXPECT_EQ(props[7].value.kind, TypedValue::Kind::Other);
}

TEST(CocosMtl, TheLenderOfAPassWinsOverItsOwnValues) {
    const MaterialEffect made = make(withProps(
        R"([ { "metallic": 0.1 }, { "metallic": 0.9, "tiling": { "__type__": "cc.Vec2", "x": 3, "y": 4 } } ])",
        R"([ { "A": true, "B": false }, { "B": true, "C": 2 } ])"));
    ASSERT_EQ(made.passes.size(), 3u);
    EXPECT_EQ(made.effect, "builtin-standard");
    EXPECT_EQ(made.passes[0].defines.toJson(-1), R"({"A":true,"B":false})");
    EXPECT_EQ(made.passes[0].properties.toJson(-1), R"({"metallic":0.1})");
    EXPECT_EQ(made.passes[1].defines.toJson(-1), R"({"B":false,"C":2,"A":true})");
    EXPECT_EQ(made.passes[1].properties.toJson(-1), R"({"metallic":0.1,"tiling":[3,4]})");
    EXPECT_EQ(made.passes[2].properties.toJson(-1), "{}");
}

TEST(CocosMtl, EmbeddedMacrosAreLeftToTheEffect) {
    const MaterialEffect made = make(withProps("[]", R"([ { "USE_ALBEDO_MAP": true, "CC_FORWARD_ADD": false } ])"));
    EXPECT_EQ(made.passes[0].defines.toJson(-1), R"({"USE_ALBEDO_MAP":true,"CC_FORWARD_ADD":false})");
    EXPECT_EQ(made.passes[1].defines.toJson(-1), "{}");
}

TEST(CocosMtl, ASwitchDropsItsPassUnlessTheMacroIsTrue) {
    const EffectAsset asset = effect();
    const EffectPass& pass = asset.techniques[0].passes[2];
    const auto dropped = [&](const std::string& defines) { return isDropped(pass, parseJson(defines, "d")); };
    EXPECT_TRUE(dropped("{}"));
    for (const char* falsy : {"false", "0", "\"\"", "null", "0.0"})
        EXPECT_TRUE(dropped(std::string("{\"USE_OUTLINE_PASS\":") + falsy + "}")) << falsy;
    for (const char* truthy : {"true", "1", "\"a\"", "-1"})
        EXPECT_FALSE(dropped(std::string("{\"USE_OUTLINE_PASS\":") + truthy + "}")) << truthy;
    EXPECT_FALSE(isDropped(asset.techniques[0].passes[0], parseJson("{}", "d")));
    EffectPass fixed = pass;
    fixed.embeddedMacros = {{"USE_OUTLINE_PASS", "1"}};
    EXPECT_FALSE(isDropped(fixed, parseJson(R"({"USE_OUTLINE_PASS":false})", "d")));
    fixed.embeddedMacros = {{"USE_OUTLINE_PASS", "0"}};
    EXPECT_TRUE(isDropped(fixed, parseJson(R"({"USE_OUTLINE_PASS":true})", "d")));
}

TEST(CocosMtl, UnknownNamesAndNullAreLeftOut) {
    const MaterialEffect made = make(withProps(
        R"([ { "strange": 5, "metallic": null, "mainColor": { "__type__": "cc.Color", "r": 255, "g": 255, "b": 255, "a": 255 } } ])"));
    EXPECT_EQ(made.passes[0].properties.toJson(-1), R"({"mainColor":[1,1,1,1]})");
}

TEST(CocosMtl, NullOfTheLenderTakesAValueBack) {
    const MaterialEffect made = make(withProps(R"([ { "metallic": null }, { "metallic": 0.9 } ])"));
    EXPECT_EQ(made.passes[1].properties.toJson(-1), "{}");
}

TEST(CocosMtl, AUniformsNameReachesThePropertiesThatFeedIt) {
    const MaterialEffect made = make(withProps(
        R"([ { "tilingOffset": { "__type__": "cc.Vec4", "x": 1, "y": 2, "z": 3, "w": 4 }, "albedo": { "__type__": "cc.Vec4", "x": 5, "y": 6, "z": 7, "w": 8 } } ])"));
    EXPECT_EQ(made.passes[0].properties.toJson(-1), R"({"tiling":[1,2],"offset":[3,4],"mainColor":[5,6,7,8]})");
}

TEST(CocosMtl, ComponentsOfAUniformMayBeNamedAsColours) {
    const MaterialEffect made =
        make(withProps(R"([ { "glowParams": { "__type__": "cc.Vec4", "x": 0.1, "y": 0.2, "z": 0.3, "w": 4 } } ])"));
    EXPECT_EQ(made.passes[0].properties.toJson(-1), R"({"glow":[0.1,0.2,0.3],"glowScale":4})");
}

TEST(CocosMtl, ValuesTakeTheLengthOfTheirUniform) {
    const MaterialEffect made = make(withProps(
        R"([ { "tiling": { "__type__": "cc.Vec4", "x": 1, "y": 2, "z": 3, "w": 4 }, "mainColor": { "__type__": "cc.Vec3", "x": 5, "y": 6, "z": 7 },
               "metallic": { "__type__": "cc.Vec2", "x": 0.5, "y": 9 }, "offset": [ 1, 2 ] } ])"));
    EXPECT_EQ(made.passes[0].properties.toJson(-1),
              R"({"tiling":[1,2],"mainColor":[5,6,7,0],"metallic":0.5,"offset":[1,2]})");
}

TEST(CocosMtl, ArraysKeepAllOfTheirElements) {
    const MaterialEffect made = make(withProps(
        R"([ { "tiling": [ { "__type__": "cc.Vec2", "x": 1, "y": 2 }, { "__type__": "cc.Vec2", "x": 3, "y": 4 } ],
               "mainColor": [ 1, 2, 3, 4, 5, 6, 7, 8 ], "offset": [ 1, 2, 3 ] } ])"));
    EXPECT_EQ(made.passes[0].properties.toJson(-1),
              R"({"tiling":[1,2,3,4],"mainColor":[1,2,3,4,5,6,7,8],"offset":[1,2]})");
}

TEST(CocosMtl, MacrosOfSeveralLinesAreErrors) {
    Problems problems;
    parseMtl(R"({ "__type__": "cc.Material", "_defines": [ { "A": "one\ntwo", "B": "v_uv" } ] })", "m.mtl", problems);
    ASSERT_EQ(problems.all().size(), 1u);
    EXPECT_EQ(problems.all()[0].message, "macro 'A' is a text of several lines");
}

TEST(CocosMtl, TexturesAreTheCallersBusiness) {
    std::string asked;
    const auto textures = [&](const AssetRef& texture, const EffectProperty& feeds) {
        asked += feeds.name + "=" + texture.uuid + ";";
        return feeds.name == "mainTexture" ? Value::makeInteger(7) : Value();
    };
    const MaterialEffect made =
        make(withProps(R"([ { "albedoMap": { "__uuid__": "a" }, "normalMap": { "__uuid__": "b" } } ])"), textures);
    EXPECT_EQ(made.passes[0].properties.toJson(-1), R"({"mainTexture":7})");
    EXPECT_EQ(asked, "mainTexture=a;normalMap=b;mainTexture=a;normalMap=b;");  // twice: the second pass borrows
}

TEST(CocosMtl, WrongKindsAreErrorsAtTheirPlace) {
    const std::string text = errorOf([&] {
        make(
            withProps("[ {\n\"metallic\": { \"__uuid__\": \"a\" },\n\"mainTexture\": 5,\n\"tiling\": "
                      "\"wide\",\n\"mainColor\": { \"__type__\": \"cc.Gradient\" } } ]"));
    });
    EXPECT_TRUE(contains(text, "m.mtl:2:13: error: property 'metallic' is an asset, but the effect takes numbers"))
        << text;
    EXPECT_TRUE(
        contains(text, "m.mtl:3:16: error: property 'mainTexture' is a number, but the effect takes a texture"));
    EXPECT_TRUE(contains(text, "m.mtl:4:11: error: property 'tiling' is a word, but the effect takes numbers"));
    EXPECT_TRUE(contains(text, "property 'mainColor' is of type 'cc.Gradient'"));
}

TEST(CocosMtl, StatesThatSayNothingAreLeftOut) {
    const MaterialEffect made = make(read(R"({ "__type__": "cc.Material", "_states": [
        { "rasterizerState": {}, "depthStencilState": {}, "blendState": { "targets": [ {} ] } },
        { "rasterizerState": { "cullMode": 0 }, "blendState": { "targets": [ {}, { "blend": true } ] }, "priority": 200 } ] })"));
    EXPECT_EQ(made.passes[0].states.toJson(-1), "{}");
    EXPECT_EQ(made.passes[1].states.toJson(-1),
              R"({"rasterizerState":{"cullMode":0},"blendState":{"targets":[{},{"blend":true}]},"priority":200})");
}

TEST(CocosMtl, ATechniqueThatTheEffectLacksIsAnErrorWhereItIsNamed) {
    Problems problems;
    const Mtl mtl = parseMtl("{ \"__type__\": \"cc.Material\",\n  \"_techIdx\": 3 }", "m.mtl", problems);
    instantiate(mtl, effect(), "e", {}, problems);
    ASSERT_EQ(problems.all().size(), 1u);
    EXPECT_EQ(problems.all()[0].where.line, 2);
}

TEST(CocosMtl, ATechniqueThatTheEffectLacksIsAnError) {
    const std::string text = errorOf([&] { make(read(R"({ "__type__": "cc.Material", "_techIdx": 3 })")); });
    EXPECT_TRUE(contains(text, "material 'm' uses technique 3, but effect 'builtin-standard' has 1")) << text;
}

TEST(CocosMtl, BrokenFilesAreErrors) {
    const auto errors = [](const std::string& text) { return errorOf([&] { read(text); }); };
    EXPECT_TRUE(contains(errors(R"({ "__type__": "cc.Prefab" })"), "'m.mtl' is no material"));
    EXPECT_TRUE(contains(errors(R"({ "__type__": "cc.Material", "_techIdx": -1 })"), "'_techIdx' -1 is no technique"));
    EXPECT_TRUE(contains(errors(R"({ "__type__": "cc.Material", "_defines": {} })"), "'_defines' must be a list"));
    EXPECT_TRUE(
        contains(errors(R"({ "__type__": "cc.Material", "_props": [ 5 ] })"), "item 0 of '_props' must be an object"));
    EXPECT_TRUE(contains(errors(R"({ "__type__": "cc.Material", "_defines": [ { "A": [] } ] })"),
                         "macro 'A' cannot be a list"));
    EXPECT_TRUE(contains(errors(R"({ "__type__": "cc.Material", "_effectAsset": "x" })"),
                         "'_effectAsset' must be an asset or null"));
    EXPECT_TRUE(contains(
        errors(R"({ "__type__": "cc.Material", "_props": [ { "c": { "__type__": "cc.Color", "r": "red" } } ] })"),
        "'r' of a cc.Color must be a number"));
    EXPECT_TRUE(contains(errors(R"({ "__type__": "cc.Material", "_props": [ { "c": )" + std::string(40, '[') +
                                std::string(40, ']') + "} ] }"),
                         "a list nested deeper than"));
}

}  // namespace
}  // namespace crevice::cocos
