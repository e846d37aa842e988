// The YAML header of Cocos' effects: its keys, shorthands, inheritance, tolerance, and the blocks of a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"

namespace crevice::cocos {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class CocosHeader : public testing::Test {
protected:
    /// Lines of the header, 2 spaces deep at the least.
    EffectAsset read(const std::string& header, const std::string& more = "") {
        bench.folder.write("p/assets/effects/t.effect", "CCEffect %{\n" + header + "}%\n" + more);
        problems = Problems();
        return bench.parse(problems);
    }
    /// One pass with the lines, 6 spaces deep.
    EffectPass pass(const std::string& lines) {
        const EffectAsset asset = read("  techniques:\n  - passes:\n    - vert: vs\n      frag: fs\n" + lines);
        EXPECT_FALSE(problems.hasErrors()) << (problems.all().empty() ? "" : problems.all()[0].message);
        return asset.techniques.empty() ? EffectPass{} : asset.techniques[0].passes[0];
    }
    std::string firstError() const {
        for (const Problem& problem : problems.all())
            if (problem.severity == Severity::Error) return problem.message;
        return {};
    }

    CocosBench bench;
    Problems problems;
};

TEST_F(CocosHeader, RedefinedAnchorsAndMergeKeys) {
    const EffectAsset asset = read(
        "  temporaries:\n    a: &props\n      one: { value: 1 }\n    b: &extended\n      <<: *props\n      two: { "
        "value: 2 }\n"
        "  techniques:\n  - name: first\n    passes:\n    - vert: vs\n      frag: fs\n      properties: *extended\n"
        "    - vert: vs\n      frag: fs\n      properties: &props\n        three: { value: 0x80 }\n"
        "  - name: second\n    passes:\n    - vert: vs\n      frag: fs\n      properties: *props\n");
    ASSERT_FALSE(problems.hasErrors());
    ASSERT_EQ(asset.techniques.size(), 2u);
    ASSERT_EQ(asset.techniques[0].passes[0].properties.size(), 2u);
    EXPECT_EQ(asset.techniques[0].passes[0].properties[0].name, "one");
    EXPECT_EQ(asset.techniques[0].passes[0].properties[1].name, "two");
    ASSERT_EQ(asset.techniques[1].passes[0].properties.size(), 1u);
    EXPECT_EQ(asset.techniques[1].passes[0].properties[0].name, "three");
    EXPECT_EQ(asset.techniques[1].passes[0].properties[0].value.integer(), 128);
}

TEST_F(CocosHeader, TabsWindowsLinesAndByteOrderMark) {
    bench.folder.write("p/assets/effects/t.effect",
                       "\xEF\xBB\xBF// a comment\r\nCCEffect %{\r\n  techniques:\r\n  - passes:\r\n    - vert:\tvs\r\n"
                       "      frag: fs\r\n      properties:\r\n\t\t\t\ttint: { value: [1, 1, 1, 1],\teditor: { "
                       "displayName: i18n:a:b } }"
                       "\r\n}%\r\nCCProgram vs %{\r\nfloat a;\r\n}%\r\n");
    problems = Problems();
    const EffectAsset asset = bench.parse(problems);
    EXPECT_EQ(firstError(), "");
    ASSERT_EQ(asset.techniques.size(), 1u);
    EXPECT_EQ(asset.techniques[0].passes[0].vertex, "vs");
    EXPECT_EQ(asset.programs.at("vs").firstLine, 10);
}

TEST_F(CocosHeader, PassKeys) {
    const EffectPass read = pass(
        "      phase: deferred-forward\n      pass: gbuffer\n      subpass: sub\n      priority : max - 10\n"
        "      switch: USE_OUTLINE\n      primitive: LINE_LIST\n"
        "      embeddedMacros: { CC_FORWARD_ADD: true, CC_PIPELINE_TYPE: 1, WORD: v_uv }\n"
        "      migrations: { properties: { a: { formerlySerializedAs: b.x } } }\n      dynamicStates: [line_width]\n"
        "      unheardOf: 1\n      depthTest: false\n");
    EXPECT_EQ(read.phase, "deferred-forward");
    EXPECT_EQ(read.passName, "gbuffer");
    EXPECT_EQ(read.priority, 245);
    EXPECT_EQ(read.switchMacro, "USE_OUTLINE");
    EXPECT_EQ(read.state.topology, Topology::LineList);
    EXPECT_EQ(read.embeddedMacros, (std::map<std::string, std::string>{
                                       {"CC_FORWARD_ADD", "1"}, {"CC_PIPELINE_TYPE", "1"}, {"WORD", "v_uv"}}));
    EXPECT_TRUE(read.state.depthTest);  // Not a key of a pass: read by nobody.
    std::vector<std::string> notes;
    for (const Problem& problem : problems.all())
        if (problem.severity == Severity::Note) notes.push_back(problem.message);
    EXPECT_THAT(notes, ElementsAre("key 'unheardOf' in a pass is not read", "key 'depthTest' in a pass is not read"));
}

TEST_F(CocosHeader, DefaultsAreCocos) {
    const EffectPass read = pass("");
    EXPECT_EQ(read.phase, "default");
    EXPECT_EQ(read.priority, 128);
    EXPECT_EQ(read.state.cullMode, CullMode::Back);
    EXPECT_TRUE(read.state.depthTest && read.state.depthWrite);
    EXPECT_EQ(read.state.depthFunc, CompareOp::Less);
    EXPECT_FALSE(read.state.stencilFront.test || read.state.stencilBack.test);
    EXPECT_EQ(read.state.stencilFront.func, CompareOp::Always);
    EXPECT_EQ(read.state.stencilFront.readMask, 0xffffu);
    EXPECT_EQ(read.state.stencilFront.ref, 1u);
    EXPECT_TRUE(read.state.blendTargets.empty());
}

TEST_F(CocosHeader, PriorityExpressions) {
    const std::pair<const char*, int> cases[] = {
        {"7", 7},        {"max", 255},           {"min + 11", 11}, {"default", 128}, {"default - 1", 127},
        {"max-10", 245}, {"(max + 1) / 2", 128}, {"min+2*3", 6},   {"300", 255},     {"min - 4", 0}};
    for (const auto& [text, value] : cases)
        EXPECT_EQ(pass("      priority: " + std::string(text) + "\n").priority, value) << text;
    read("  techniques:\n  - passes:\n    - vert: vs\n      frag: fs\n      priority: most\n");
    EXPECT_THAT(firstError(), HasSubstr("'priority' must be"));
    read("  techniques:\n  - passes:\n    - vert: vs\n      frag: fs\n      priority: max / 0\n");
    EXPECT_THAT(firstError(), HasSubstr("'priority' must be"));
}

TEST_F(CocosHeader, EnumsInAnyCaseOrAsNumbers) {
    const RenderState state =
        pass(
            "      rasterizerState: { cullMode: Front, polygonMode: FILL, lineWidth: 2 }\n"
            "      depthStencilState: { depthFunc: LESS_equal, depthWrite: 0 }\n"
            "      blendState:\n        targets:\n        - blend: true\n          blendSrc: SRC_Alpha\n"
            "          blendDst: 4\n          blendEq: rev_sub\n          blendColorMask: 0x7\n"
            "        - blendColorMask: none\n        - blendColorMask: RGB\n")
            .state;
    EXPECT_EQ(state.cullMode, CullMode::Front);
    EXPECT_EQ(state.depthFunc, CompareOp::LessEqual);
    EXPECT_FALSE(state.depthWrite);
    ASSERT_EQ(state.blendTargets.size(), 3u);
    EXPECT_EQ(state.blendTargets[0].src, BlendFactor::SrcAlpha);
    EXPECT_EQ(state.blendTargets[0].dst, BlendFactor::OneMinusSrcAlpha);  // Number 4 of Cocos' factors.
    EXPECT_EQ(state.blendTargets[0].op, BlendOp::RevSub);
    EXPECT_EQ(state.blendTargets[0].colorMask, 7);
    EXPECT_EQ(state.blendTargets[1].colorMask, 0);
    // fill, point, line: not the order of our enum.
    EXPECT_EQ(pass("      rasterizerState: { polygonMode: 1 }\n").state.polygonMode, PolygonMode::Point);
    EXPECT_EQ(state.blendTargets[2].colorMask, 7);
    EXPECT_EQ(pass("      rasterizerState: { cullMode: 0 }\n").state.cullMode, CullMode::None);
    read("  techniques:\n  - passes:\n    - vert: vs\n      frag: fs\n      rasterizerState: { cullMode: sideways }\n");
    EXPECT_EQ(firstError(), "'sideways' is no value for 'cullMode'");
}

TEST_F(CocosHeader, UnknownKeysOfStatesAreNamed) {
    pass(
        "      rasterizerState: { cullmode: none }\n      depthStencilState: { depthTest: true, depthwrite: false }\n"
        "      blendState: { target: [], targets: [ { blend: true, blendSource: one } ] }\n"
        "      properties: { a: { value: 1, unheardOf: 2, editor: { elevated: true } } }\n");
    std::vector<std::string> notes;
    for (const Problem& problem : problems.all())
        if (problem.severity == Severity::Note) notes.push_back(problem.message);
    EXPECT_THAT(notes, ElementsAre("key 'cullmode' in 'rasterizerState' is not read",
                                   "key 'depthwrite' in 'depthStencilState' is not read",
                                   "key 'blendSource' in a blend target is not read",
                                   "key 'target' in 'blendState' is not read"));
    EXPECT_EQ(problems.all().front().where.line, 6);
}

TEST_F(CocosHeader, ColourMasksAreWordsLettersAndNumbers) {
    const auto maskOf = [&](const std::string& word) {
        const auto targets =
            pass("      blendState: { targets: [ { blendColorMask: " + word + " } ] }\n").state.blendTargets;
        return targets.empty() ? -1 : int(targets[0].colorMask);
    };
    const std::pair<const char*, int> masks[] = {{"none", 0}, {"ALL", 15}, {"r", 1},    {"G", 2},      {"b", 4},
                                                 {"a", 8},    {"rg", 3},   {"gba", 14}, {"RGB", 7},    {"rgba", 15},
                                                 {"9", 9},    {"0xf", 15}, {"r|g", 3},  {"'R | A'", 9}};
    for (const auto& [word, mask] : masks) EXPECT_EQ(maskOf(word), mask) << word;
    EXPECT_EQ(firstError(), "");
}

TEST_F(CocosHeader, StencilShorthandsSetBothSides) {
    const RenderState state =
        pass(
            "      depthStencilState:\n        stencilTest: true\n        stencilFunc: not_equal\n        stencilRef: "
            "0x80\n"
            "        stencilReadMask: 0xff\n        stencilWriteMask: 15\n        stencilPassOp: Replace\n"
            "        stencilFailOp: incr_wrap\n        stencilZFailOp: decr\n        stencilRefBack: 3\n"
            "        stencilFuncFront: equal\n")
            .state;
    // What is written for a side beside them counts for nothing.
    const StencilFace both{
        true, CompareOp::NotEqual, 0xff, 15, 0x80, StencilOp::IncrWrap, StencilOp::Decr, StencilOp::Replace};
    EXPECT_EQ(state.stencilFront, both);
    EXPECT_EQ(state.stencilBack, both);
    const RenderState sides =
        pass("      depthStencilState: { stencilTestFront: true, stencilRefBack: 3, stencilPassOp: zero }\n").state;
    EXPECT_TRUE(sides.stencilFront.test);
    EXPECT_FALSE(sides.stencilBack.test);
    EXPECT_EQ(sides.stencilFront.ref, 1u);
    EXPECT_EQ(sides.stencilBack.ref, 3u);
    EXPECT_EQ(sides.stencilFront.passOp, StencilOp::Zero);
    EXPECT_EQ(sides.stencilBack.passOp, StencilOp::Zero);
}

TEST_F(CocosHeader, PropertiesOfEveryKind) {
    const EffectPass read = pass(
        "      properties:\n        scale: { value: 0.5, target: params.x, range: [0, 1], step: 0.1 }\n"
        "        size: { value: [1, 2], target: params.zw }\n        map: { value: normal, sampler: { minFilter: "
        "point, addressU: clamp } }\n"
        "        tint: { value: [1, 1, 1, 1], linear: true, editor: { type: color, parent: USE_TINT, weird: 1 } }\n"
        "        on: { value: true }\n        empty:\n        one: { value: [0.25] }\n");
    ASSERT_EQ(read.properties.size(), 7u);
    EXPECT_EQ(read.properties[0].target, "params.x");
    EXPECT_EQ(read.properties[1].target, "params.zw");
    EXPECT_EQ(read.properties[2].value.string(), "normal");
    EXPECT_EQ(read.properties[2].sampler.find("minFilter")->string(), "point");
    EXPECT_TRUE(read.properties[3].linear);
    EXPECT_EQ(read.properties[4].value.integer(), 1);
    EXPECT_TRUE(read.properties[5].value.isNull());
    EXPECT_EQ(read.properties[6].value.items()[0].number(), 0.25);
}

TEST_F(CocosHeader, PropertyIndexInheritsWhatIsNotThere) {
    const EffectAsset asset = read(
        "  techniques:\n  - passes:\n    - vert: vs\n      frag: fs\n      properties: { a: { value: 1 } }\n"
        "    - vert: vs\n      frag: fs\n      propertyIndex: 0\n"
        "    - vert: vs\n      frag: fs\n      propertyIndex: 0\n      properties: { b: { value: 2 } }\n");
    ASSERT_FALSE(problems.hasErrors());
    const auto& passes = asset.techniques[0].passes;
    ASSERT_EQ(passes[1].properties.size(), 1u);
    EXPECT_EQ(passes[1].properties[0].name, "a");
    EXPECT_EQ(passes[1].propertyIndex, 0);
    ASSERT_EQ(passes[2].properties.size(), 1u);
    EXPECT_EQ(passes[2].properties[0].name, "b");
}

TEST_F(CocosHeader, BlocksEndAtTheFirstClosingSign) {
    const std::string header = "  techniques:\n  - passes:\n    - { vert: vs, frag: f-s }\n";
    EffectAsset asset =
        read(header, "/* CCProgram no %{ }% */\nCCProgram vs %{ float a; // } %\n}%\nCCProgram f-s %{}%\n");
    EXPECT_EQ(firstError(), "");
    EXPECT_EQ(asset.programs.size(), 2u);
    EXPECT_THAT(asset.programs.at("vs").text, HasSubstr("} %"));
    asset = read(header, "stray words\nCCProgram vs %{ a }%\nCCProgram vs %{ b }%\n");
    EXPECT_EQ(firstError(), "");
    EXPECT_EQ(asset.programs.at("vs").text, " b ");
    read(header, "CCProgram vs %{ float a;\nCCProgram fs %{ }%\n");
    EXPECT_EQ(firstError(), "the block 'CCProgram vs' is not closed");
    read(header, "CCProgram vs %{ float a;\n");
    EXPECT_EQ(firstError(), "the block 'CCProgram vs' is not closed");
    bench.folder.write("p/assets/effects/t.effect", "CCProgram vs %{ }%\n");
    problems = Problems();
    bench.parse(problems);
    EXPECT_EQ(firstError(), "the file has no CCEffect block");
}

TEST_F(CocosHeader, ValuesThatCannotBeMeantAreWarnings) {
    pass(
        "      switch: 5\n      properties:\n        a: { value: 1, target: [x] }\n        b: { value: [1, 2, 3, 4, 5] "
        "}\n"
        "        c: { value: [1, 0, 0, 0, 1, 0, 0, 0, 1] }\n");
    std::vector<std::string> warnings;
    for (const Problem& problem : problems.all())
        if (problem.severity == Severity::Warning) warnings.push_back(problem.message);
    EXPECT_THAT(warnings, ElementsAre("'switch' of a pass is a number: it is not read",
                                      "'target' of property 'a' is a list: it is not read",
                                      "the value of property 'b' has 5 numbers"));
}

TEST_F(CocosHeader, AWrongPropertyIndexIsShownWhereItIsWritten) {
    read("  techniques:\n  - passes:\n    - vert: vs\n      frag: fs\n      propertyIndex: 1\n");
    ASSERT_TRUE(problems.hasErrors());
    EXPECT_EQ(problems.all()[0].where.line, 6);
}

TEST_F(CocosHeader, HostileYamlEnds) {
    std::string bomb = "  a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
    for (int i = 1; i < 12; ++i) {
        bomb += "  a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
        for (int k = 0; k < 10; ++k) bomb += (k == 0 ? "*a" : ", *a") + std::to_string(i - 1);
        bomb += "]\n";
    }
    read(bomb);
    EXPECT_THAT(firstError(), HasSubstr("aliases"));
    read("  techniques: &t\n  - passes: *t\n");
    EXPECT_THAT(firstError(), HasSubstr("alias"));
    read("  techniques: " + std::string(5000, '[') + "\n");
    EXPECT_NE(firstError(), "");
    read("  techniques:\n  - passes:\n    - vert: [1\n");
    EXPECT_NE(firstError(), "");
    read("  techniques: 3\n");
    EXPECT_NE(firstError(), "");
    read("  techniques:\n  - passes:\n    -\n");
    EXPECT_NE(firstError(), "");
}

TEST_F(CocosHeader, NamesArePathsBelowEffectsOrAssets) {
    const std::string text = "CCEffect %{\n  techniques:\n  - passes:\n    - { vert: vs, frag: fs }\n}%\n";
    for (const char* path : {"e/editor/assets/effects/pipeline/deferred-lighting.effect",
                             "e/editor/assets/effects/builtin-standard.effect", "p/assets/pipeline/ssao-effect.effect",
                             "p/assets/mine/effects/deep/glow.effect", "p/assets/effects/builtin-standard.effect",
                             "p/assets/a/same.effect", "p/assets/b/same.effect", "out/side.effect"})
        bench.folder.write(path, text);
    const CocosEffects effects(bench.roots());
    const auto at = [&](const char* path) { return std::optional(bench.folder.path() / path); };
    EXPECT_EQ(effects.find("pipeline/deferred-lighting"),
              at("e/editor/assets/effects/pipeline/deferred-lighting.effect"));
    EXPECT_EQ(effects.find("pipeline/ssao-effect"), at("p/assets/pipeline/ssao-effect.effect"));
    EXPECT_EQ(effects.find("deep/glow"), at("p/assets/mine/effects/deep/glow.effect"));
    EXPECT_EQ(effects.find("builtin-standard"), at("p/assets/effects/builtin-standard.effect"));  // Project first.
    EXPECT_EQ(effects.find("deferred-lighting"), std::nullopt);
    EXPECT_EQ(effects.findShort("deferred-lighting"), at("e/editor/assets/effects/pipeline/deferred-lighting.effect"));
    EXPECT_EQ(effects.findShort("same"), std::nullopt);  // Two files have it.
    const std::string inside = (bench.folder.path() / "p/assets/a/same.effect").string();
    EXPECT_EQ(effects.find(inside), std::optional<std::filesystem::path>(inside));
    EXPECT_EQ(effects.find((bench.folder.path() / "out/side.effect").string()), std::nullopt);
    EXPECT_THAT(effects.names(), ElementsAre("a/same", "b/same", "builtin-standard", "deep/glow",
                                             "pipeline/deferred-lighting", "pipeline/ssao-effect"));
}

}  // namespace
}  // namespace crevice::cocos
