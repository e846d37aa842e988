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

TEST(GlslTypeText, OtherTextStays) {
    for (const char* text : {"", "undeclared identifier", "no quotes at all", "an ' alone", "'a && b' : wrong operand",
                             "' temp structure{ global highp float a}'"})
        EXPECT_EQ(plainGlslTypes(text), text);
}

}  // namespace
}  // namespace crevice
