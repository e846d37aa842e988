// An engine of the shape of 3.3's, in our own words: its metadata by the rules that the published metadata of that time
// follows (formats, 1.6 and 1.7), and every pass with each of the engine's macro sets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"
#include "cocos/reflection/EffectReflection.h"

namespace crevice::cocos {
namespace {

using testing::ElementsAre;

Roots shapeRoots() { return {{}, {}, std::filesystem::path(CREVICE_TEST_SOURCE_DIR) / "tests/cocos/shape-v33/engine"}; }

class CocosShape33 : public testing::Test {
protected:
    void SetUp() override { keepCompilerWarm(); }

    const Value& shader(const std::string& effect, const std::string& name) {
        CocosEffects effects(shapeRoots());
        Problems problems;
        reflected_ = reflectEffect(effects, effects.parse(*effects.find(effect), effect, problems), problems);
        problems.throwIfErrors();
        for (const Value& shader : reflected_.find("shaders")->items())
            if (shader.find("name")->string() == name) return shader;
        throw Error("no shader '" + name + "'");
    }

    static std::string joined(const Value& list) {
        std::string text;
        for (const Value& item : list.items()) text += (text.empty() ? "" : " ") + item.string();
        return text;
    }

    static std::vector<std::string> names(const Value& list) {
        std::vector<std::string> all;
        for (const Value& item : list.items()) all.push_back(item.find("name")->string());
        return all;
    }

    /// "NAME: condition condition".
    static std::vector<std::string> conditions(const Value& list) {
        std::vector<std::string> all;
        for (const Value& item : list.items())
            all.push_back(item.find("name")->string() + ": " + joined(*item.find("defines")));
        return all;
    }

    /// "NAME LOCATION FORMAT", "-" where the engine has no format.
    static std::vector<std::string> places(const Value& list) {
        std::vector<std::string> all;
        for (const Value& item : list.items()) {
            const Value* format = item.find("format");
            all.push_back(item.find("name")->string() + " " + std::to_string(item.find("location")->integer()) + " " +
                          (format == nullptr ? "-" : std::to_string(format->integer())));
        }
        return all;
    }

    static std::pair<std::int64_t, std::int64_t> registers(const Value& shader) {
        const Value& all = *shader.find("builtins")->find("statistics");
        return {all.find("CC_EFFECT_USED_VERTEX_UNIFORM_VECTORS")->integer(),
                all.find("CC_EFFECT_USED_FRAGMENT_UNIFORM_VECTORS")->integer()};
    }

    static const Value& builtin(const Value& shader, const char* side, const char* kind) {
        return *shader.find("builtins")->find(side)->find(kind);
    }

