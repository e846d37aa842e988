// glslang's words for types, as they stand in its messages, against the names that GLSL 4.50 gives them.
#include "effect/GlslTypeText.h"

#include <gtest/gtest.h>

namespace crevice {
namespace {

TEST(GlslTypeText, VectorsMatricesAndScalarsLoseTheirQualifiers) {
    EXPECT_EQ(
        plainGlslTypes("cannot convert from ' temp highp 3-component vector of float' to 'layout( location=0) out "
                       "highp 4-component vector of float'"),
        "cannot convert from 'vec3' to 'vec4'");
    EXPECT_EQ(plainGlslTypes("'const int' and 'global bool'"), "'int' and 'bool'");
    EXPECT_EQ(plainGlslTypes("' temp 2-component vector of uint', ' temp 4-component vector of bool'"),
              "'uvec2', 'bvec4'");
    EXPECT_EQ(plainGlslTypes("'uniform highp 3X3 matrix of float', ' temp 4X2 matrix of double'"), "'mat3', 'dmat4x2'");
    EXPECT_EQ(plainGlslTypes("'layout( set=1 binding=0) uniform highp sampler2D'"), "'sampler2D'");
}

TEST(GlslTypeText, ArraysKeepTheirLengths) {
    EXPECT_EQ(plainGlslTypes("' temp 4-element array of highp 3-component vector of int'"), "'ivec3[4]'");
    EXPECT_EQ(plainGlslTypes("' temp 2-element array of 3-element array of float'"), "'float[2][3]'");
}

TEST(GlslTypeText, ArraysWithoutALengthHaveEmptyBrackets) {
    EXPECT_EQ(plainGlslTypes("' temp unsized 1-element array of highp float'"), "'float[]'");
    EXPECT_EQ(plainGlslTypes("'layout( column_major std430) buffer runtime-sized array of highp 2-component vector of "
                             "float'"),
              "'vec2[]'");
}

TEST(GlslTypeText, MembersAreNotWrittenOut) {
    EXPECT_EQ(plainGlslTypes("cannot convert from ' temp structure{ global highp float a,  global highp 2-component "
                             "vector of float c}' to ' temp highp float'"),
              "cannot convert from a struct to 'float'");
    EXPECT_EQ(plainGlslTypes("' temp 2-element array of structure{ global structure{ global highp float a} s}'"),
              "an array of structs");
    EXPECT_EQ(plainGlslTypes("'layout( set=0 binding=0) uniform block{layout( std140) uniform highp float a}'"),
              "a block");
    std::string members;
    for (int i = 0; i < 20000; ++i) members += " global highp float member" + std::to_string(i) + ", ";
    EXPECT_EQ(plainGlslTypes("from ' temp structure{" + members + "}' to ' temp highp float'"),
              "from a struct to 'float'");
    EXPECT_EQ(plainGlslTypes("from ' temp structure{" + members), "from a struct") << "cut off by glslang";
}

TEST(GlslTypeText, AdviceGoesByTheTwoTypes) {
    const auto advises = [](const char* message, const char* part) {
        const std::string advice = conversionAdvice(message);
        EXPECT_NE(advice.find(part), std::string::npos) << message << ": " << advice;
    };
    advises("cannot convert from 'vec3' to 'vec4'", "components");
    advises("cannot convert from 'float' to 'mat3x2'", "components");
    advises("cannot convert from 'float' to 'int'", "write the conversion");
    advises("cannot convert from a struct to 'vec2'", "member");
    advises("cannot convert from 'float' to a struct", "member");
    advises("cannot convert from 'vec2[3]' to 'vec2'", "element");
    advises("cannot convert from 'sampler2D' to 'float'", "a value of the type");
}

TEST(GlslTypeText, OtherTextStays) {
    for (const char* text : {"", "undeclared identifier", "no quotes at all", "an ' alone", "'a && b' : wrong operand"})
        EXPECT_EQ(plainGlslTypes(text), text);
}

}  // namespace
}  // namespace crevice
