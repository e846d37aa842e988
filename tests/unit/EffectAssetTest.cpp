// .effect files: blocks, header keys, properties, states, and what is said about mistakes.
#include <gtest/gtest.h>

#include "effect/EffectAsset.h"

namespace crevice {
namespace {

EffectAsset parse(const std::string& text, Problems& problems, EffectReading reading = EffectReading::Strict) {
    return parseEffect(text, "e", "e.effect", problems, reading);
}

EffectAsset parseClean(const std::string& text) {
    Problems problems;
    EffectAsset effect = parse(text, problems);
    for (const Problem& problem : problems.all()) ADD_FAILURE() << formatProblem(problem);
    return effect;
}

Problem firstProblem(const std::string& text) {
    Problems problems;
    parse(text, problems);
    return problems.all().empty() ? Problem{} : problems.all().front();
}

/// An effect with one pass; `lines` are indented by six spaces.
std::string withPass(const std::string& lines) {
    return "CCEffect %{\n  techniques:\n  - passes:\n    - vert: vs\n      frag: fs\n" + lines + "}%\n";
}

TEST(EffectAsset, ReadsBlocksAndTheirLines) {
    const EffectAsset effect = parseClean(
        "// a comment with CCEffect %{\n/* and\n another */\nCCEffect %{\n  techniques:\n  - name: main\n    passes:\n"
        "    - vert: vs:vert\n      frag: fs\n      phase: gbuffer\n}%\n\nCCProgram vs %{\n  one\n}%\nCCProgram my-fs "
        "%{ two }%");
    ASSERT_EQ(effect.techniques.size(), 1u);
    EXPECT_EQ(effect.techniques[0].name, "main");
    ASSERT_EQ(effect.techniques[0].passes.size(), 1u);
    const EffectPass& pass = effect.techniques[0].passes[0];
    EXPECT_EQ(pass.vertex, "vs:vert");
    EXPECT_EQ(pass.fragment, "fs");
    EXPECT_EQ(pass.phase, "gbuffer");
    EXPECT_EQ(pass.vertexWhere.line, 8);
    EXPECT_EQ(effect.where.line, 4);
    ASSERT_TRUE(effect.programs.contains("vs"));
    EXPECT_EQ(effect.programs.at("vs").firstLine, 13);
    EXPECT_EQ(effect.programs.at("vs").text, "\n  one\n");
    EXPECT_EQ(effect.programs.at("my-fs").text, " two ");
}

TEST(EffectAsset, ReadsProperties) {
    const EffectAsset effect =
        parseClean(withPass("      properties:\n        strength: { value: 0.5, target: params.x, editor: { range: [0, "
                            "1], tooltip: How much } }\n"
                            "        color: { value: [1, 0.5, 0, 1], linear: true }\n        map: { value: grey }\n    "
                            "    radius: { value: auto }\n"));
    const auto& properties = effect.techniques[0].passes[0].properties;
    ASSERT_EQ(properties.size(), 4u);
    EXPECT_EQ(properties[0].name, "strength");
    EXPECT_EQ(properties[0].target, "params.x");
    EXPECT_DOUBLE_EQ(properties[0].value.number(), 0.5);
    EXPECT_DOUBLE_EQ(properties[0].min, 0);
    EXPECT_DOUBLE_EQ(properties[0].max, 1);
    EXPECT_EQ(properties[0].help, "How much");
    EXPECT_EQ(properties[0].where.line, 7);
    EXPECT_TRUE(properties[1].linear);
    EXPECT_EQ(properties[1].value.items().size(), 4u);
    EXPECT_EQ(properties[2].value.string(), "grey");
    EXPECT_EQ(properties[3].value.string(), "auto");
}

TEST(EffectAsset, PropertyIndexInheritsProperties) {
    const EffectAsset effect = parseClean(
        "CCEffect %{\n  techniques:\n  - passes:\n    - { vert: a, frag: b, properties: { x: { value: 1 } } }\n"
        "    - { vert: a, frag: c, propertyIndex: 0 }\n}%");
    ASSERT_EQ(effect.techniques[0].passes[1].properties.size(), 1u);
    EXPECT_EQ(effect.techniques[0].passes[1].properties[0].name, "x");
}

TEST(EffectAsset, StateDefaultsAreCocos) {
    const RenderState state = parseClean(withPass("")).techniques[0].passes[0].state;
    EXPECT_EQ(state, RenderState{});
    EXPECT_EQ(state.cullMode, CullMode::Back);
    EXPECT_TRUE(state.depthTest);
    EXPECT_TRUE(state.depthWrite);
    EXPECT_EQ(state.depthFunc, CompareOp::Less);
}

TEST(EffectAsset, ReadsStatesInAnyLetterCase) {
    const RenderState state =
        parseClean(
            withPass("      primitive: LINE_LIST\n      rasterizerState: { cullMode: None, polygonMode: line, "
                     "isFrontFaceCCW: false, "
                     "depthBiasEnabled: true, depthBias: 2, depthBiasSlop: 1.5 }\n      depthStencilState: { "
                     "depthTest: false, depthWrite: "
                     "false, depthFunc: greater_equal, stencilTest: false, stencilRef: 1 }\n      blendState:\n        "
                     "targets:\n"
                     "        - { blend: true, blendSrc: src_alpha, blendDst: ONE_MINUS_SRC_ALPHA, blendEq: rev_sub, "
                     "blendSrcAlpha: zero, "
                     "blendDstAlpha: one, blendAlphaEq: max, blendColorMask: 7 }\n        - { blendColorMask: a }\n"))
            .techniques[0]
            .passes[0]
            .state;
    EXPECT_EQ(state.topology, Topology::LineList);
    EXPECT_EQ(state.cullMode, CullMode::None);
    EXPECT_EQ(state.polygonMode, PolygonMode::Line);
    EXPECT_FALSE(state.frontFaceCcw);
    EXPECT_EQ(state.depthBias, 2.0f);
    EXPECT_EQ(state.depthBiasSlope, 1.5f);
    EXPECT_FALSE(state.depthTest);
    EXPECT_FALSE(state.depthWrite);
    EXPECT_EQ(state.depthFunc, CompareOp::GreaterEqual);
    ASSERT_EQ(state.blendTargets.size(), 2u);
    EXPECT_EQ(state.blendTargets[0],
              (BlendTarget{true, BlendFactor::SrcAlpha, BlendFactor::OneMinusSrcAlpha, BlendOp::RevSub,
                           BlendFactor::Zero, BlendFactor::One, BlendOp::Max, 7}));
    EXPECT_EQ(state.blendTargets[1].colorMask, 8);
    EXPECT_FALSE(state.blendTargets[1].blend);
}

TEST(EffectAsset, PriorityExpressions) {
    const auto priority = [](const std::string& text) {
        return parseClean(withPass("      priority: " + text + "\n")).techniques[0].passes[0].priority;
    };
    EXPECT_EQ(priority("7"), 7);
    EXPECT_EQ(priority("max"), 255);
    EXPECT_EQ(priority("max - 10"), 245);
    EXPECT_EQ(priority("min + 11"), 11);
    EXPECT_EQ(priority("default"), 128);
    for (const char* bad : {"max + 1", "mad", "max 10", "min + x", "300", "[1]"})
        EXPECT_TRUE(firstProblem(withPass(std::string("      priority: ") + bad + "\n"))
                        .message.starts_with("'priority' must be"))
            << bad;
}

TEST(EffectAsset, EmbeddedMacrosBecomeText) {
    const auto macros = parseClean(withPass("      embeddedMacros: { A: true, B: false, C: 3, D: word }\n"))
                            .techniques[0]
                            .passes[0]
                            .embeddedMacros;
    EXPECT_EQ(macros, (std::map<std::string, std::string>{{"A", "1"}, {"B", "0"}, {"C", "3"}, {"D", "word"}}));
}

struct Mistake {
    const char* text;
    int line;
    const char* message;
    const char* help;
};

class EffectMistake : public testing::TestWithParam<Mistake> {};

TEST_P(EffectMistake, IsReportedAtItsPlace) {
    const Problem problem = firstProblem(GetParam().text);
    EXPECT_EQ(problem.message, GetParam().message);
    EXPECT_EQ(problem.where.file, "e.effect");
    EXPECT_EQ(problem.where.line, GetParam().line);
    EXPECT_GT(problem.where.column, 0);
    EXPECT_NE(problem.help.find(GetParam().help), std::string::npos) << problem.help;
}

INSTANTIATE_TEST_SUITE_P(
    Blocks, EffectMistake,
    testing::Values(Mistake{"CCProgram a %{ }%", 1, "the file has no CCEffect block", "CCEffect %{"},
                    Mistake{"\nCCEffect %{\n techniques:\n", 2, "the block 'CCEffect' is not closed", "}%"},
                    Mistake{"CCProgram a %{\nvoid main() {}\nCCProgram b %{ }%", 1,
                            "the block 'CCProgram a' is not closed", "}%"},
                    Mistake{"CCEffect { }", 1, "'CCEffect' is not followed by '%{'", ""},
                    Mistake{"CCEffect %{\n techniques: [ { passes: [ { vert: a, frag: b } ] } ]\n}%\nCCEffect %{ }%", 4,
                            "a second CCEffect block", "technique"},
                    Mistake{"CCEffect %{\n techniques: [ { passes: [ { vert: a, frag: b } ] } ]\n}%\nCCProgram a %{ "
                            "}%\nCCProgram a %{ }%",
                            5, "two programs are named 'a'", "rename"},
                    Mistake{"uniform x;\n", 1, "text outside of the blocks", "CCProgram NAME"},
                    Mistake{"CCProgram %{ }%", 1, "a CCProgram has no name", ""},
                    Mistake{"CCEffect %{\n}%", 1, "the CCEffect block has no keys", "techniques"},
                    Mistake{"CCEffect %{\n  temporaries: 1\n}%", 1, "the effect has no 'techniques'", "passes"},
                    Mistake{"CCEffect %{\n  techniques:\n  - name: x\n}%", 3, "a technique has no 'passes'", "vert"},
                    Mistake{"CCEffect %{\n  technique: 1\n}%", 2, "unknown key 'technique' in the effect",
                            "did you mean 'techniques'"}));

INSTANTIATE_TEST_SUITE_P(
    Passes, EffectMistake,
    testing::Values(
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - { phase: x }\n}%", 4, "a pass names no program",
                "compute"},
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - { vert: x }\n}%", 4, "a pass has 'vert' without 'frag'",
                "fragment"},
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - { frag: x }\n}%", 4, "a pass has 'frag' without 'vert'",
                "fullscreen-vs"},
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - { vert: x, frag: y, compute: z }\n}%", 4,
                "a pass has 'compute' beside 'vert' or 'frag'", "own pass"},
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - vert: x\n      frag: y\n      propertys: {}\n}%", 6,
                "unknown key 'propertys' in a pass", "did you mean 'properties'"},
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - vert: x\n      frag: 3\n}%", 5,
                "'frag' of a pass must be a string, not a number", ""},
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - { vert: x, frag: y, propertyIndex: 4 }\n}%", 4,
                "'propertyIndex' is 4, but the technique has 1 passes", "count from 0"},
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - vert: x\n      frag: y\n      depthStencilState:\n     "
                "   depthFunc: lest\n}%",
                7, "'lest' is no value for 'depthFunc'", "did you mean 'less'"},
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - vert: x\n      frag: y\n      rasterizerState: { "
                "cullmode: back }\n}%",
                6, "unknown key 'cullmode' in 'rasterizerState'", "did you mean 'cullMode'"},
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - vert: x\n      frag: y\n      depthStencilState: { "
                "stencilTestFront: true }\n}%",
                6, "'stencilTestFront' is not supported by Crevice", "false"},
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - vert: x\n      frag: y\n      rasterizerState: { "
                "depthBias: 2 }\n}%",
                6, "a depth bias without 'depthBiasEnabled: true' does nothing", "depthBiasEnabled"},
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - vert: x\n      frag: y\n      properties:\n        a: "
                "{ value: [1] }\n}%",
                7, "the value of property 'a' must be a number, 2 to 4 numbers or a word", ""},
        Mistake{"CCEffect %{\n  techniques:\n  - passes:\n    - vert: x\n      frag: y\n      properties:\n        a: "
                "{ value: 1, editor: { range: [2, 1] } }\n}%",
                7, "'range' must be two ascending numbers", "[0, 1]"}));

