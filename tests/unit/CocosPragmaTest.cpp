// Pragmas of both dialects, discovered macros, conditions of lines, the head of the final text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"
#include "cocos/text/Conditions.h"
#include "cocos/text/SourceText.h"

namespace crevice::cocos {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const StageMacro& macroOf(const StageText& text, const std::string& name) {
    for (const StageMacro& macro : text.macros)
        if (macro.info.name == name) return macro;
    throw std::runtime_error("no macro " + name);
}

std::vector<std::string> conditionsAt(const StageText& text, const std::string& part) {
    const auto at = text.flat.text.find(part);
    if (at == std::string::npos) return {"absent"};
    const auto line =
        std::count(text.flat.text.begin(), text.flat.text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    return text.conditions[text.conditionOf[static_cast<std::size_t>(line)]];
}

TEST(CocosPragma, MetadataOfBothDialects) {
    CocosBench bench;
    bench.fragment(
        "#pragma define-meta COUNT range([2, 8])\n#pragma define-meta UV options([v_uv, v_uv1])\n"
        "#pragma define-meta FLAG default(true) editor({ displayName: 'a (b)', visible: false })\n"
        "#pragma define-meta SIZE default(4)\n#pragma define-meta PICK options(['a', \"b\"]) default(b)\n"
        "#pragma define-meta PLAIN\n"
        "#pragma define OLD_RANGE range([0, 3])\n#pragma define OLD_OPTIONS options([r, g])\n"
        "#pragma define OLD_FLAG\n#pragma define OLD_DEFAULT default(1)\n#pragma define OLD_EDITOR editor( { a: 1 } )\n"
        "#pragma define VALUE 3\n#pragma define range_like ranged(1)\n");
    const StageText text = bench.fragmentText();
    EXPECT_THAT(macroNames(text), ElementsAre("COUNT", "UV", "FLAG", "SIZE", "PICK", "PLAIN", "OLD_RANGE",
                                              "OLD_OPTIONS", "OLD_FLAG", "OLD_DEFAULT", "OLD_EDITOR"));
    const DefineInfo& count = macroOf(text, "COUNT").info;
    EXPECT_EQ(count.type, DefineType::Number);
    EXPECT_EQ(count.range, (std::pair{2, 8}));
    EXPECT_EQ(count.defaultValue, "2");
    EXPECT_EQ(count.where.line, 11);
    const DefineInfo& uv = macroOf(text, "UV").info;
    EXPECT_EQ(uv.type, DefineType::String);
    EXPECT_THAT(uv.options, ElementsAre("v_uv", "v_uv1"));
    EXPECT_EQ(uv.defaultValue, "v_uv");
    EXPECT_EQ(macroOf(text, "FLAG").info.type, DefineType::Bool);
    EXPECT_EQ(macroOf(text, "FLAG").info.defaultValue, "1");
    EXPECT_EQ(macroOf(text, "SIZE").info.defaultValue, "4");
    EXPECT_EQ(macroOf(text, "PICK").info.defaultValue, "b");
    EXPECT_EQ(macroOf(text, "PLAIN").info.defaultValue, "0");
    EXPECT_EQ(macroOf(text, "OLD_RANGE").info.range, (std::pair{0, 3}));
    EXPECT_THAT(macroOf(text, "OLD_OPTIONS").info.options, ElementsAre("r", "g"));
    EXPECT_EQ(macroOf(text, "OLD_DEFAULT").info.defaultValue, "1");
    EXPECT_THAT(words(text.flat.text), ElementsAre("#define VALUE 3", "#define range_like ranged(1)"));
}

TEST(CocosPragma, MacrosAreFoundInOrderOfFirstOccurrence) {
    CocosBench bench;
    bench.effect("#if USE_B\n#endif\n#ifdef USE_C\n#endif\n#if defined(USE_D) && !USE_B\n#endif\nvoid main() {}\n",
                 "#pragma define-meta USE_F\n#define OWN 1\n#if OWN\n#endif\n#ifndef GUARD\n#define GUARD 0\n#endif\n"
                 "#if USE_E == 2 || (USE_F > OWN)\n#elif USE_B\n#endif\n#if GL_ES || __VERSION__ < 300\n#endif\n"
                 "#if CC_DEVICE_MAX_VERTEX_UNIFORM_VECTORS > 100\n#endif\n");
    Problems problems;
    const auto stages = bench.flatten(problems);
    problems.throwIfErrors();
    EXPECT_THAT(macroNames(stages[0]), ElementsAre("USE_B", "USE_C", "USE_D"));
    EXPECT_THAT(macroNames(stages[1]), ElementsAre("USE_F", "USE_E", "USE_B"));
    std::vector<std::string> merged;
    for (const StageMacro& macro : mergeMacros(stages)) merged.push_back(macro.info.name);
    EXPECT_THAT(merged, ElementsAre("USE_B", "USE_C", "USE_D", "USE_F", "USE_E"));
}

TEST(CocosPragma, WhatIsComparedIsANumberFromZeroToThree) {
    CocosBench bench;
    bench.fragment(
        "#pragma define FORMAT_RGBA8 1\n#if FORMAT == FORMAT_RGBA8\n#endif\n"
        "#if USE_A && (LEVEL > 2 || 1 <= STEPS)\n#elif !FLAG && OTHER != 2\n#endif\n"
        "#pragma define-meta BARE\n#if BARE == 1\n#endif\n#if LATE == 1\n#endif\n#pragma define-meta LATE\n"
        "#pragma define-meta TAGGED range([0, 8])\n#if TAGGED == 5\n#endif\n"
        "#pragma define-meta PICK options([a, b])\n#if PICK == 1\n#endif\n"
        "#if TWICE + 1 == 2\n#endif\n#if BOOL\n#elif defined(ONLY)\n#endif\n");
    const StageText text = bench.fragmentText();
    // The name in front of the comparison, whatever stands between; `!=` is none for Cocos' compiler.
    for (const char* name : {"FORMAT", "LEVEL", "BARE", "LATE", "TWICE"}) {
        const DefineInfo& info = macroOf(text, name).info;
        EXPECT_EQ(info.type, DefineType::Number) << name;
        EXPECT_EQ(info.range, (std::pair{0, 3})) << name;
        EXPECT_EQ(info.defaultValue, "0") << name;
    }
    EXPECT_EQ(macroOf(text, "TAGGED").info.range, (std::pair{0, 8}));
    EXPECT_EQ(macroOf(text, "PICK").info.type, DefineType::String);
    for (const char* name : {"USE_A", "FLAG", "STEPS", "OTHER", "BOOL", "ONLY"})
        EXPECT_EQ(macroOf(text, name).info.type, DefineType::Bool) << name;
}

TEST(CocosPragma, StagesKnowOfAMacroTogether) {
    CocosBench bench;
    bench.effect("#if MODE\n#endif\n#if COUNT\n#endif\nvoid main() { gl_Position = vec4(0.0); }\n",
                 "#if MODE == 2\n#endif\n#pragma define-meta COUNT range([2, 8])\n"
                 "layout(location = 0) out vec4 c; void main() { c = vec4(float(MODE), float(COUNT), 0.0, 1.0); }\n");
    Problems problems;
    const std::vector<StageMacro> joined = joinMacros(bench.flatten(problems));
    ASSERT_EQ(joined.size(), 2u);
    EXPECT_EQ(joined[0].info.type, DefineType::Number);
    EXPECT_EQ(joined[0].info.range, (std::pair{0, 3}));
    EXPECT_EQ(joined[1].info.range, (std::pair{2, 8}));
}

TEST(CocosPragma, TheLastStageThatSaysSomethingDescribesAMacro) {
    CocosBench bench;
    bench.effect(
        "#pragma define-meta PLAIN editor(elevated: true)\n#pragma define-meta BOTH range([0, 4])\n"
        "#pragma define-meta KEPT range([0, 5])\nvoid main() { gl_Position = vec4(PLAIN + BOTH + KEPT); }\n",
        "#pragma define-meta PLAIN range([1, 2])\n#pragma define-meta BOTH range([0, 7])\n#pragma define-meta KEPT\n"
        "#if KEPT == 1\n#endif\nlayout(location = 0) out vec4 c; void main() { c = vec4(PLAIN + BOTH); }\n");
    Problems problems;
    const std::vector<StageMacro> joined = joinMacros(bench.flatten(problems));
    ASSERT_EQ(joined.size(), 3u);
    EXPECT_EQ(joined[0].info.range, (std::pair{1, 2}));
    EXPECT_EQ(joined[1].info.range, (std::pair{0, 7}));
    EXPECT_EQ(joined[2].info.range, (std::pair{0, 5}));
    EXPECT_EQ(bench.compileError(), "");
}

TEST(CocosPragma, UsedUniformVectorsAreCounted) {
    CocosBench bench;
    // 4 + 1 + 1 registers in the vertex stage, 2 in the fragment stage; an array of a macro's size does not count.
    bench.effect(
        "#define UNITS (CC_DEVICE_MAX_VERTEX_UNIFORM_VECTORS - CC_EFFECT_USED_VERTEX_UNIFORM_VECTORS) / 5 * 5\n"
        "uniform A { mat4 m; vec4 v; };\n#if USE_B\nuniform B { float f; };\n#endif\n"
        "#pragma builtin(local)\nlayout(set = 2, binding = 0) uniform L { vec4 data[UNITS]; };\n"
        "void main() { gl_Position = m * v + data[1014]; }\n",
        "uniform C { vec4 c; vec2 d; };\nlayout(location = 0) out vec4 o;\n"
        "void main() { o = c * float(CC_EFFECT_USED_FRAGMENT_UNIFORM_VECTORS) ; }\n");
    EXPECT_EQ(bench.compileError(), "");
    CocosEffects effects(bench.roots());
    Problems problems;
    const EffectAsset asset = bench.parse(problems);
    const auto sources = effects.stages(asset, asset.techniques[0].passes[0], VariantRequest{}, {}, problems);
    ASSERT_EQ(sources.size(), 2u);
    for (const StageSource& source : sources) {
        EXPECT_THAT(source.head, HasSubstr("#define CC_EFFECT_USED_VERTEX_UNIFORM_VECTORS 6\n"));
        EXPECT_THAT(source.head, HasSubstr("#define CC_EFFECT_USED_FRAGMENT_UNIFORM_VECTORS 2\n"));
    }
}

TEST(CocosPragma, AliasesLeadToTheMacrosBehindThem) {
    CocosBench bench;
    bench.fragment(
        "#define SURFACE_UV HAS_UV\n#define LEVEL 2\n#pragma define KIND MODE\n#if SURFACE_UV\nfloat a;\n#endif\n"
        "#if KIND == LEVEL\nfloat b;\n#endif\n#define SELF SELF\n#if SELF\n#endif\n");
    const StageText text = bench.fragmentText();
    EXPECT_THAT(macroNames(text), ElementsAre("HAS_UV", "MODE"));
    EXPECT_THAT(conditionsAt(text, "float a;"), ElementsAre("HAS_UV"));
    EXPECT_THAT(conditionsAt(text, "float b;"), ElementsAre("MODE"));
}

TEST(CocosPragma, WhatIsOnlyAskedStaysUndefinedHoweverItIsWritten) {
    CocosBench bench;
    bench.fragment("#if defined A || !defined( B ) || defined(C) || (defined ( D ) && E)\n#endif\n");
    const StageText text = bench.fragmentText();
    for (const char* name : {"A", "B", "C", "D"}) EXPECT_FALSE(macroOf(text, name).info.tested) << name;
    EXPECT_TRUE(macroOf(text, "E").info.tested);
}

TEST(CocosPragma, ADefineWithABlankIsNotSeen) {
    CocosBench bench;
    bench.fragment(
        "layout(location = 0) out vec4 color;\n#if MODE == 1\n# define KIND 2\n#else\n#\tdefine KIND 3\n#endif\n"
        "#define OWN 1\n# define OWN 1\n#if KIND == 2 && OWN\nvoid main() { color = vec4(1.0); }\n#endif\n");
    const StageText text = bench.fragmentText();
    EXPECT_THAT(macroNames(text), ElementsAre("MODE", "KIND"));
    EXPECT_THAT(conditionsAt(text, "void main"), ElementsAre("KIND"));
    EXPECT_THAT(makeHead(text, mergeMacros({text}), {}), Not(HasSubstr("KIND")));  // The text gives it a value.
    bench.compile({{"MODE", "1"}});
}

TEST(CocosPragma, LinesKnowTheirConditions) {
    CocosBench bench;
    bench.fragment(
        "float none;\n#if USE_A\nfloat a;\n#if USE_B && !USE_C\nfloat ab;\n#endif\n#elif USE_D\nfloat d;\n#else\n"
        "float neither;\n#endif\n#if USE_A && !USE_B\n#else\nfloat not_both;\n#endif\n#ifndef USE_E\nfloat "
        "e;\n#endif\n#if __VERSION__ >= 300\nfloat version;\n#if USE_A\n"
        "float inVersion;\n#endif\n#endif\n#if USE_A || USE_B\nfloat either;\n#else\nfloat not_either;\n#endif\n"
        "#if MODE == 3\nfloat mode;\n#else\nfloat other_mode;\n#endif\nfloat after;\n");
    const StageText text = bench.fragmentText();
    EXPECT_THAT(conditionsAt(text, "float none;"), IsEmpty());
    EXPECT_THAT(conditionsAt(text, "float a;"), ElementsAre("USE_A"));
    EXPECT_THAT(conditionsAt(text, "float ab;"), ElementsAre("USE_A", "USE_B", "!USE_C"));
    EXPECT_THAT(conditionsAt(text, "float d;"), ElementsAre("!USE_A", "USE_D"));
    EXPECT_THAT(conditionsAt(text, "float neither;"), ElementsAre("!USE_A", "!USE_D"));
    EXPECT_THAT(conditionsAt(text, "float not_both;"), ElementsAre("!USE_A", "USE_B"));
    EXPECT_THAT(conditionsAt(text, "float e;"), ElementsAre("!USE_E"));
    EXPECT_THAT(conditionsAt(text, "float version;"), IsEmpty());
    EXPECT_THAT(conditionsAt(text, "float inVersion;"), ElementsAre("USE_A"));
    EXPECT_THAT(conditionsAt(text, "float either;"), IsEmpty());
    EXPECT_THAT(conditionsAt(text, "float not_either;"), IsEmpty());
    EXPECT_THAT(conditionsAt(text, "float mode;"), ElementsAre("MODE"));
    EXPECT_THAT(conditionsAt(text, "float other_mode;"), ElementsAre("!MODE"));
    EXPECT_THAT(conditionsAt(text, "float after;"), IsEmpty());
}

TEST(CocosPragma, MarksSayWhatTheNextDeclarationIs) {
    CocosBench bench;
    bench.fragment(
        "#pragma define ONE 1\n#pragma builtin(global)\nlayout(set = 0, binding = 0) uniform CCGlobal { vec4 a; };\n"
        "#pragma builtin( local )\nlayout(set = 2, binding = 0) uniform CCLocal { vec4 b; };\n#pragma rate map pass\n"
        "uniform sampler2D map;\n#pragma rate loose\n#pragma glBinding(3)\n#pragma format(RGBA16UI)\n"
        "#pragma subpass\n#pragma subpassColor in albedo\n#pragma subpassDepth in depth\n");
    const StageText text = bench.fragmentText();
    ASSERT_EQ(text.marks.size(), 8u);
    const auto lineOf = [&](std::size_t i) {
        const auto& where = text.flat.lines[static_cast<std::size_t>(text.marks[i].line) - 1];
        return where.line - 10;  // Of the program's text.
    };
    EXPECT_EQ(text.marks[0].kind, PragmaMark::Kind::BuiltinGlobal);
    EXPECT_EQ(lineOf(0), 2);
    EXPECT_EQ(text.marks[1].kind, PragmaMark::Kind::BuiltinLocal);
    EXPECT_EQ(text.marks[2].kind, PragmaMark::Kind::Rate);
    EXPECT_EQ(text.marks[2].name, "map");
    EXPECT_EQ(text.marks[2].value, "pass");
    EXPECT_EQ(text.marks[3].name, "loose");
    EXPECT_EQ(text.marks[3].value, "");
    EXPECT_EQ(text.marks[4].value, "3");
    EXPECT_EQ(text.marks[5].value, "RGBA16UI");
    EXPECT_EQ(text.marks[6].kind, PragmaMark::Kind::SubpassColor);
    EXPECT_EQ(text.marks[6].name, "albedo");
    EXPECT_EQ(text.marks[7].kind, PragmaMark::Kind::SubpassDepth);
    EXPECT_EQ(lineOf(7), 13);
    EXPECT_THAT(text.flat.text, Not(HasSubstr("#pragma")));
}

TEST(CocosPragma, SubpassPragmasDeclareInputsAndOutputs) {
    CocosBench bench;
    bench.fragment(
        "precision highp float;\n#pragma subpass\n#pragma subpassColor in highp albedo\n#pragma usubpassColor in ids\n"
        "#pragma isubpassStencil in stencil\n#pragma subpassColor out mediump lit\n#pragma subpassColor out bright\n"
        "void main() { lit = subpassLoad(albedo) + vec4(subpassLoad(ids)); bright = vec4(subpassLoad(stencil)); }\n");
    EXPECT_EQ(bench.compileError(), "");
    bench.fragment("#pragma subpassColor away x\n");
    EXPECT_EQ(bench.problem().message, "'#pragma subpassColor' is not in, out or inout");
    bench.fragment("#pragma subpassDepth out x\n");
    EXPECT_EQ(bench.problem().message, "'#pragma subpassDepth' is not in");
    bench.fragment("#pragma subpassColor in highp\n");
    EXPECT_EQ(bench.problem().message, "the pragma names no subpass input");
}

TEST(CocosPragma, ExtensionsOfTheTargetGoToTheHead) {
    CocosBench bench;
    bench.fragment(
        "#pragma extension([GL_OES_standard_derivatives, __VERSION__ < 110])\n"
        "#pragma extension([GL_OES_EGL_image_external_essl3, __VERSION__ >= 300, require])\n"
        "#pragma extension([GL_EXT_shader_explicit_arithmetic_types_int32, __VERSION__ > 310, require])\n"
        "#pragma extension([GL_EXT_control_flow_attributes, __VERSION__ >= 450, enable])\n"
        "layout(location = 0) out vec4 color;\nvoid main() { u32vec4 v = u32vec4(1u); color = vec4(v); }\n");
    const StageText text = bench.fragmentText();
    const std::string head = makeHead(text, text.macros, {});
    EXPECT_TRUE(
        head.starts_with("#version 450\n#extension GL_EXT_shader_explicit_arithmetic_types_int32 : require\n"
                         "#extension GL_EXT_control_flow_attributes : enable\n"))
        << head;
    EXPECT_THAT(head, Not(HasSubstr("GL_OES")));
    bench.compile();
}

TEST(CocosPragma, EveryMacroGetsAValueAndTheTextsOwnGetNone) {
    CocosBench bench;
    bench.fragment(
        "#pragma define-meta CC_USE_FOG range([0, 4])\n#pragma define-meta COUNT range([2, 8])\n"
        "#pragma define-meta UV options([v_uv, v_uv1])\n#pragma define CC_RENDER_MODE 1\n#ifdef FLAG\n#endif\n#if "
        "TESTED || defined(FLAG)\n#endif\n"
        "#define OWN 3\n#if OWN && CC_RENDER_MODE\n#endif\n");
    const StageText text = bench.fragmentText();
    const auto lines = words(makeHead(text, mergeMacros({text}), {}));
    EXPECT_THAT(lines, Contains("#define CC_USE_FOG 4"));  // No fog, not the first kind of fog.
    EXPECT_THAT(lines, Contains("#define COUNT 2"));
    EXPECT_THAT(lines, Contains("#define UV v_uv"));
    EXPECT_THAT(lines, Not(Contains("#define FLAG 0")));  // Only asked whether it is defined.
    EXPECT_THAT(lines, Contains("#define TESTED 0"));
    EXPECT_THAT(lines, Contains("#define CC_DEVICE_SUPPORT_FLOAT_TEXTURE 1"));
    EXPECT_THAT(lines, Contains("#define CC_ENABLE_CLUSTERED_LIGHT_CULLING 0"));
    EXPECT_THAT(makeHead(text, text.macros, {}), Not(HasSubstr("OWN")));
    EXPECT_THAT(makeHead(text, text.macros, {}), Not(HasSubstr("CC_RENDER_MODE")));
    const Defines values = {{"FLAG", "true"},    {"COUNT", "5"},   {"UV", "v_uv1"},
                            {"CC_USE_FOG", "1"}, {"STRANGE", "1"}, {"CC_PLATFORM_ANDROID_AND_WEBGL", "1"},
                            {"OWN", "9"}};
    const auto given = words(makeHead(text, mergeMacros({text}), values));
    EXPECT_THAT(given, Contains("#define FLAG 1"));
    EXPECT_THAT(given, Contains("#define COUNT 5"));
    EXPECT_THAT(given, Contains("#define UV v_uv1"));
    EXPECT_THAT(given, Contains("#define CC_USE_FOG 1"));
    EXPECT_THAT(given, Contains("#define CC_PLATFORM_ANDROID_AND_WEBGL 1"));
    EXPECT_THAT(given, Not(Contains("#define STRANGE 1")));
    EXPECT_THAT(given, Not(Contains("#define OWN 9")));
    const auto odd = words(makeHead(text, mergeMacros({text}), {{"COUNT", "many"}, {"FLAG", "7"}}));
    EXPECT_THAT(odd, Contains("#define COUNT 2"));
    EXPECT_THAT(odd, Contains("#define FLAG 7"));
}

TEST(CocosPragma, EngineConstantsAreThoseOfADesktop) {
    CocosBench bench;
    bench.fragment(
        "layout(location = 0) out vec4 color;\n#if CC_DEVICE_CAN_BENEFIT_FROM_INPUT_ATTACHMENT\n"
        "void main() { color = subpassLoad(nobodyDeclaresIt); }\n#else\nvoid main() { color = vec4(1.0); }\n#endif\n");
    bench.compile();  // the branch for tilers is not taken, whatever it holds
    const StageText text = bench.fragmentText();
    EXPECT_TRUE(text.macros.empty());  // no macro of the material's
    const auto head = words(makeHead(text, text.macros, {}));
    for (const char* line :
         {"#define CC_DEVICE_CAN_BENEFIT_FROM_INPUT_ATTACHMENT 0", "#define CC_ENABLE_CLUSTERED_LIGHT_CULLING 0",
          "#define CC_DEVICE_SUPPORT_FLOAT_TEXTURE 1", "#define CC_PLATFORM_ANDROID_AND_WEBGL 0",
          "#define CC_ENABLE_WEBGL_HIGHP_STRUCT_VALUES 0", "#define CC_USE_WGPU 0"})
        EXPECT_THAT(head, Contains(line));
    EXPECT_THAT(makeHead(text, {}, {}), HasSubstr("#define CC_DEVICE_MAX_VERTEX_UNIFORM_VECTORS "));
    EXPECT_THAT(makeHead(text, {}, {}), HasSubstr("#define CC_JOINT_UNIFORM_CAPACITY "));
    EXPECT_THAT(head.front(), "#version 450");
}

TEST(CocosPragma, DefaultFunctionsStandWhereNobodyDefinesTheirOwn) {
    CocosBench bench;
    bench.chunk("defaults", "#ifndef SURFACES_MODIFY\nfloat modify() { return 1.0; }\n#endif\n");
    const std::string main = "#include <defaults>\nvoid main() { color = vec4(modify()); }\n";
    bench.fragment("layout(location = 0) out vec4 color;\n" + main);
    bench.compile();
    bench.fragment("layout(location = 0) out vec4 color;\n#define SURFACES_MODIFY\nfloat modify() { return 2.0; }\n" +
                   main);
    bench.compile();
}

TEST(CocosPragma, EmbeddedMacrosWin) {
    CocosBench bench;
    bench.effect("void main() { gl_Position = vec4(0.0); }\n",
                 "layout(location = 0) out vec4 color;\n#if MODE == 1\nvoid main() { color = vec4(1.0); }\n#endif\n",
                 "", "      embeddedMacros: { MODE: 1 }\n");
    bench.compile();
    bench.compile({{"MODE", "0"}});
}

TEST(CocosPragma, MistakesAreNamed) {
    CocosBench bench;
    bench.fragment("#pragma define-meta COUNT range([8, 2])\n");
    EXPECT_EQ(bench.problem().message, "the range of 'COUNT' is not two ascending integers");
    EXPECT_EQ(bench.problem().where.line, 11);
    bench.fragment("#pragma builtin(other)\n");
    EXPECT_EQ(bench.problem().message, "'builtin(other)' is neither global nor local");
    bench.fragment("#pragma extension\n");
    EXPECT_EQ(bench.problem().message, "'#pragma extension' has no value in brackets");
    bench.fragment("#pragma strange thing\n#pragma deprecate-chunk old use 'new'\n#pragma\n#\n");
    EXPECT_EQ(bench.problem().message, "");
}

TEST(CocosCondition, VersionDecides) {
    EXPECT_EQ(decideByVersion("__VERSION__ >= 300"), true);
    EXPECT_EQ(decideByVersion("__VERSION__ < 450 || 0"), false);
    EXPECT_EQ(decideByVersion("USE_A && __VERSION__ < 130"), false);
    EXPECT_EQ(decideByVersion("USE_A || __VERSION__ == 450"), true);
    EXPECT_EQ(decideByVersion("USE_A && __VERSION__ == 450"), std::nullopt);
    EXPECT_EQ(decideByVersion("!(__VERSION__ - 450)"), true);
    EXPECT_EQ(decideByVersion("(0x10 | 1) == 17 && 010 == 8 && 7 / 2 * 2 == 6"), true);
    EXPECT_EQ(decideByVersion("1 << 3 > 7 && -1 < 0 && ~0 == -1"), true);
    EXPECT_EQ(decideByVersion("1 / 0"), std::nullopt);
    EXPECT_EQ(decideByVersion("(1"), std::nullopt);
    EXPECT_EQ(decideByVersion("1 +"), std::nullopt);
    EXPECT_EQ(decideByVersion(""), std::nullopt);
}

TEST(CocosCondition, WordsAreKept) {
    const NameLookup outside = [](std::string_view, bool) { return ConditionName{}; };
    const auto needs = [&](std::string_view text) { return keepNames(text, outside).needs; };
    EXPECT_THAT(needs("A && !B && defined(C)"), ElementsAre("A", "!B", "C"));
    EXPECT_THAT(needs("defined D && !defined(E)"), ElementsAre("D", "!E"));
    EXPECT_THAT(needs("!(A)"), ElementsAre("!A"));
    EXPECT_THAT(needs("(!A)"), ElementsAre("A"));  // The word does not begin with the sign.
    EXPECT_THAT(needs("A&&B"), ElementsAre("A"));  // One word, one name.
    EXPECT_THAT(needs("A == 2"), ElementsAre("A"));
    EXPECT_THAT(needs("A && (B || C)"), IsEmpty());
    EXPECT_THAT(needs("A || __VERSION__ < 300"), IsEmpty());
    EXPECT_THAT(needs("__VERSION__ < 300 && A"), ElementsAre("A"));
    EXPECT_THAT(needs("1 == 2"), IsEmpty());
    EXPECT_THAT(needs(""), IsEmpty());
    const auto compared = [&](std::string_view text) { return keepNames(text, outside).compared; };
    EXPECT_THAT(compared("A == 2 && B <= C"), ElementsAre("A", "B"));
    EXPECT_THAT(compared("A != 2 && 1 < B"), ElementsAre("A"));  // The name before it, from whichever part.
    EXPECT_THAT(compared("A==2"), IsEmpty());
    EXPECT_THAT(turnRound({"A", "!B"}), ElementsAre("!A", "B"));
}

}  // namespace
}  // namespace crevice::cocos
