// "program:entry": the function must be there and return what the stage results in; what cannot be known is let pass.
#include "cocos/analysis/EntryCheck.h"

#include <gtest/gtest.h>

namespace crevice::cocos {
namespace {

std::string problemOf(const std::string& text, ShaderStageBits stage = kFragmentBit) {
    Problems problems;
    checkEntry(text, {"fs", "shade"}, stage, {"e.effect", 4, 2, 1}, problems);
    return problems.all().empty() ? "" : problems.all()[0].message;
}

TEST(CocosEntry, FunctionsOfFourComponentsPass) {
    for (const char* good :
         {"vec4 shade() { return vec4(1.0); }", "highp vec4 shade () {}", "vec4\nshade\n(\n)\n{}", "COLOR shade() {}",
          "struct S { vec4 c; }; S shade() {}", "#if A\nvoid shade() {}\n#else\nvec4 shade() {}\n#endif"})
        EXPECT_EQ(problemOf(good), "") << good;
}

TEST(CocosEntry, NamesThatMacrosMayMakePass) {
    EXPECT_EQ(problemOf("#define FN(n) vec4 n() { return vec4(1.0); }\nFN(shade)"), "");
    EXPECT_EQ(problemOf("#define FN(n) vec4 sh##n() { return vec4(1.0); }\nFN(ade)"), "");
}

TEST(CocosEntry, MissingOnesAreNamedWithWhatIsNear) {
    Problems problems;
    checkEntry("vec4 shadow() { return other(); }\n", {"fs", "shade"}, kFragmentBit, {"e.effect", 4, 2, 1}, problems);
    ASSERT_EQ(problems.all().size(), 1u);
    EXPECT_EQ(problems.all()[0].message, "program 'fs' has no function 'shade'");
    EXPECT_EQ(problems.all()[0].help, "did you mean 'shadow'?");
    EXPECT_EQ(problems.all()[0].where.line, 4);
    EXPECT_EQ(problemOf("vec4 shader() {} float xshade;"), "program 'fs' has no function 'shade'");
}

TEST(CocosEntry, OtherResultsAreErrorsButForCompute) {
    EXPECT_EQ(problemOf("void shade() {}"), "function 'shade' returns void, not the vec4 that the stage results in");
    EXPECT_EQ(problemOf("vec3 shade() {}", kVertexBit),
              "function 'shade' returns vec3, not the vec4 that the stage results in");
    EXPECT_EQ(problemOf("void shade() {}", kComputeBit), "");
}

}  // namespace
}  // namespace crevice::cocos
