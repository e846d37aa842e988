// Tests of StageTranslator: the short way to SPIR-V comes to the code that the long one (glslang's TShader) comes to.
#include <gtest/gtest.h>

#include "effect/ShaderCompiler.h"
#include "effect/StageTranslator.h"

namespace crevice {
namespace {

struct Compiled {
    std::vector<std::uint32_t> words;
    std::string messages;
};

StageSource stageOf(ShaderStageBits stage, const std::string& text, bool numbered) {
    StageSource source;
    source.stage = stage;
    source.head = "#version 450\n";
    source.text = source.flat.text = text;
    source.numbered = numbered;
    source.flat.files = {"text.glsl"};
    for (int line = 1; line <= 40; ++line) source.flat.lines.push_back({0, line});
    return source;
}

/// Numbered stages go the short way, others the long one, where numbers that are all written change nothing.
Compiled compileText(ShaderCompiler& compiler, ShaderStageBits stage, const std::string& text, bool numbered) {
    const StageSource source = stageOf(stage, text, numbered);
    Problems problems;
    auto code = compiler.compile({&source, 1}, {}, problems);
    Compiled compiled;
    if (!code.empty()) compiled.words = std::move(code.front().words);
    for (const Problem& problem : problems.all()) compiled.messages += formatProblem(problem) + "\n";
    return compiled;
}

void expectSame(ShaderCompiler& compiler, ShaderStageBits stage, const std::string& text) {
    const Compiled quick = compileText(compiler, stage, text, true), plain = compileText(compiler, stage, text, false);
    EXPECT_FALSE(quick.words.empty()) << quick.messages;
    EXPECT_EQ(quick.words, plain.words);
    EXPECT_EQ(quick.messages, "");
}

TEST(StageTranslator, AllStagesGoTheShortWay) {
    StageTranslator translator;
    const std::string version = "#version 450\n";
    EXPECT_TRUE(translator.translate(kVertexBit, version + "void main() { gl_Position = vec4(1.0); }\n"));
    EXPECT_TRUE(translator.translate(kFragmentBit, version + "void main() { discard; }\n"));
    EXPECT_TRUE(translator.translate(kComputeBit, version + "layout(local_size_x = 8) in;\nvoid main() {}\n"));
    EXPECT_TRUE(translator.translate(kVertexBit, version + "#if GL_core_profile\nvoid main() {}\n#endif\n"));
    EXPECT_FALSE(translator.translate(kVertexBit, version + "void main() { wrong }\n"));
    EXPECT_FALSE(translator.translate(kVertexBit, "void main() {}\n")) << "without a version";
}

TEST(StageTranslator, VertexStagesAreTheSameToTheBit) {
    ShaderCompiler compiler;
    expectSame(compiler, kVertexBit, R"(
        layout(location = 0) in vec3 a_position;
        layout(location = 0) out vec2 v_uv;
        layout(set = 1, binding = 0) uniform Block { mat4 world; vec4 tints[4]; };
        void main() {
            v_uv = tints[gl_VertexIndex % 4].xy + float(gl_InstanceIndex);
            gl_Position = world * vec4(a_position, 1.0);
            gl_PointSize = float(gl_MaxVertexAttribs);
        })");
}

TEST(StageTranslator, FragmentStagesAreTheSameToTheBit) {
    ShaderCompiler compiler;
    expectSame(compiler, kFragmentBit, R"(
        precision mediump float;
        #define v_uv gl_FragCoord.xy
        layout(location = 0) out highp vec4 color;
        layout(set = 1, binding = 0) uniform sampler2D map;
        layout(set = 1, binding = 1) uniform samplerCube sky;
        float squared(float x) { return x * x; }
        float squared(vec2 x) { return dot(x, x); }
        void main() {
            if (squared(v_uv) > 4.0) discard;
            color = texture(map, v_uv) + textureLod(sky, vec3(v_uv, 1.0), 2.0) * squared(dFdx(v_uv.x));
            for (int i = 0; i < gl_MaxDrawBuffers; ++i) color.a += pow(color.r, float(i));
        })");
}

TEST(StageTranslator, ComputeStagesAreTheSameToTheBit) {
    ShaderCompiler compiler;
    expectSame(compiler, kComputeBit, R"(
        layout(local_size_x = 8, local_size_y = 4) in;
        layout(set = 1, binding = 0, rgba8) uniform image2D image;
        layout(set = 1, binding = 1) buffer Sums { uint sums[]; };
        shared uint partial[gl_WorkGroupSize.x * gl_WorkGroupSize.y];
        void main() {
            partial[gl_LocalInvocationIndex] = 1u;
            barrier();
            atomicAdd(sums[gl_WorkGroupID.x], partial[0]);
            imageStore(image, ivec2(gl_GlobalInvocationID.xy), vec4(1.0));
        })");
}

TEST(StageTranslator, MacrosOfTheCompilerKeepTheirValues) {
    ShaderCompiler compiler;
    for (const char* condition :
         {"GL_core_profile", "VULKAN_WORDS + 1", "MY_GL_WORDS + 1", "VULKAN == 100", "GL_KHR_shader_subgroup_basic",
          "defined(GL_ES)", "__VERSION__ == 450", "defined(VULKAN)"})
        expectSame(compiler, kVertexBit,
                   std::string("#if ") + condition +
                       "\nvoid main() { gl_Position = vec4(1.0); }\n#else\nvoid main() {}\n#endif\n");
    expectSame(
        compiler, kVertexBit,
        "#define JOIN(a, b) a##b\nvoid main() { gl_Position = vec4(float(JOIN(VUL, KAN)), JOIN(G, L_core_profile), "
        "0.0, 1.0); }\n");
}

TEST(StageTranslator, ExtensionsAreRead) {
    ShaderCompiler compiler;
    expectSame(compiler, kVertexBit,
               "#extension GL_EXT_shader_explicit_arithmetic_types_int32 : require\n"
               "layout(location = 0) in u32vec4 joints;\nvoid main() { gl_Position = vec4(joints); }\n");
}

TEST(StageTranslator, AShaderKnowsNothingOfTheOneBefore) {
    const std::string first =
        "float helper() { return 1.0; }\n#define HALF 0.5\n"
        "void main() { gl_Position = vec4(helper() * HALF); }\n";
    const std::string second = "void main() { gl_Position = vec4(helper() * HALF); }\n";
    const StageSource sources[] = {stageOf(kVertexBit, first, true), stageOf(kVertexBit, second, true)};
    ShaderCompiler compiler;
    Problems none, some;
    EXPECT_EQ(compiler.compile({&sources[0], 1}, {}, none).size(), 1u);
    EXPECT_FALSE(none.hasErrors());
    EXPECT_TRUE(compiler.compile({&sources[1], 1}, {}, some).empty());
    ASSERT_TRUE(some.hasErrors());
    EXPECT_NE(formatProblem(some.all().front()).find("helper"), std::string::npos);
}

TEST(StageTranslator, MistakesAreSaidAsGlslangSaysThem) {
    ShaderCompiler compiler;
    for (const char* text : {"void main() { gl_Position = vec3(1.0); }\n", "void main() { gl_Position = vec4(1.0);\n",
                             "layout(location = 0) in vec3 a;\nvoid main() { gl_Position = b; }\n", "",
                             "float f();\nvoid main() { gl_Position = vec4(f()); }\n"}) {
        const Compiled quick = compileText(compiler, kVertexBit, text, true),
                       plain = compileText(compiler, kVertexBit, text, false);
        EXPECT_TRUE(quick.words.empty()) << text;
        EXPECT_NE(quick.messages, "") << text;
        EXPECT_EQ(quick.messages, plain.messages) << text;
    }
}

}  // namespace
}  // namespace crevice