TEST(EffectAsset, BadYamlHasAPlaceInTheFile) {
    const Problem problem = firstProblem("\n\nCCEffect %{\n  techniques: [\n}%\n");
    EXPECT_EQ(problem.where.file, "e.effect");
    EXPECT_GE(problem.where.line, 3);
    EXPECT_LE(problem.where.line, 5);
    EXPECT_FALSE(problem.message.empty());
}

TEST(EffectAsset, TolerantReadingSkipsWhatStrictReadingRefuses) {
    const std::string text =
        withPass("      depthTest: true\n      depthStencilState: { stencilTestFront: true, depthFunc: always }\n");
    Problems strict, tolerant;
    parse(text, strict);
    const EffectAsset effect = parse(text, tolerant, EffectReading::Tolerant);
    EXPECT_EQ(strict.all().size(), 2u);
    ASSERT_EQ(tolerant.all().size(), 1u);
    EXPECT_EQ(tolerant.all()[0].severity, Severity::Note);
    EXPECT_EQ(tolerant.all()[0].message, "key 'depthTest' in a pass is not read");
    EXPECT_EQ(effect.techniques[0].passes[0].state.depthFunc, CompareOp::Always);
}

TEST(EffectAsset, SeveralMistakesAreReportedTogether) {
    Problems problems;
    parse(withPass("      one: 1\n      two: 2\n"), problems);
    ASSERT_EQ(problems.all().size(), 2u);
    EXPECT_EQ(problems.all()[0].where.line, 6);
    EXPECT_EQ(problems.all()[1].where.line, 7);
}

TEST(EffectAsset, EveryCutOfAFileIsReadWithoutHarm) {
    const std::string whole = withPass("      properties: { a: { value: [1, 2], editor: { range: [0, 3] } } }\n") +
                              "CCProgram vs %{ void main() {} }%\n";
    int good = 0;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        Problems problems;
        parse(whole.substr(0, length), problems);
        if (!problems.hasErrors()) ++good;
    }
    EXPECT_LE(good, 3);  // Only cuts in the white space between the blocks and at the end.
}

}  // namespace
}  // namespace crevice
