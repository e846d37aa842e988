// Compilation and reflection: numbers by name, what is really used, layouts, and errors at the author's lines.
#include <gtest/gtest.h>

#include "EffectTestTools.h"

namespace crevice {
namespace {

const char* const kOut = "in vec2 v_uv;\nlayout(location = 0) out vec4 color;\n";

BindingSlot slotOf(const EffectVariant& variant, const char* name) {
    const ShaderResource* resource = variant.info.find(name);
    EXPECT_NE(resource, nullptr) << name;
    return resource == nullptr ? BindingSlot{99, 99} : resource->slot;
}

bool isActive(const EffectVariant& variant, const char* name) {
    const ShaderResource* resource = variant.info.find(name);
    EXPECT_NE(resource, nullptr) << name;
    return resource != nullptr && resource->active;
}

TEST(ShaderCompiler, SsaoNumbersAreElevenAndTwelve) {
    EffectBench bench;
    bench.fullscreen(
        std::string(kOut) +
        "uniform sampler2D cc_ssaoMap;\nuniform CCSsao { vec4 cc_cameraNFLSInfo; vec4 ssao_samples[64]; };\n"
        "void main() { color = texture(cc_ssaoMap, v_uv) * cc_cameraNFLSInfo + ssao_samples[int(v_uv.x)]; }\n");
    const EffectVariant& variant = bench.get();
    EXPECT_EQ(slotOf(variant, "cc_ssaoMap"), (BindingSlot{0, 11}));
    EXPECT_EQ(slotOf(variant, "CCSsao"), (BindingSlot{0, 12}));
    const ShaderResource& block = *variant.info.find("CCSsao");
    EXPECT_EQ(block.size, 1040u);
    ASSERT_EQ(block.members.size(), 2u);
    EXPECT_EQ(block.members[0].offset, 0u);
    EXPECT_EQ(block.members[1].name, "ssao_samples");
    EXPECT_EQ(block.members[1].offset, 16u);
    EXPECT_EQ(block.members[1].size, 1024u);
    EXPECT_EQ(block.members[1].arrayCount, 64u);
    EXPECT_EQ(block.members[1].type, "vec4");
    EXPECT_TRUE(block.active);
    EXPECT_EQ(block.stages, kFragmentBit);
    EXPECT_EQ(variant.info.find("nothing"), nullptr);
}

TEST(ShaderCompiler, MaterialSetIsNumberedByCategoryThenDeclarationOverBothStages) {
    EffectBench bench;
    bench.effect(
        "CCEffect %{\n  techniques: [ { passes: [ { vert: vs, frag: fs } ] } ]\n}%\n"
        "CCProgram vs %{\nuniform sampler2D zVertexMap;\nuniform ZVertex { vec4 z; };\nuniform Shared { vec4 s; "
        "};\nout vec2 v_uv;\n"
        "void main() { v_uv = vec2(0.0); gl_Position = z + s + textureLod(zVertexMap, v_uv, 0.0); }\n}%\n"
        "CCProgram fs %{\nlayout(r32f) uniform image2D image;\nreadonly buffer Store { vec4 d[]; };\nuniform sampler2D "
        "bMap;\nuniform sampler2D aMap[2];\n"
        "uniform samplerCube sky;\nuniform Shared { vec4 s; };\nuniform A { vec4 a; };\nin vec2 v_uv;\nlayout(location "
        "= 0) out vec4 color;\n"
        "void main() { color = a + s + d[0] + texture(bMap, v_uv) + texture(aMap[1], v_uv) + imageLoad(image, "
        "ivec2(0)) + texture(sky, vec3(1)); }\n}%\n");
    const EffectVariant& variant = bench.get();
    const std::vector<std::string> order = {"ZVertex", "Shared", "A",     "zVertexMap", "bMap",
                                            "aMap",    "sky",    "Store", "image"};
    ASSERT_EQ(variant.info.resources.size(), order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        EXPECT_EQ(variant.info.resources[i].name, order[i]);
        EXPECT_EQ(variant.info.resources[i].slot, (BindingSlot{1, i}));
        EXPECT_TRUE(variant.info.resources[i].active) << order[i];
    }
    EXPECT_EQ(variant.info.find("Shared")->stages, kVertexBit | kFragmentBit);
    EXPECT_EQ(variant.info.find("aMap")->count, 2u);
    EXPECT_TRUE(variant.info.find("sky")->cube);
    EXPECT_FALSE(variant.info.find("bMap")->cube);
    EXPECT_EQ(variant.info.find("Store")->kind, ResourceKind::StorageBuffer);
    EXPECT_TRUE(variant.info.find("Store")->readOnly);
}

TEST(ShaderCompiler, LocalSetAndPinnedMaterialNamesAreObeyed) {
    EffectBench bench;
    bench.fullscreen(std::string(kOut) +
                     "uniform CCLocal { vec4 l; };\nuniform A { vec4 a; };\nuniform B { vec4 b; };\nvoid main() { "
                     "color = l + a + b; }\n");
    BindingMap map = contractBindings();
    map["B"] = {1, 0};
    const EffectVariant& variant = bench.get({}, map);
    EXPECT_EQ(slotOf(variant, "CCLocal"), (BindingSlot{2, 0}));
    EXPECT_EQ(slotOf(variant, "B"), (BindingSlot{1, 0}));
    EXPECT_EQ(slotOf(variant, "A"), (BindingSlot{1, 1}));
}

TEST(ShaderCompiler, OnlyUsedResourcesAreActive) {
    EffectBench bench;
    bench.fullscreen(
        std::string(kOut) +
        "uniform sampler2D used;\nuniform sampler2D viaParameter;\nuniform sampler2D unused;\nuniform sampler2D "
        "inDeadFunction;\n"
        "uniform sampler2D switched;\nuniform sampler2D sizeOnly;\nuniform Block { vec4 m; };\n"
        "vec4 dead() { return texture(inDeadFunction, v_uv); }\nvec4 read(sampler2D s) { return texture(s, v_uv); }\n"
        "void main() {\n  color = texture(used, v_uv) + read(viaParameter) + vec4(textureSize(sizeOnly, 0), 0, 0);\n"
        "#if USE_SWITCHED\n  color += texture(switched, v_uv);\n#endif\n}\n");
    const EffectVariant& off = bench.get();
    for (const char* name : {"used", "viaParameter", "sizeOnly"}) EXPECT_TRUE(isActive(off, name)) << name;
    for (const char* name : {"unused", "inDeadFunction", "switched", "Block"})
        EXPECT_FALSE(isActive(off, name)) << name;
    const EffectVariant& on = bench.get({{"USE_SWITCHED", "1"}});
    EXPECT_TRUE(isActive(on, "switched"));
    EXPECT_NE(on.id, off.id);
}

TEST(ShaderCompiler, PlacesOfDeclarationAndUse) {
    EffectBench bench;
    bench.chunk("maps", "\nuniform sampler2D cc_ssaoMap;\n");
    bench.fullscreen(std::string("#include <maps>\n") + kOut +
                     "void main() {\n  color = texture(cc_ssaoMap, v_uv);\n}\n");
    const ShaderResource& resource = *bench.get().info.find("cc_ssaoMap");
    EXPECT_EQ(std::filesystem::path(resource.where.file).filename(), "maps.chunk");
    EXPECT_EQ(resource.where.line, 2);
    EXPECT_EQ(resource.where.column, 19);
    EXPECT_EQ(resource.firstUse.file, bench.file());
    EXPECT_EQ(resource.firstUse.line, 16);
}

TEST(ShaderCompiler, AccessOfImagesIsDeclaredOrScanned) {
    EffectBench bench;
    bench.effect(
        "CCEffect %{\n  techniques: [ { passes: [ { compute: cs } ] } ]\n}%\nCCProgram cs %{\nlayout(local_size_x = 8, "
        "local_size_y = 4) in;\n"
        "layout(r32f) uniform readonly image2D declaredRead;\nlayout(r32f) uniform writeonly image2D "
        "declaredWrite;\nlayout(r32f) uniform image2D onlyRead;\n"
        "layout(r32f) uniform image2D onlyWritten;\nlayout(r32f) uniform image2D both;\nlayout(r32ui) uniform uimage2D "
        "counted;\n"
        "buffer Free { float f[]; };\n"
        "void main() { ivec2 p = ivec2(gl_GlobalInvocationID.xy); vec4 v = imageLoad(declaredRead, p) + "
        "imageLoad(onlyRead, p) + imageLoad(both, p);\n"
        "imageStore(declaredWrite, p, v); imageStore(onlyWritten, p, v); imageStore(both, p, v); "
        "imageAtomicAdd(counted, p, 1u); f[0] = v.x; }\n}%\n");
    const EffectVariant& variant = bench.get();
    EXPECT_FALSE(variant.compute.empty());
    EXPECT_TRUE(variant.vertex.empty());
    const auto access = [&](const char* name) {
        const ShaderResource* r = variant.info.find(name);
        return r == nullptr ? std::string("missing") : r->readOnly ? "read" : r->writeOnly ? "write" : "both";
    };
    EXPECT_EQ(access("declaredRead"), "read");
    EXPECT_EQ(access("onlyRead"), "read");
    EXPECT_EQ(access("declaredWrite"), "write");
    EXPECT_EQ(access("onlyWritten"), "write");
    EXPECT_EQ(access("both"), "both");
    EXPECT_EQ(access("counted"), "both");
    EXPECT_EQ(access("Free"), "both");
    EXPECT_EQ(variant.info.localSize[0], 8u);
    EXPECT_EQ(variant.info.localSize[1], 4u);
    EXPECT_EQ(variant.info.localSize[2], 1u);
}

TEST(ShaderCompiler, InputsOutputsAndVaryingsByName) {
    EffectBench bench;
    bench.effect(
        "CCEffect %{\n  techniques: [ { passes: [ { vert: vs, frag: fs } ] } ]\n}%\nCCProgram vs %{\nin vec3 "
        "a_position;\nlayout(location = 1) in vec4 a_color;\nin vec2 a_texCoord;\n"
        "out vec2 v_uv;\nout mat3 v_frame;\nout vec4 v_last;\nvoid main() { v_uv = a_texCoord; v_frame = mat3(1); "
        "v_last = vec4(1); gl_Position = vec4(a_position, 1); }\n}%\n"
        "CCProgram fs %{\nin vec4 v_last;\nin vec2 v_uv;\nlayout(location = 5) in mat3 v_frame;\nlayout(location = 1) "
        "out vec4 second;\nout vec4 first;\n"
        "void main() { first = v_last; second = vec4(v_uv, v_frame[0].x, 1); }\n}%\n");
    const ShaderInfo& info = bench.get().info;
    ASSERT_EQ(info.inputs.size(), 3u);
    EXPECT_EQ(info.inputs[0].name, "a_position");
    EXPECT_EQ(info.inputs[0].type, "vec3");
    EXPECT_EQ(info.inputs[0].location, 0u);
    EXPECT_EQ(info.inputs[1].name, "a_color");
    EXPECT_EQ(info.inputs[1].location, 1u);
    EXPECT_FALSE(info.inputs[1].active);
    EXPECT_EQ(info.inputs[2].name, "a_texCoord");
    EXPECT_EQ(info.inputs[2].location, 2u);
    EXPECT_TRUE(info.inputs[2].active);
    ASSERT_EQ(info.outputs.size(), 2u);
    EXPECT_EQ(info.outputs[0].name, "first");
    EXPECT_EQ(info.outputs[0].location, 0u);
    EXPECT_EQ(info.outputs[1].location, 1u);
}

TEST(ShaderCompiler, EntriesAreWrapped) {
    EffectBench bench;
    bench.effect(
        "CCEffect %{\n  techniques: [ { passes: [ { vert: 'vs:vert', frag: 'fs:frag' } ] } ]\n}%\n"
        "CCProgram vs %{\nvec4 vert() { return vec4(0.0); }\n}%\nCCProgram fs %{\nvec4 frag() { return vec4(1.0); "
        "}\n}%\n");
    const EffectVariant& variant = bench.get();
    EXPECT_EQ(variant.name, "e|vs:vert|fs:frag");
    ASSERT_EQ(variant.info.outputs.size(), 1u);
    EXPECT_EQ(variant.info.outputs[0].name, "cc_FragColor");
    EXPECT_EQ(variant.info.outputs[0].location, 0u);
}

TEST(ShaderCompiler, WordsAreSpirv15AndLocalSizeIsLiteral) {
    EffectBench bench;
    bench.effect(
        "CCEffect %{\n  techniques: [ { passes: [ { compute: cs } ] } ]\n}%\nCCProgram cs %{\nlayout(local_size_x = 8) "
        "in;\nvoid main() {}\n}%\n");
    const EffectVariant& variant = bench.get();
    ASSERT_GT(variant.compute.size(), 5u);
    EXPECT_EQ(variant.compute[0], 0x07230203u);
    EXPECT_EQ(variant.compute[1], 0x00010500u);
}

TEST(ShaderCompiler, GlslErrorsComeBackAtTheAuthorsLine) {
    EffectBench bench;
    bench.chunk("broken", "float helper(float x) {\n  return x + heigth;\n}\n");
    bench.fullscreen(std::string(kOut) +
                     "float height = 1.0;\n#include <broken>\nvoid main() { color = vec4(helper(height)); }\n");
    const Problem problem = bench.problem();
    EXPECT_EQ(problem.message, "GLSL: 'heigth': undeclared identifier");
    EXPECT_EQ(std::filesystem::path(problem.where.file).filename(), "broken.chunk");
    EXPECT_EQ(problem.where.line, 2);
    EXPECT_EQ(problem.where.column, 14);
    EXPECT_EQ(problem.where.length, 6);
    EXPECT_EQ(problem.help, "did you mean 'height'?");
    EXPECT_NE(formatProblem(problem).find("return x + heigth;"), std::string::npos);
}

/// The problem of a fragment program with these lines in front of and in main().
Problem problemOfLines(const std::string& before, const std::string& within) {
    EffectBench bench;
    bench.fullscreen(std::string(kOut) + before + "\nvoid main() {\n  color = vec4(1.0);\n  " + within + "\n}\n");
    return bench.problem();
}

TEST(ShaderCompiler, NamesThatGlslangGivesToOperationsAreKept) {
    const Problem undeclared = problemOfLines("float assing = 1.0;", "float x = assign;");
    EXPECT_EQ(undeclared.message, "GLSL: 'assign': undeclared identifier");
    EXPECT_EQ(undeclared.help, "did you mean 'assing'?");
    EXPECT_TRUE(problemOfLines("", "constructor(1.0);").message.starts_with("GLSL: 'constructor': no matching"));
    EXPECT_EQ(problemOfLines("", "float assign = 1.0; float assign = 2.0;").message, "GLSL: 'assign': redefinition");
    EXPECT_EQ(problemOfLines("", "color = vec3(1.0);").message, "GLSL: cannot convert from 'vec3' to 'vec4'");
    EXPECT_EQ(problemOfLines("", "color = vec4(vec2(1.0));").message,
              "GLSL: not enough data provided for construction");
}

TEST(ShaderCompiler, ConversionsOfStructsAndReturnValuesAreAdvisedUpon) {
    const Problem conversion = problemOfLines("struct S { float a; vec2 b; };", "S s; float g = s;");
    EXPECT_EQ(conversion.message, "GLSL: cannot convert from a struct to 'float'");
    EXPECT_NE(conversion.help.find("take the member you mean"), std::string::npos) << conversion.help;
    EXPECT_EQ(problemOfLines("", "float a[]; vec2 x = a;").message, "GLSL: cannot convert from 'float[]' to 'vec2'");
    EXPECT_EQ(problemOfLines("vec4 f() { return vec3(1.0); }", "").help,
              "return a value of the type that the function declares");
}

TEST(ShaderCompiler, ErrorsBehindIncludesAndInMacrosKeepTheirLine) {
    EffectBench bench;
    bench.chunk("long", "\n\n\n\n\n");
    bench.fullscreen(
        std::string("#pragma define-meta N range([1, 4])\n#include <long>\n#define TWICE(x) (x + x + missing)\n") +
        kOut + "void main() {\n  color = vec4(1.0);\n  color *= TWICE(float(N));\n}\n");
    const Problem problem = bench.problem();
    EXPECT_EQ(problem.where.file, bench.file());
    EXPECT_EQ(problem.where.line, 19);
    EXPECT_EQ(problem.message, "GLSL: 'missing': undeclared identifier");
}

TEST(ShaderCompiler, ErrorDirectivesSpeakForThemselves) {
    EffectBench bench;
    bench.fullscreen(
        std::string(kOut) +
        "#if BAD\n  #error BAD needs 'that': do this, or not.\n#endif\nvoid main() { color = vec4(1); }\n");
    EXPECT_EQ(bench.problem().message, "");
    const Problem problem = bench.problem({{"BAD", "1"}});
    EXPECT_EQ(problem.message, "#error BAD needs 'that': do this, or not.");
    EXPECT_EQ(problem.where.line, 15);
    EXPECT_EQ(problem.where.column, 3);
}

TEST(ShaderCompiler, LooseUniform) {
    EffectBench bench;
    bench.fullscreen(std::string(kOut) + "uniform float strength;\nvoid main() { color = vec4(strength); }\n");
    const Problem problem = bench.problem();
    EXPECT_EQ(problem.message, "uniform 'strength' stands outside a block");
    EXPECT_EQ(problem.where.line, 14);
    EXPECT_EQ(problem.where.column, 15);
    EXPECT_NE(problem.help.find("put it into a block"), std::string::npos);
}

TEST(ShaderCompiler, VaryingWithoutProducer) {
    EffectBench bench;
    bench.fullscreen(
        "in vec2 v_uvs;\nlayout(location = 0) out vec4 color;\nvoid main() { color = vec4(v_uvs, 0, 1); }\n");
    const Problem problem = bench.problem();
    EXPECT_EQ(problem.message, "fragment input 'v_uvs' is not written by the vertex program");
    EXPECT_EQ(problem.where.line, 12);
    EXPECT_NE(problem.help.find("did you mean 'v_uv'"), std::string::npos);
    bench.folder.write("effects/dead.effect", "");
    EffectBench dead;
    dead.fullscreen("in vec2 v_uvs;\nlayout(location = 0) out vec4 color;\nvoid main() { color = vec4(1); }\n");
    EXPECT_EQ(dead.problem().message, "");
}

TEST(ShaderCompiler, VaryingsOfDifferentTypes) {
    EffectBench bench;
    bench.fullscreen("in vec3 v_uv;\nlayout(location = 0) out vec4 color;\nvoid main() { color = vec4(v_uv, 1); }\n");
    const Problem problem = bench.problem();
    EXPECT_TRUE(problem.message.starts_with("GLSL: the stages do not fit together")) << problem.message;
    EXPECT_NE(problem.message.find("v_uv"), std::string::npos);
    EXPECT_EQ(problem.where.file, bench.file());
    EXPECT_EQ(problem.where.line, 12);
}

TEST(ShaderCompiler, ExplicitNumbersMustAgree) {
    const auto problemOf = [](const std::string& layout) {
        EffectBench bench;
        bench.fullscreen(std::string(kOut) + layout +
                         " uniform sampler2D cc_ssaoMap;\nvoid main() { color = texture(cc_ssaoMap, v_uv); }\n");
        return bench.problem();
    };
    EXPECT_EQ(problemOf("layout(set = 0, binding = 11)").message, "");
    EXPECT_EQ(problemOf("layout(binding = 11)").message, "");
    const Problem clash = problemOf("layout(set = 0, binding = 12)");
    EXPECT_EQ(clash.message,
              "'cc_ssaoMap' is declared with set 0, binding 12 (that place belongs to 'CCSsao'), but the pipeline "
              "gives it set 0, binding 11");
    EXPECT_EQ(clash.where.line, 14);
    EXPECT_EQ(problemOf("layout(set = 1)").message,
              "'cc_ssaoMap' is declared with set 1, but the pipeline gives it set 0, binding 11");
}

TEST(ShaderCompiler, ExplicitMaterialNumbersAreKeptAndClashesReported) {
    EffectBench bench;
    bench.fullscreen(std::string(kOut) +
                     "layout(set = 1, binding = 0) uniform sampler2D b;\nuniform sampler2D a;\nvoid main() { color = "
                     "texture(a, v_uv) + texture(b, v_uv); }\n");
    EXPECT_EQ(slotOf(bench.get(), "b"), (BindingSlot{1, 0}));
    EXPECT_EQ(slotOf(bench.get(), "a"), (BindingSlot{1, 1}));
    EffectBench clash;
    clash.fullscreen(
        std::string(kOut) +
        "layout(set = 1, binding = 3) uniform sampler2D b;\nlayout(set = 1, binding = 3) uniform sampler2D a;\n"
        "void main() { color = texture(a, v_uv) + texture(b, v_uv); }\n");
    EXPECT_EQ(clash.problem().message, "'a' and 'b' both have binding 3 of set 1");
}

TEST(ShaderCompiler, KindsThatAreNotBound) {
    EffectBench bench;
    bench.fullscreen(std::string(kOut) +
                     "layout(push_constant) uniform Push { vec4 p; };\nvoid main() { color = p; }\n");
    EXPECT_EQ(bench.problem().message, "'Push' is a push constant block, which Crevice does not bind");
    EffectBench split;
    split.fullscreen(
        std::string(kOut) +
        "uniform texture2D t;\nuniform sampler s;\nvoid main() { color = texture(sampler2D(t, s), v_uv); }\n");
    EXPECT_EQ(split.problem().message, "'t' is a texture without its sampler, which Crevice does not bind");
}

}  // namespace
}  // namespace crevice
