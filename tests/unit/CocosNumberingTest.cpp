// Locations and bindings by Cocos' rules, each expectation worked out by hand.
#include <gtest/gtest.h>

#include "CocosTestTools.h"
#include "cocos/interface/Numbering.h"

namespace crevice::cocos {
namespace {

using Locations = std::map<std::string, int, std::less<>>;

Numbers numbersOf(const std::vector<StageText>& stages, Problems& problems) {
    std::vector<StageInterface> interfaces;
    for (const StageText& stage : stages) interfaces.push_back(readInterface(stage, problems));
    return numberInterfaces(interfaces, problems);
}

Numbers numbersOf(const std::string& vertex, const std::string& fragment = "") {
    Problems problems;
    const Numbers numbers = numbersOf({stageText(kVertexBit, vertex), stageText(kFragmentBit, fragment)}, problems);
    EXPECT_TRUE(problems.all().empty()) << formatProblem(problems.all().front());
    return numbers;
}

std::vector<std::string> written(std::vector<StageText> stages, const BindingMap& bindings = {},
                                 const NumberingOptions& options = {}) {
    Problems problems;
    numberStages(stages, bindings, options, problems);
    EXPECT_FALSE(problems.hasErrors());
    std::vector<std::string> texts;
    for (const StageText& stage : stages) texts.push_back(stage.flat.text);
    return texts;
}

TEST(CocosNumbering, AttributesInTextOrderWhateverTheConditions) {
    EXPECT_EQ(numbersOf("in vec3 a_position;\n#if USE_A\nin vec3 a_normal;\n#else\nin vec2 a_texCoord;\n#endif\n"
                        "in highp vec4 a_color;\n")
                  .attributes,
              (Locations{{"a_position", 0}, {"a_normal", 1}, {"a_texCoord", 2}, {"a_color", 3}}));
}

TEST(CocosNumbering, ExplicitAttributesAreReservedFirst) {
    EXPECT_EQ(numbersOf("in vec3 a;\nin vec3 b;\nlayout(location = 1) in vec4 j;\nlayout(location=2) in vec4 w;\nin "
                        "float id;\n")
                  .attributes,
              (Locations{{"a", 0}, {"b", 3}, {"j", 1}, {"w", 2}, {"id", 4}}));
}

TEST(CocosNumbering, ADeclarationOfADeadTargetTakesItsNumber) {
    EXPECT_EQ(numbersOf("in vec3 a;\n#if __VERSION__ < 450\nin float id;\n#endif\nin vec4 c;\n").attributes,
              (Locations{{"a", 0}, {"id", 1}, {"c", 2}}));
}

TEST(CocosNumbering, ARepeatedNameTakesANumberEachTimeAndKeepsTheLast) {
    EXPECT_EQ(numbersOf("in vec4 c;\n#if M == 1\nin vec3 c1;\n#endif\n#if M == 4\nin vec3 n;\nin vec4 c1;\n#endif\nin "
                        "vec2 t;\n")
                  .attributes,
              (Locations{{"c", 0}, {"c1", 3}, {"n", 2}, {"t", 4}}));
}

TEST(CocosNumbering, MatricesAndArraysTakeSeveral) {
    EXPECT_EQ(numbersOf("#define N 3\nin mat4 m;\nin vec4 x[N];\nin vec2 y;\n").attributes,
              (Locations{{"m", 0}, {"x", 4}, {"y", 7}}));
    EXPECT_EQ(numbersOf("const int N = 2 * (3 - 1);\nout vec2 o[N];\nout mat3 m;\nout vec2 y;\n").varyings,
              (Locations{{"o", 0}, {"m", 4}, {"y", 7}}));
}

TEST(CocosNumbering, VaryingsMeetByNameAndStrangersFollow) {
    const Numbers numbers = numbersOf("out vec3 v_a;\n#if X\nout vec2 v_b;\n#endif\nout vec2 v_c[2];\n",
                                      "in vec2 v_c[2];\nin vec3 v_new;\nin vec3 v_a;\nin float v_newer;\n");
    EXPECT_EQ(numbers.varyings, (Locations{{"v_a", 0}, {"v_b", 1}, {"v_c", 2}, {"v_new", 4}, {"v_newer", 5}}));
    EXPECT_TRUE(numbers.attributes.empty());
}

TEST(CocosNumbering, MacrosAmongTheQualifiers) {
    EXPECT_EQ(numbersOf("#define HALF mediump\nout HALF mat3 m;\nout flat HALF ivec2 a[2], b;\nout vec2 c;\n").varyings,
              (Locations{{"m", 0}, {"a", 3}, {"b", 5}, {"c", 6}}));
}

TEST(CocosNumbering, FragmentOutputs) {
    EXPECT_EQ(numbersOf("", "layout(location = 1) out vec4 b;\nout vec4 a;\nout vec4 c;\n").outputs,
              (Locations{{"a", 0}, {"b", 1}, {"c", 2}}));
}

TEST(CocosNumbering, MaterialBindingsByKindThenStageThenText) {
    const Numbers numbers =
        numbersOf("uniform sampler2D vs_map;\nuniform Constants { vec4 x; };\n",
                  "uniform subpassInput sub;\nlayout(rgba8) uniform image2D img;\nreadonly buffer Buf { vec4 y[]; };\n"
                  "uniform texture2D tex;\nuniform sampler smp;\nuniform samplerCube cube;\nuniform Frag { vec4 z; };\n"
                  "uniform Constants { vec4 x; };\nuniform sampler2D vs_map;\n");
    EXPECT_EQ(numbers.slots, (BindingMap{{"Constants", {1, 0}},
                                         {"Frag", {1, 1}},
                                         {"vs_map", {1, 2}},
                                         {"cube", {1, 3}},
                                         {"smp", {1, 4}},
                                         {"tex", {1, 5}},
                                         {"Buf", {1, 6}},
                                         {"img", {1, 7}},
                                         {"sub", {1, 8}}}));
}

TEST(CocosNumbering, ExplicitBindingsAreReserved) {
    EXPECT_EQ(numbersOf("",
                        "layout(binding = 0) uniform sampler2D a;\nlayout(set = 1, binding = 2) uniform sampler2D "
                        "b;\nuniform B { vec4 x; };\nuniform sampler2D c;\n")
                  .slots,
              (BindingMap{{"a", {1, 0}}, {"b", {1, 2}}, {"B", {1, 1}}, {"c", {1, 3}}}));
}

StageText withBuiltins() {
    StageText stage = stageText(kVertexBit,
                                "\nlayout(set = 0, binding = 4) uniform Global { vec4 g; };\n\nlayout(set = 2, binding "
                                "= 3) uniform highp sampler2D joints;\nuniform Own { vec4 o; };\n");
    stage.marks = {{PragmaMark::Kind::BuiltinGlobal, "", "", 1}, {PragmaMark::Kind::BuiltinLocal, "", "", 3}};
    return stage;
}

TEST(CocosNumbering, BuiltinsKeepTheirSets) {
    Problems problems;
    EXPECT_EQ(numbersOf(std::vector{withBuiltins()}, problems).slots,
              (BindingMap{{"Global", {0, 4}}, {"joints", {2, 3}}, {"Own", {1, 0}}}));
    EXPECT_TRUE(problems.all().empty());
}

TEST(CocosNumbering, APipelinesNamesWinWithANote) {
    std::vector<StageText> stages = {withBuiltins()};
    Problems problems;
    numberStages(stages, {{"Global", {0, 1}}, {"joints", {2, 3}}}, {}, problems);
    ASSERT_EQ(problems.all().size(), 1u);
    EXPECT_EQ(problems.all()[0].severity, Severity::Note);
    EXPECT_EQ(problems.all()[0].where.line, 2);
    EXPECT_NE(stages[0].flat.text.find("layout(set = 0, binding = 1) uniform Global"), std::string::npos);
    EXPECT_NE(stages[0].flat.text.find("layout(set = 2, binding = 3) uniform highp sampler2D joints"),
              std::string::npos);
    EXPECT_NE(stages[0].flat.text.find("layout(set = 1, binding = 0) uniform Own"), std::string::npos);
    EXPECT_NE(written({withBuiltins()}, {{"Global", {0, 1}}}, {.rebindByName = false})[0].find(
                  "layout(set = 0, binding = 4) uniform Global"),
              std::string::npos);
}

TEST(CocosNumbering, BuiltinsThatThePipelineHasNotFollowTheMaterial) {
    EXPECT_NE(written({withBuiltins()}, {{"Global", {0, 1}}})[0].find(
                  "layout(set = 1, binding = 1) uniform highp sampler2D joints"),
              std::string::npos);
}

TEST(CocosNumbering, TextsKeepTheirLines) {
    EXPECT_EQ(written({stageText(kVertexBit,
                                 "layout(std140,\n  binding = 3) uniform B {\n  vec4 a; };\nout mediump "
                                 "vec2 x,\n  y[2];\nvoid main() {}\n")})[0],
              "\n layout(set = 1, binding = 3, std140) uniform B {\n  vec4 a; };\n"
              "layout(location = 0) out mediump vec2 x; layout(location = 1) out mediump vec2 y[2]; \n\nvoid main() "
              "{}\n");
}

TEST(CocosNumbering, IntegersAreFlat) {
    const auto texts = written({stageText(kVertexBit, "in uvec4 j;\nout ivec2 a;\nflat out uint b;\nout vec2 c;\n"),
                                stageText(kFragmentBit, "in ivec2 a;\nout ivec4 color;\n")});
    EXPECT_EQ(texts[0],
              "layout(location = 0) in uvec4 j;\nlayout(location = 0) flat out ivec2 a;\nflat layout(location = 1) out "
              "uint b;\nlayout(location = 2) out vec2 c;\n");
    EXPECT_EQ(texts[1], "layout(location = 0) flat in ivec2 a;\nlayout(location = 0) out ivec4 color;\n");
}

TEST(CocosNumbering, FunctionsParametersAndUnbalancedBranchesAreNoDeclarations) {
    EXPECT_EQ(numbersOf("vec4 f(in vec3 p, out vec2 q) { { } }\n#if A\nvoid g(in int a) {\n#else\nvoid g() {\n#endif\n"
                        "  for (;;) { } }\nin vec2 real;\n")
                  .attributes,
              (Locations{{"real", 0}}));
}

TEST(CocosNumbering, SubpassInputsStandInTheirPragmasLine) {
    StageText stage = stageText(kFragmentBit, "precision highp float;\n\n\nuniform sampler2D a;\n");
    stage.marks = {{PragmaMark::Kind::SubpassColor, "albedoMap", "in", 2},
                   {PragmaMark::Kind::SubpassDepth, "depthMap", "in", 3}};
    EXPECT_EQ(written({stage})[0],
              "precision highp float;\nlayout(input_attachment_index = 0, set = 1, binding = 1) uniform subpassInput "
              "albedoMap;\nlayout(input_attachment_index = 1, set = 1, binding = 2) uniform subpassInput "
              "depthMap;\nlayout(set = 1, binding = 0) uniform sampler2D a;\n");
}

TEST(CocosNumbering, SubpassPragmasCountByKindAndName) {
    StageText stage = stageText(kFragmentBit, "precision highp float;\n\n\n\n\n\n\n");
    using Kind = PragmaMark::Kind;
    stage.marks = {{Kind::SubpassColor, "b", "in", 2},       {Kind::SubpassDepth, "stencil", "in", 3, 'i'},
                   {Kind::SubpassDepth, "depth", "in", 4},   {Kind::SubpassColor, "a", "in", 5, 'u'},
                   {Kind::SubpassColor, "second", "out", 6}, {Kind::SubpassColor, "both", "inout", 7}};
    EXPECT_EQ(written({stage})[0],
              "precision highp float;\n"
              "layout(input_attachment_index = 1, set = 1, binding = 0) uniform subpassInput b;\n"
              "layout(input_attachment_index = 2, set = 1, binding = 1) uniform isubpassInput stencil;\n"
              "layout(input_attachment_index = 2, set = 1, binding = 2) uniform subpassInput depth;\n"
              "layout(input_attachment_index = 0, set = 1, binding = 3) uniform usubpassInput a;\n"
              "layout(location = 1) out vec4 second;\nlayout(location = 0) out vec4 both;\n");
}

TEST(CocosNumbering, ImageFormatsFromPragmas) {
    StageText stage = stageText(kComputeBit, "layout(local_size_x = 8) in;\n\nuniform image2D img;\n");
    stage.marks = {{PragmaMark::Kind::Format, "", "RGBA16F", 2}};
    EXPECT_EQ(written({stage})[0],
              "layout(local_size_x = 8) in;\n\nlayout(set = 1, binding = 0, rgba16f) uniform image2D img;\n");
}

std::vector<Problem> problemsOf(const std::string& text) {
    Problems problems;
    readInterface(stageText(kFragmentBit, text), problems);
    return problems.all();
}

TEST(CocosNumbering, HolesAreWarnedOfAtTheirMember) {
    for (const auto& [block, member] : std::vector<std::pair<std::string, std::string>>{
             {"vec3 a;\nvec4 b;", "b"}, {"float a;\nvec4 b;", "b"}, {"vec4 a;\nfloat b[3];", "b"}, {"mat3 b;", "b"}}) {
        const auto found = problemsOf("uniform B {\n" + block + "\n};\n");
        ASSERT_EQ(found.size(), 1u) << block;
        EXPECT_EQ(found[0].severity, Severity::Warning);
        EXPECT_NE(found[0].message.find("'" + member + "'"), std::string::npos) << found[0].message;
    }
    for (const char* tight : {"vec4 a; float b;", "vec3 a; float b;", "int a; int b;", "mat4 a; vec4 b[7]; vec2 c;"})
        EXPECT_TRUE(problemsOf("uniform B { " + std::string(tight) + " };\n").empty()) << tight;
}

TEST(CocosNumbering, ArraysOfBlocksAndLooseUniformsAreErrors) {
    auto found = problemsOf("uniform B { vec4 a; } b[2];\n");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].severity, Severity::Error);
    found = problemsOf("\nuniform vec4 loose;\n");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].severity, Severity::Error);
    EXPECT_EQ(found[0].where.line, 2);
    EXPECT_TRUE(problemsOf("#if X\nuniform vec4 loose;\n#endif\n").empty());
}

