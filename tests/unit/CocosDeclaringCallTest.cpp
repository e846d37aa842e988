// Declarations as arguments: the macros that are given them are written out, so that they get their numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"

namespace crevice::cocos {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kColor = "layout(location = 0) out vec4 color;\n";
const std::string kMain = "void main() { color = vec4(0.5)";

TEST(CocosDeclaringCall, ADeclarationInAnArgumentGetsItsNumber) {
    CocosBench bench;
    bench.fragment("#define SAME(code) code\nSAME(uniform sampler2D extraTex;)\n" + kColor + kMain +
                   " + texture(extraTex, vec2(0.5)); }\n");
    const std::string text = bench.fragmentText().flat.text;
    EXPECT_THAT(text, HasSubstr("uniform sampler2D extraTex;"));
    EXPECT_THAT(text, Not(HasSubstr("SAME(uniform")));
    bench.compile();
}

TEST(CocosDeclaringCall, AConditionChoosesWhetherItIsOne) {
    CocosBench bench;
    bench.fragment(
        "#define IF_B(code)\n#if USE_B\n#undef IF_B\n#define IF_B(code) code\n#endif\n"
        "IF_B(uniform sampler2D extraTex;)\n" +
        kColor + kMain + "; IF_B(color += texture(extraTex, vec2(0.5));) }\n");
    bench.compile();
    bench.compile({{"USE_B", "1"}});
}

TEST(CocosDeclaringCall, OverLinesAndInBlocks) {
    CocosBench bench;
    bench.fragment(
        "#define SAME(code) code\nSAME(\n  uniform\n  Extra { vec4 tint; };\n)\n"
        "SAME(layout(rgba8)\n  uniform readonly image2D picture;)\n" +
        kColor + kMain + " + tint + imageLoad(picture, ivec2(0)); }\n");
    bench.compile();
}

TEST(CocosDeclaringCall, ItIsHandedOn) {
    CocosBench bench;
    bench.fragment(
        "#define SAME(code) code\n#define ALIAS SAME\n#define OUTER(x) ALIAS(x)\n"
        "#define BOTH SAME(uniform sampler2D two;)\nOUTER(uniform sampler2D one;)\nBOTH\n"
        "SAME(OUTER(uniform sampler2D three;))\n" +
        kColor + kMain + " + texture(one, vec2(0.5)) + texture(two, vec2(0.5)) + texture(three, vec2(0.5)); }\n");
    bench.compile();
}

TEST(CocosDeclaringCall, TheStorageAloneIsAnArgument) {
    CocosBench bench;
    bench.effect(
        "#define IO(storage, type, name) storage type name;\nIO(in, vec3, a_position)\nIO(out, vec2, v_uv)\n"
        "void main() { v_uv = a_position.xy; gl_Position = vec4(a_position, 1.0); }\n",
        "#define IO(storage, type, name) storage type name;\nIO(in, vec2, v_uv)\nIO(out, vec4, color)\n"
        "void main() { color = v_uv.xyxy; }\n");
    bench.compile();
}

TEST(CocosDeclaringCall, ParametersOfFunctionsAreNone) {
    CocosBench bench;
    bench.fragment(
        "#define SQUARE(x) ((x) * (x))\nfloat f(in float a, inout float b) { return SQUARE(a) + SQUARE(b); }\n" +
        kColor + "void main() { float b = 1.0; color = vec4(f(2.0, b)); }\n");
    EXPECT_THAT(bench.fragmentText().flat.text, HasSubstr("SQUARE(a) + SQUARE(b)"));
    bench.compile();
}

}  // namespace
}  // namespace crevice::cocos
