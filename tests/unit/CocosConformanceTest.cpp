// The conformance project: effects of our own in Cocos' dialect, every pass compiled with every set of macros.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"

namespace crevice::cocos {
namespace {

using testing::ElementsAre;

class CocosConformance : public testing::TestWithParam<Defines> {
protected:
    static Roots roots() {
        const std::filesystem::path folder = std::filesystem::path(CREVICE_TEST_SOURCE_DIR) / "tests/cocos/conformance";
        return {{}, {}, folder / "engine"};
    }
};

TEST_P(CocosConformance, EveryPassCompiles) {
    keepCompilerWarm();
    CocosEffects names(roots());
    EffectLibrary library(AssetRoots({"none"}), Log(LogLevel::Error), {.useDiskCache = false});
    library.addFrontEnd(std::make_unique<CocosEffects>(roots()));
    std::size_t count = 0;
    for (const std::string& name : names.names()) {
        const EffectAsset& asset = library.asset(name);
        for (std::size_t technique = 0; technique < asset.techniques.size(); ++technique) {
            for (std::size_t pass = 0; pass < asset.techniques[technique].passes.size(); ++pass) {
                VariantRequest request{
                    .effect = name, .technique = technique, .pass = pass, .defines = GetParam(), .where = {}};
                request.checkOnly = true;  // some passes have resources that only the engine binds
                EXPECT_NO_THROW({
                    try {
                        library.get(request, {});
                    } catch (const Error& error) {
                        ADD_FAILURE() << name << " " << technique << "." << pass << "\n" << formatError(error);
                        throw;
                    }
                });
                ++count;
            }
        }
    }
    EXPECT_EQ(count, 14u);  // standard 5, surface 3, ripple 2, old, billboard, cluster, tiled 1 each.
}

INSTANTIATE_TEST_SUITE_P(
    MacroSets, CocosConformance,
    testing::Values(Defines{}, Defines{{"CC_USE_SKINNING", "1"}},
                    Defines{{"CC_USE_SKINNING", "1"}, {"CC_USE_BAKED_ANIMATION", "1"}, {"USE_INSTANCING", "1"}},
                    Defines{
                        {"CC_USE_MORPH", "1"}, {"CC_MORPH_TARGET_HAS_POSITION", "1"}, {"CC_MORPH_TARGET_COUNT", "4"}},
                    Defines{{"USE_INSTANCING", "1"}}, Defines{{"CC_RECEIVE_SHADOW", "1"}, {"CC_SHADOWMAP_FORMAT", "1"}},
                    Defines{{"CC_USE_IBL", "2"}}, Defines{{"CC_USE_FOG", "0"}},
                    Defines{{"CC_USE_FOG", "1"}, {"CC_USE_ACCURATE_FOG", "1"}}, Defines{{"CC_USE_HDR", "1"}},
                    Defines{{"HAS_SECOND_UV", "1"},
                            {"USE_VERTEX_COLOR", "1"},
                            {"USE_ALBEDO_MAP", "1"},
                            {"USE_ALPHA_TEST", "1"},
                            {"ALBEDO_UV", "v_uv.yx"},
                            {"OLD_KIND", "1"},
                            {"OLD_FLAG", "1"},
                            {"OLD_CHANNEL", "g"}},
                    Defines{{"RIPPLE_KIND", "1"}}, Defines{{"RIPPLE_KIND", "2"}},
                    Defines{{"RIPPLE_KIND", "2"}, {"RIPPLE_BOTH_WAYS", "1"}}));

using CocosConformanceFacts = CocosConformance;

TEST_F(CocosConformanceFacts, MacrosOfTheStandardPassInOrder) {
    CocosEffects effects(roots());
    Problems problems;
    const EffectAsset asset = effects.parse(*effects.find("standard"), "standard", problems);
    std::vector<std::string> names;
    for (const DefineInfo& info : effects.defines(asset, asset.techniques[0].passes[0], problems))
        names.push_back(info.name);
    problems.throwIfErrors();
    // By hand: the vertex program's text from its first line on, then what the fragment program adds. PIPELINE_*, FOG_*
    // and MAP_* are the text's own, CC_ENABLE_* the engine's; CC_USE_MORPH and CC_USE_SKINNING come with the input.
    EXPECT_THAT(names, ElementsAre("USE_INSTANCING", "USE_BATCHING", "CC_USE_SKINNING", "CC_USE_BAKED_ANIMATION",
                                   "CC_USE_MORPH", "CC_MORPH_TARGET_COUNT", "CC_MORPH_TARGET_HAS_POSITION",
                                   "CC_USE_IBL", "CC_RECEIVE_SHADOW", "CC_SHADOWMAP_FORMAT", "CC_USE_HDR", "CC_USE_FOG",
                                   "ALBEDO_UV", "USE_ALBEDO_MAP", "USE_ALPHA_TEST", "ALPHA_CHANNEL", "CC_FORWARD_ADD",
                                   "CC_PIPELINE_TYPE", "CC_FORCE_FORWARD_SHADING", "CC_USE_RGBE_OUTPUT"));
    const EffectPass& outline = asset.techniques[2].passes[0];
    EXPECT_EQ(outline.switchMacro, "USE_OUTLINE_PASS");
    EXPECT_EQ(outline.priority, 245);
    EXPECT_TRUE(outline.embeddedMacros.empty());  // The pass' own key replaces the merged one.
    EXPECT_EQ(outline.phase, "forward-add");
    EXPECT_FALSE(outline.state.depthWrite);
}

TEST_F(CocosConformanceFacts, ComparedMacrosAndCountedRegistersOfTheRipple) {
    CocosEffects effects(roots());
    Problems problems;
    const EffectAsset asset = effects.parse(*effects.find("advanced/ripple"), "advanced/ripple", problems);
    const EffectPass& pass = asset.techniques[0].passes[0];
    EXPECT_EQ(pass.priority, 252);
    // By hand: a comparison makes a number from 0 to 3 of the first, a plain condition a bool of the second.
    const std::vector<DefineInfo> infos = effects.defines(asset, pass, problems);
    ASSERT_EQ(infos.size(), 2u);
    EXPECT_EQ(infos[0].name, "RIPPLE_KIND");
    EXPECT_EQ(infos[0].type, DefineType::Number);
    EXPECT_EQ(infos[0].range, std::pair(0, 3));
    EXPECT_EQ(infos[1].name, "RIPPLE_BOTH_WAYS");
    EXPECT_EQ(infos[1].type, DefineType::Bool);
    // One vec4 and an array of two: three registers.
    const std::vector<StageSource> stages = effects.stages(asset, pass, VariantRequest{}, {}, problems);
    ASSERT_EQ(stages.size(), 2u);
    EXPECT_NE(stages[1].head.find("#define CC_EFFECT_USED_FRAGMENT_UNIFORM_VECTORS 3\n"), std::string::npos);
    problems.throwIfErrors();
}

}  // namespace
}  // namespace crevice::cocos