    Value reflected_;
};

TEST_F(CocosShape33, MacrosAndAttributesOfTheSurface) {
    const Value& shader = this->shader("builtin-surface", "builtin-surface|surface-vs|surface-fs");
    // The vertex program's in text order, then what the fragment program adds; the entry macro brings the lamps last.
    EXPECT_THAT(
        names(*shader.find("defines")),
        ElementsAre("CC_USE_MORPH", "CC_MORPH_TARGET_COUNT", "CC_MORPH_TARGET_HAS_POSITION", "CC_MORPH_PRECOMPUTED",
                    "CC_USE_SKINNING", "CC_USE_BAKED_ANIMATION", "USE_INSTANCING", "USE_BATCHING", "USE_LIGHTMAP",
                    "CC_USE_FOG", "CC_FORWARD_ADD", "CC_RECEIVE_SHADOW", "USE_VERTEX_COLOR", "HAS_SECOND_UV",
                    "SAMPLE_FROM_RT", "MAP_KIND", "CC_USE_IBL", "CC_USE_HDR", "USE_TINT_MAP", "TINT_UV",
                    "USE_ALPHA_TEST", "ALPHA_CHANNEL", "CC_PIPELINE_TYPE"));
    // 0 to 5 are written; a_vertexId, which only other GLSL versions declare, is the first of the others.
    EXPECT_THAT(
        places(*shader.find("attributes")),
        ElementsAre("a_position 0 32", "a_normal 1 32", "a_texCoord 2 21", "a_tangent 3 44", "a_vertexId 6 11",
                    "a_joints 4 -", "a_weights 5 44", "a_jointAnimInfo 7 44", "a_matWorld0 8 44", "a_matWorld1 9 44",
                    "a_lightingMapUVParam 10 44", "a_dyn_batch_id 11 11", "a_color 12 44", "a_texCoord1 13 21"));
    EXPECT_THAT(
        conditions(*shader.find("attributes")),
        ElementsAre("a_position: ", "a_normal: ", "a_texCoord: ", "a_tangent: ", "a_vertexId: CC_USE_MORPH",
                    "a_joints: CC_USE_SKINNING", "a_weights: CC_USE_SKINNING",
                    "a_jointAnimInfo: CC_USE_SKINNING CC_USE_BAKED_ANIMATION USE_INSTANCING",
                    "a_matWorld0: USE_INSTANCING", "a_matWorld1: USE_INSTANCING",
                    "a_lightingMapUVParam: USE_INSTANCING USE_LIGHTMAP", "a_dyn_batch_id: !USE_INSTANCING USE_BATCHING",
                    "a_color: USE_VERTEX_COLOR", "a_texCoord1: "));
}

TEST_F(CocosShape33, ResourcesOfTheSurface) {
    const Value& shader = this->shader("builtin-surface", "builtin-surface|surface-vs|surface-fs");
    EXPECT_THAT(conditions(builtin(shader, "globals", "blocks")),
                ElementsAre("CCGlobal: ", "CCCamera: ", "CCShadow: "));
    EXPECT_THAT(conditions(builtin(shader, "globals", "samplerTextures")),
                ElementsAre("cc_shadowMap: CC_RECEIVE_SHADOW", "cc_environment: CC_USE_IBL"));
    EXPECT_THAT(conditions(builtin(shader, "locals", "blocks")),
                ElementsAre("CCMorph: CC_USE_MORPH", "CCSkinningTexture: CC_USE_SKINNING CC_USE_BAKED_ANIMATION",
                            "CCSkinning: CC_USE_SKINNING !CC_USE_BAKED_ANIMATION",
                            "CCLocalBatched: !USE_INSTANCING USE_BATCHING", "CCLocal: !USE_INSTANCING !USE_BATCHING",
                            "CCForwardLight: CC_FORWARD_ADD"));
    EXPECT_THAT(conditions(builtin(shader, "locals", "samplerTextures")),
                ElementsAre("cc_PositionDisplacements: CC_USE_MORPH CC_MORPH_TARGET_HAS_POSITION",
                            "cc_jointTexture: CC_USE_SKINNING CC_USE_BAKED_ANIMATION",
                            "cc_lightingMap: USE_LIGHTMAP !USE_BATCHING !CC_FORWARD_ADD"));
    // 16 morph, 1 + 90 bones, 2 + 11 frame, 40 + 8 things, 3 of the material, 5 shadow; the lamps' `# define` is seen
    // by no compiler of Cocos': its arrays have no size and do not count.
    EXPECT_EQ(registers(shader), std::pair(std::int64_t{176}, std::int64_t{21}));
    EXPECT_EQ(shader.find("blocks")->items()[0].find("stageFlags")->integer(), 17);
    EXPECT_THAT(conditions(*shader.find("samplerTextures")), ElementsAre("tintMap: USE_TINT_MAP"));
    EXPECT_EQ(shader.find("samplerTextures")->items()[0].find("binding")->integer(), 1);
}

TEST_F(CocosShape33, FunctionsThatNobodyCallsSayNothing) {
    const Value& caster = shader("builtin-surface", "builtin-surface|caster-vs:vert|caster-fs:frag");
    EXPECT_THAT(names(*caster.find("defines")),
                ElementsAre("CC_USE_MORPH", "CC_MORPH_TARGET_COUNT", "CC_MORPH_TARGET_HAS_POSITION",
                            "CC_MORPH_PRECOMPUTED", "CC_USE_SKINNING", "CC_USE_BAKED_ANIMATION", "USE_INSTANCING",
                            "USE_BATCHING", "USE_LIGHTMAP", "CC_RECEIVE_SHADOW"));
    EXPECT_EQ(registers(caster), std::pair(std::int64_t{173}, std::int64_t{18}));
    const Value& light = shader("pipeline/light", "pipeline/light|quad-vs|light-fs");
    EXPECT_THAT(
        names(*light.find("defines")),
        ElementsAre("CC_USE_MORPH", "CC_MORPH_TARGET_COUNT", "CC_MORPH_TARGET_HAS_POSITION", "CC_USE_SKINNING",
                    "CC_USE_BAKED_ANIMATION", "USE_INSTANCING", "CC_RECEIVE_SHADOW", "MAP_KIND", "CC_USE_IBL",
                    "USE_LIGHTMAP", "USE_BATCHING", "CC_FORWARD_ADD", "CC_PIPELINE_TYPE", "CC_USE_HDR", "CC_USE_FOG"));
    EXPECT_THAT(conditions(builtin(light, "locals", "blocks")), testing::Contains("CCForwardLight: "));
}

TEST_F(CocosShape33, AnAttributeOfTwoBranchesHasTheLastNumber) {
    const Value& shader = this->shader("particle", "particle|sparks:sparks_main|tinted-fs:add");
    EXPECT_THAT(names(*shader.find("defines")), ElementsAre("CC_RENDER_MODE", "CC_USE_WORLD_SPACE", "CC_USE_HDR"));
    EXPECT_THAT(places(*shader.find("attributes")), ElementsAre("a_position 0 32", "a_texCoord 1 32", "a_color 2 44",
                                                                "a_color1 6 32", "a_texCoord3 4 32", "a_normal 5 32"));
    EXPECT_THAT(conditions(*shader.find("attributes")), testing::Contains("a_color1: CC_RENDER_MODE"));
    EXPECT_EQ(registers(shader), std::pair(std::int64_t{22}, std::int64_t{1}));
}

class CocosShape33Sets : public testing::TestWithParam<Defines> {};

TEST_P(CocosShape33Sets, EveryPassCompiles) {
    keepCompilerWarm();
    EffectLibrary library(AssetRoots({"none"}), Log(LogLevel::Error), {.useDiskCache = false});
    library.addFrontEnd(std::make_unique<CocosEffects>(shapeRoots()));
    std::size_t count = 0;
    for (const std::string name : {"builtin-surface", "particle", "pipeline/light"}) {
        const EffectAsset& asset = library.asset(name);
        for (std::size_t technique = 0; technique < asset.techniques.size(); ++technique) {
            for (std::size_t pass = 0; pass < asset.techniques[technique].passes.size(); ++pass, ++count) {
                VariantRequest request{
                    .effect = name, .technique = technique, .pass = pass, .defines = GetParam(), .where = {}};
                request.checkOnly = true;
                try {
                    library.get(request, {});
                } catch (const Error& error) {
                    ADD_FAILURE() << name << " " << technique << "." << pass << "\n" << formatError(error);
                }
            }
        }
    }
    EXPECT_EQ(count, 10u);
}

TEST_F(CocosShape33, APassWhoseSourceLacksADeclarationNamesIt) {
    EffectLibrary library(AssetRoots({"none"}), Log(LogLevel::Error), {.useDiskCache = false});
    library.addFrontEnd(std::make_unique<CocosEffects>(shapeRoots()));
    VariantRequest request{.effect = "pipeline/light", .defines = {{"USE_LIGHTMAP", "1"}}, .where = {}};
    request.checkOnly = true;
    std::string said;
    try {
        library.get(request, {});
    } catch (const Error& error) {
        said = formatError(error);
    }
    EXPECT_THAT(said, testing::HasSubstr("matter.chunk:23"));
    EXPECT_THAT(said, testing::HasSubstr("'baked'"));
}

INSTANTIATE_TEST_SUITE_P(
    All, CocosShape33Sets,
    testing::Values(Defines{}, Defines{{"CC_USE_SKINNING", "1"}},
                    Defines{{"CC_USE_SKINNING", "1"}, {"CC_USE_BAKED_ANIMATION", "1"}, {"USE_INSTANCING", "1"}},
                    Defines{{"CC_USE_MORPH", "1"}, {"CC_MORPH_TARGET_HAS_POSITION", "1"}},
                    Defines{{"CC_RECEIVE_SHADOW", "1"}, {"MAP_KIND", "1"}},
                    Defines{{"CC_USE_IBL", "2"}, {"CC_USE_HDR", "1"}}, Defines{{"CC_USE_FOG", "0"}},
                    Defines{{"CC_PIPELINE_TYPE", "1"}, {"CC_RENDER_MODE", "1"}}));

}  // namespace
}  // namespace crevice::cocos
