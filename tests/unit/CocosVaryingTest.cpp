// Varyings meet by name: what both programs say of one must agree in the variant that is compiled.
#include <gtest/gtest.h>

#include "CocosFrontTools.h"

namespace crevice::cocos {
namespace {

Problem problemOf(const CocosBench& bench, const Defines& defines = {}) {
    try {
        bench.compile(defines);
    } catch (const Error& error) {
        return error.problems().front();
    }
    return {};
}

const std::string kVertex = "void main() { v_at = vec3(1.0); gl_Position = vec4(1.0); }\n";

TEST(CocosVarying, OneTypeInBothPrograms) {
    CocosBench bench;
    bench.effect("out vec3 v_at;\n" + kVertex,
                 "in vec4 v_at;\nlayout(location = 0) out vec4 color;\nvoid main() { color = v_at; }\n");
    const Problem problem = problemOf(bench);
    EXPECT_EQ(problem.message, "varying 'v_at' is a vec4 here, but a vec3 in the vertex program");
    EXPECT_EQ(problem.where.line, 12);
    ASSERT_EQ(problem.remarks.size(), 1u);
    EXPECT_EQ(problem.remarks[0].where.line, 8);
    EXPECT_EQ(problem.help, "give both the same type");
}

TEST(CocosVarying, OnlyTheBranchesThatAreTaken) {
    CocosBench bench;
    bench.effect(
        "#if USE_WIDE\nout vec4 v_at;\nvoid main() { v_at = vec4(1.0); gl_Position = v_at; }\n#else\nout vec3 v_at;\n" +
            kVertex + "#endif\n",
        "#if READ_WIDE\nin vec4 v_at;\n#else\nin vec3 v_at;\n#endif\nlayout(location = 0) out vec4 color;\n"
        "void main() { color = vec4(v_at.xyz, 1.0); }\n");
    EXPECT_EQ(problemOf(bench).message, "");
    EXPECT_EQ(problemOf(bench, {{"USE_WIDE", "1"}, {"READ_WIDE", "1"}}).message, "");
    EXPECT_EQ(problemOf(bench, {{"READ_WIDE", "1"}}).message,
              "varying 'v_at' is a vec4 here, but a vec3 in the vertex program");
}

TEST(CocosVarying, MoreMayBeWrittenThanIsRead) {
    CocosBench bench;
    const std::string main = "void main() { gl_Position = vec4(1.0); }\n";
    const std::string color = "layout(location = 0) out vec4 color;\n";
    const auto meet = [&](const std::string& written, const std::string& read) {
        bench.effect("flat out " + written + " v_at;\n" + main,
                     color + "flat in " + read + " v_at;\nvoid main() { color = vec4(v_at.x); }\n");
        return problemOf(bench).message;
    };
    EXPECT_EQ(meet("vec4", "vec2"), "");
    EXPECT_EQ(meet("ivec3", "ivec2"), "");
    EXPECT_EQ(meet("vec2", "vec4"), "varying 'v_at' is a vec4 here, but a vec2 in the vertex program");
    EXPECT_EQ(meet("ivec4", "vec2"), "varying 'v_at' is a vec2 here, but a ivec4 in the vertex program");
    EXPECT_EQ(meet("uvec4", "ivec2"), "varying 'v_at' is a ivec2 here, but a uvec4 in the vertex program");
}

TEST(CocosVarying, ArraysAndUnreadOnes) {
    CocosBench bench;
    const std::string main = "void main() { gl_Position = vec4(1.0); }\n";
    const std::string color = "layout(location = 0) out vec4 color;\n";
    bench.effect("out vec4 v_rows[2];\n" + main, color + "in vec4 v_rows[3];\nvoid main() { color = v_rows[0]; }\n");
    EXPECT_EQ(problemOf(bench).message, "varying 'v_rows' is a vec4[3] here, but a vec4[2] in the vertex program");
    bench.effect("out vec4 v_rows[2];\n" + main, color + "in vec4 v_rows[2];\nvoid main() { color = v_rows[0]; }\n");
    EXPECT_EQ(problemOf(bench).message, "");
    bench.effect("out vec4 v_rows;\n" + main, color + "in vec2 v_rows;\nvoid main() { color = vec4(1.0); }\n");
    EXPECT_EQ(problemOf(bench).message, "");  // Nothing reads it.
}

}  // namespace
}  // namespace crevice::cocos