TEST(CocosNumbering, HostileTextsEndInBoundedTime) {
    std::string many, clashes = "#define A B\n#define B A\nout vec4 x[A];\n", deep = "#define D0 1\n";
    for (int i = 0; i < 20000; ++i) many += "uniform sampler2D s" + std::to_string(i % 100) + ";\n";
    for (int i = 1; i < 200; ++i) {
        const std::string last = "D" + std::to_string(i - 1);
        deep += "#define D" + std::to_string(i) + " " + last + "+" + last + "\n";
    }
    EXPECT_EQ(numbersOf(many).slots.size(), 100u);
    EXPECT_EQ(numbersOf(clashes).varyings.at("x"), 0);
    EXPECT_EQ(numbersOf(deep + "out vec4 x[D199];\nout vec4 y;\n").varyings.at("x"), 0);
    for (const char* huge : {"in vec4 a[2000000000];\n", "in mat4 a[1000][1000];\n"}) {
        Problems problems;
        readInterface(stageText(kVertexBit, huge), problems);
        EXPECT_TRUE(problems.hasErrors()) << huge;
    }
    std::string inputs;
    for (int i = 0; i < 10000; ++i) inputs += "in vec4 a" + std::to_string(i) + ";\n";
    Problems problems;
    numbersOf(std::vector{stageText(kVertexBit, inputs)}, problems);
    EXPECT_EQ(problems.all().size(), 1u);
    for (const char* broken : {"layout(", "in", "in vec4 a[", "uniform X {", "uniform X { vec4",
                               "layout(set=)in vec2 "
                               "x;",
                               "};;}in vec2 y;", "in vec2 a,,b;", "#if\n#else\n#endif\n#endif\n", "= {", "out ;"}) {
        std::vector<StageText> stages = {stageText(kVertexBit, broken)};
        Problems found;
        EXPECT_NO_THROW(numberStages(stages, {}, {}, found)) << broken;
    }
}

TEST(CocosNumbering, OneLocationForSeveralNamesIsAnError) {
    Problems problems;
    numbersOf({stageText(kVertexBit, "layout(location = 3) in vec2 a_one, a_two;\n")}, problems);
    ASSERT_EQ(problems.all().size(), 1u);
    EXPECT_EQ(problems.all().front().message, "'a_two' has location 3 of 'a_one'");
    EXPECT_EQ(problems.all().front().where.column, 37);
}

}  // namespace
}  // namespace crevice::cocos
