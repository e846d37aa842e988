// Lines that a backslash continues: what it parts is one word, in code, in preprocessor lines and in macros.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"
#include "cocos/text/Splices.h"

namespace crevice::cocos {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const std::string kColor = "layout(location = 0) out vec4 color;\n";

TEST(CocosSplice, MovesWhatIsPartedUp) {
    EXPECT_EQ(joinParted("a SPLI\\\nCED b"), "a SPLICED\\\n b");
    EXPECT_EQ(joinParted("x1\\\n2\\\n3;y"), "x123\\\n\\\n;y");
    EXPECT_EQ(joinParted("a &\\\n& b"), "a &&\\\n b");
    EXPECT_EQ(joinParted("#define F\\\n(x) x"), "#define F(\\\nx) x");
    EXPECT_EQ(joinParted("1.\\ \n5"), "1.5\\ \n");
}

TEST(CocosSplice, LeavesTheRest) {
    for (const std::string text :
         {"a\\\n b", "a \\\nb", "a;\\\nb", "a\\\n#if B\nc", "a \\ b\nc", "(\\\na", "a\\", "\\\na"})
        EXPECT_EQ(joinParted(text), text);
}

TEST(CocosSplice, NamesInConditions) {
    CocosBench bench;
    bench.fragment(kColor + "#if SPLI\\\nCED &\\\n& USE_B\n#define ONE 1.0\n#else\n#define ONE 2.0\n#endif\n" +
                   "void main() { color = vec4(ONE); }\n");
    const StageText stage = bench.fragmentText();
    EXPECT_THAT(macroNames(stage), ElementsAre("SPLICED", "USE_B"));
    EXPECT_THAT(words(stage.flat.text), Contains("#if SPLICED  &&  USE_B"));
    bench.compile();
    bench.compile({{"SPLICED", "1"}, {"USE_B", "1"}});
}

TEST(CocosSplice, ConditionsOfTheVersionAreReadToTheirEnd) {
    CocosBench bench;  // It holds only where USE_B does: neither branch is dead.
    bench.fragment(kColor +
                   "#if __VERSION__ >= 450 \\\n  && USE_B\n#define DECL uniform vec4 both\n#else\n"
                   "#define DECL uniform vec4 one\n#endif\nDECL;\nvoid main() { color = vec4(1.0); }\n");
    const std::string text = bench.fragmentText().flat.text;
    EXPECT_THAT(text, HasSubstr("vec4 both"));
    EXPECT_THAT(text, HasSubstr("vec4 one"));
}

TEST(CocosSplice, NamesInCodeAndInMacros) {
    CocosBench bench;
    bench.fragment("#define TWICE(x) (x + \\\n#if USE_A \\\n 1.0 + \\\n#endif \\\n x)\n#define LONG na\\\nme +\\\n=\n" +
                   kColor + "void main() { float name = TW\\\nICE(1.0); LONG 1.\\\n5; color = vec4(na\\\nme); }\n");
    const std::string text = bench.fragmentText().flat.text;
    EXPECT_THAT(text, Not(HasSubstr("ICE(")));
    EXPECT_THAT(text, HasSubstr("vec4(name"));
    EXPECT_THAT(text, Not(HasSubstr("(\\")));
    bench.compile();
    bench.compile({{"USE_A", "1"}});
}

TEST(CocosSplice, BodiesPasteOverLines) {
    CocosBench bench;
    bench.fragment(
        "#define DECL(t, n) \\\n uniform t u_ ## \\\n n\n#define DECL2(t, n) \\\n uniform t w_ \\\n ## n\n"
        "DECL(sampler2D, a);\nDECL2(sampler2D, b);\n" +
        kColor + "void main() { color = texture(u_a, vec2(0.5)) + texture(w_b, vec2(0.5)); }\n");
    bench.compile();
}

}  // namespace
}  // namespace crevice::cocos
