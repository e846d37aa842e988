// Materials: bytes at the shader's offsets, checks of type, count and range, textures by name, `auto`.
#include <gtest/gtest.h>

#include <cstring>

#include "EffectTestTools.h"

namespace crevice {
namespace {

const char* const kProperties =
    "      properties:\n"
    "        strength: { value: 0.5, editor: { range: [0, 2] } }\n"
    "        tint: { value: [1, 0.5, 0.25], editor: { range: [0, 1] } }\n"
    "        offset: { value: [3, 4], target: params.yz }\n"
    "        first: { value: 2, target: params.x }\n"
    "        color: { value: [0.5, 1, 0, 0.5], linear: true }\n"
    "        steps: { value: 7 }\n"
    "        radius: { value: auto, editor: { range: [0.001, 100] } }\n"
    "        optional: { value: 1, target: hidden }\n"
    "        map: { value: grey }\n"
    "        hiddenMap: { value: white }\n";
const char* const kFragment =
    "in vec2 v_uv;\nlayout(location = 0) out vec4 o;\nuniform Block { float strength; vec3 tint; vec4 params; vec4 "
    "color; int steps; float radius;\n"
    "#if HIDDEN\n float hidden;\n#endif\n};\nuniform sampler2D map;\nuniform sampler2D wired;\n#if HIDDEN\nuniform "
    "sampler2D hiddenMap;\n#endif\n"
    "void main() { o = vec4(strength + radius + float(steps)) + vec4(tint, 1.0) + params + color + texture(map, v_uv) "
    "+ texture(wired, v_uv); }\n";

class MaterialOf : public testing::Test {
protected:
    MaterialOf() { bench_.fullscreen(kFragment, kProperties); }
    float at(const Material& material, std::size_t offset) const {
        float value = -1;
        const auto& bytes = material.blocks().at(0).bytes;
        EXPECT_LE(offset + sizeof value, bytes.size());
        std::memcpy(&value, bytes.data() + offset, sizeof value);
        return value;
    }
    Problem applied(const std::string& json) {
        Material material(bench_.get());
        Problems problems;
        material.apply(parseJson(json, "p.json"), problems);
        return problems.all().empty() ? Problem{} : problems.all().front();
    }
    EffectBench bench_;
};

TEST_F(MaterialOf, DefaultsLieAtStd140Offsets) {
    const Material material(bench_.get());
    ASSERT_EQ(material.blocks().size(), 1u);
    EXPECT_EQ(material.blocks()[0].name, "Block");
    EXPECT_EQ(material.blocks()[0].slot, (BindingSlot{1, 0}));
    EXPECT_EQ(material.blocks()[0].bytes.size(), 72u);
    EXPECT_EQ(at(material, 0), 0.5f);
    EXPECT_EQ(at(material, 16), 1.0f);
    EXPECT_EQ(at(material, 24), 0.25f);
    EXPECT_EQ(at(material, 32), 2.0f);  // params.x
    EXPECT_EQ(at(material, 36), 3.0f);  // params.yz
    EXPECT_EQ(at(material, 40), 4.0f);
    EXPECT_EQ(at(material, 44), 0.0f);
    EXPECT_NEAR(at(material, 48), 0.2140411f, 1e-6f);  // sRGB 0.5
    EXPECT_EQ(at(material, 52), 1.0f);
    EXPECT_EQ(at(material, 60), 0.5f);  // Alpha is linear anyway.
    std::int32_t steps = 0;
    std::memcpy(&steps, material.blocks()[0].bytes.data() + 64, sizeof steps);
    EXPECT_EQ(steps, 7);
}

TEST_F(MaterialOf, ValuesFromDocuments) {
    Material material(bench_.get());
    Problems problems;
    material.apply(
        parseJson(
            R"({"strength": 1.5, "tint": [0, 1, 0], "offset": [8, 9], "radius": 2, "optional": 5, "hiddenMap": "a.png", "map": "wood.png"})",
            "p.json"),
        problems);
    for (const Problem& problem : problems.all()) ADD_FAILURE() << formatProblem(problem);
    EXPECT_EQ(at(material, 0), 1.5f);
    EXPECT_EQ(at(material, 20), 1.0f);
    EXPECT_EQ(at(material, 36), 8.0f);
    EXPECT_EQ(at(material, 32), 2.0f);
    EXPECT_EQ(at(material, 68), 2.0f);
    EXPECT_TRUE(material.autoProperties().empty());
    EXPECT_EQ(material.samplers().at(0).texture, "wood.png");
    EXPECT_EQ(material.value("optional")->number(), 5);
}

TEST_F(MaterialOf, SamplersOfTheMaterialSet) {
    const Material material(bench_.get());
    ASSERT_EQ(material.samplers().size(), 2u);
    EXPECT_EQ(material.samplers()[0].name, "map");
    EXPECT_EQ(material.samplers()[0].texture, "grey");
    EXPECT_TRUE(material.samplers()[0].isProperty);
    EXPECT_EQ(material.samplers()[0].slot, (BindingSlot{1, 1}));
    EXPECT_EQ(material.samplers()[1].name, "wired");
    EXPECT_FALSE(material.samplers()[1].isProperty);
}

TEST_F(MaterialOf, AutoIsLeftToTheRuntime) {
    Material material(bench_.get());
    EXPECT_EQ(material.autoProperties(), std::vector<std::string>{"radius"});
    material.set("radius", 3.5f);
    EXPECT_TRUE(material.autoProperties().empty());
    EXPECT_EQ(at(material, 68), 3.5f);
    Problems problems;
    material.apply(parseJson(R"({"radius": "auto"})", "p.json"), problems);
    EXPECT_FALSE(problems.hasErrors());
    EXPECT_EQ(material.autoProperties(), std::vector<std::string>{"radius"});
}

TEST_F(MaterialOf, ValuesFromCode) {
    Material material(bench_.get());
    material.set("strength", 1.0f);
    material.set("tint", glm::vec3(0.1f, 0.2f, 0.3f));
    material.set("offset", glm::vec2(5, 6));
    material.set("color", glm::vec4(0, 0, 0, 1));
    material.set("steps", 3);
    material.set("map", "black");
    EXPECT_EQ(at(material, 0), 1.0f);
    EXPECT_EQ(at(material, 24), 0.3f);
    EXPECT_EQ(at(material, 40), 6.0f);
    EXPECT_EQ(material.samplers()[0].texture, "black");
    EXPECT_THROW(material.set("strength", 3.0f), Error);
    EXPECT_THROW(material.set("strenght", 1.0f), Error);
    EXPECT_THROW(material.set("tint", 1.0f), Error);
}

TEST_F(MaterialOf, UsedWhenTheMacroIsOn) {
    Material material(bench_.get({{"HIDDEN", "1"}}));
    EXPECT_EQ(at(material, 72), 1.0f);
    EXPECT_EQ(material.samplers().size(), 3u);
}

TEST_F(MaterialOf, MistakesHavePlacesAndAdvice) {
    struct Case {
        const char* json;
        const char* message;
        const char* help;
        int column;
    };
    const Case cases[] = {
        {R"({"strenght": 1})", "effect 'e' has no property 'strenght'", "did you mean 'strength'", 2},
        {R"({"strength": 3})", "property 'strength' is 3, outside its range", "give 0 to 2", 14},
        {R"({"strength": true})", "property 'strength' takes numbers, not a bool", "", 14},
        {R"({"strength": "auto"})", "property 'strength' takes numbers, not a string", "", 14},
        {R"({"radius": "big"})", "property 'radius' takes numbers or the word auto, not a string", "", 12},
        {R"({"tint": [1, 1]})", "property 'tint' takes 3 numbers, not 2", "", 10},
        {R"({"tint": [1, 1, 4]})", "property 'tint' is 4, outside its range", "give 0 to 1", 17},
        {R"({"tint": [1, "a", 1]})", "property 'tint' takes numbers, not this list", "", 10},
        {R"({"optional": [1, 2]})", "property 'optional' takes 1 number, not 2", "", 14},
        {R"({"map": 3})", "property 'map' is a texture and cannot be a number", "white", 9},
        {R"({"hiddenMap": 3})", "property 'hiddenMap' is a texture and cannot be a number", "white", 15},
        {R"([1])", "'material' must be an object, not a list", "", 1},
    };
    for (const Case& c : cases) {
        const Problem problem = applied(c.json);
        EXPECT_EQ(problem.message, c.message);
        EXPECT_EQ(problem.where.file, "p.json");
        EXPECT_EQ(problem.where.line, 1);
        EXPECT_EQ(problem.where.column, c.column) << c.json;
        EXPECT_NE(problem.help.find(c.help), std::string::npos) << problem.help;
    }
}

TEST(MaterialProperties, ThatDoNotFitTheirUniform) {
    EffectBench bench;
    bench.fullscreen(
        "layout(location = 0) out vec4 o;\nuniform Block { vec4 v; float list[2]; };\nvoid main() { o = v * list[0]; "
        "}\n",
        "      properties:\n        wide: { value: [1, 2], target: v.w }\n        run: { value: [1, 2], target: v.zx "
        "}\n        list: { value: 1 }\n");
    try {
        const Material material(bench.get());
        FAIL() << "no error";
    } catch (const Error& error) {
        ASSERT_EQ(error.problems().size(), 3u);
        EXPECT_EQ(error.problems()[0].message, "property 'wide' takes 1 number, not 2");
        EXPECT_EQ(error.problems()[1].message, "property 'run' cannot feed 'v.zx' of type vec4");
        EXPECT_EQ(error.problems()[2].message, "property 'list' cannot feed 'list' of type float array");
        EXPECT_EQ(error.problems()[1].where.line, 8);
    }
}

TEST(MaterialProperties, ArraysWhoseSizeIsNotPlainAreRefused) {
    const auto problemOf = [](const std::string& list, const std::string& use) {
        EffectBench bench;
        bench.fullscreen(
            "layout(location = 0) out vec4 o;\nlayout(constant_id = 0) const int N = 4;\nuniform Block { " + list +
            " float last; };\nvoid main() { o = vec4(last) + " + use + "; }\n");
        return bench.problem();
    };
    EXPECT_EQ(problemOf("vec4 list[4];", "list[1]").message, "");
    for (const auto& [list, use] : {std::pair("vec4 list[N];", "list[1]"), std::pair("vec4 list[3][2];", "list[1][1]"),
                                    std::pair("vec4 list[N][2];", "list[1][1]")}) {
        const Problem problem = problemOf(list, use);
        EXPECT_EQ(problem.message, "member 'list' of 'Block' is an array that Crevice cannot fill") << list;
        EXPECT_EQ(problem.where.line, 14);
    }
}

}  // namespace
}  // namespace crevice
