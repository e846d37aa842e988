// Whole effects from their files to the metadata that the engine would load, and to SPIR-V with the same numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "cocos/CocosEffects.h"
#include "cocos/reflection/EffectReflection.h"
#include "core/Files.h"
#include "core/Log.h"
#include "effect/EffectLibrary.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

fs::path fixture() { return fs::path(CREVICE_TEST_SOURCE_DIR) / "tests/cocos/reflection"; }

Roots fixtureRoots() {
    Roots roots;
    roots.engine = fixture() / "engine";
    return roots;
}

/// Keys sorted, so that only their order may differ.
std::string canonical(const Value& value, int depth = 0) {
    const std::string indent(static_cast<std::size_t>(depth) * 2 + 2, ' ');
    if (value.isObject()) {
        std::map<std::string, std::string> members;
        for (const Member& member : value.members()) members[member.key] = canonical(member.value, depth + 1);
        std::string text = "{\n";
        for (const auto& [key, inner] : members) text.append(indent).append(key).append(": ").append(inner) += "\n";
        return text + indent.substr(2) + "}";
    }
    if (value.isArray() &&
        std::any_of(value.items().begin(), value.items().end(), [](const Value& item) { return item.isObject(); })) {
        std::string text = "[\n";
        for (const Value& item : value.items()) text.append(indent).append(canonical(item, depth + 1)) += "\n";
        return text + indent.substr(2) + "]";
    }
    return value.toJson(-1);
}

class CocosEffectReflection : public testing::TestWithParam<std::string> {};

TEST_P(CocosEffectReflection, EqualsWhatTheRulesSay) {
    CocosEffects effects(fixtureRoots());
    const auto path = effects.findShort(GetParam());
    ASSERT_TRUE(path);
    Problems problems;
    const EffectAsset effect = effects.parse(*path, GetParam(), problems);
    const Value reflected = reflectEffect(effects, effect, problems);
    for (const Problem& problem : problems.all()) ADD_FAILURE() << formatProblem(problem);
    const fs::path expected = fixture() / "expected" / (GetParam() + ".json");
    EXPECT_EQ(canonical(reflected), canonical(parseJson(readText(expected, 1 << 20), expected.string())));
}

INSTANTIATE_TEST_SUITE_P(All, CocosEffectReflection, testing::Values("surface", "tint"));

class CocosCompile : public testing::Test {
protected:
    CocosCompile() { library_.addFrontEnd(std::make_unique<CocosEffects>(fixtureRoots())); }

    const EffectVariant& get(const std::string& effect, std::size_t pass, Defines defines, const BindingMap& map = {}) {
        return library_.get(
            {.effect = effect, .technique = 0, .pass = pass, .defines = std::move(defines), .where = {}}, map);
    }

    EffectLibrary library_{AssetRoots({}), Log(LogLevel::Error), {.useDiskCache = false}};
};

BindingSlot slotOf(const EffectVariant& variant, const std::string& name) {
    const ShaderResource* resource = variant.info.find(name);
    return resource == nullptr ? BindingSlot{99, 99} : resource->slot;
}

TEST_F(CocosCompile, BindingsDoNotDependOnTheVariant) {
    for (const Defines& defines : {Defines{{"USE_ALBEDO_MAP", "1"}}, Defines{{"USE_ALBEDO_MAP", "1"},
                                                                             {"USE_NORMAL_MAP", "1"},
                                                                             {"USE_INSTANCING", "1"},
                                                                             {"CC_USE_SKINNING", "1"},
                                                                             {"CC_RECEIVE_SHADOW", "1"}}}) {
        const EffectVariant& variant = get("surface", 0, defines);
        EXPECT_EQ(slotOf(variant, "Constants"), (BindingSlot{1, 0}));
        EXPECT_EQ(slotOf(variant, "albedoMap"), (BindingSlot{1, 2}));
        EXPECT_EQ(slotOf(variant, "CCCamera"), (BindingSlot{0, 1}));
    }
}

TEST_F(CocosCompile, AttributesHaveTheNumbersOfTheMetadata) {
    const EffectVariant& variant = get("surface", 0, {{"USE_INSTANCING", "1"}, {"USE_VERTEX_COLOR", "1"}});
    std::map<std::string, std::uint32_t> locations;
    for (const ShaderVariable& input : variant.info.inputs) locations[input.name] = input.location;
    EXPECT_EQ(locations, (std::map<std::string, std::uint32_t>{{"a_position", 0},
                                                               {"a_texCoord", 1},
                                                               {"a_matWorld0", 5},
                                                               {"a_matWorld1", 6},
                                                               {"a_matWorld2", 7},
                                                               {"a_color", 11}}));
}

TEST_F(CocosCompile, ARepeatedAttributeHasOneNumber) {
    for (const char* mode : {"1", "2"}) {
        const EffectVariant& variant = get("pipeline/tint", 0, {{"CC_MODE", mode}});
        const auto& inputs = variant.info.inputs;
        const auto it = std::find_if(inputs.begin(), inputs.end(), [](const auto& v) { return v.name == "a_color1"; });
        ASSERT_NE(it, inputs.end());
        EXPECT_EQ(it->location, 3u);
    }
}

TEST_F(CocosCompile, APipelinesNamesWin) {
    const EffectVariant& variant = get("surface", 0, {{"CC_RECEIVE_SHADOW", "1"}},
                                       {{"CCCamera", {0, 7}}, {"CCGlobal", {0, 0}}, {"cc_shadowMap", {0, 4}}});
    EXPECT_EQ(slotOf(variant, "CCCamera"), (BindingSlot{0, 7}));
    EXPECT_EQ(slotOf(variant, "cc_shadowMap"), (BindingSlot{0, 4}));
    // The object's block has no number there: it follows the material's.
    EXPECT_EQ(slotOf(variant, "CCLocal"), (BindingSlot{1, 3}));
}

}  // namespace
}  // namespace crevice::cocos
