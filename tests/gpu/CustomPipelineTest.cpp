// What users add without C++: pipelines in JSON, compute effects, mip levels, and effects that take matrices from
// CCLocal.
#include "FrameFixture.h"

namespace crevice {
namespace {

using testing::Contains;

class CustomPipeline : public FrameTest {
protected:
    void writeCompute(const std::string& name, const std::string& declarations, const std::string& body) const {
        writeEffect(name,
                    "CCEffect %{\n  techniques:\n  - passes:\n    - compute: test-cs\n}%\nCCProgram test-cs %{\n"
                    "  layout(local_size_x = 8, local_size_y = 4) in;\n" +
                        declarations + "\n  void main() {\n    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);\n" +
                        body + "\n  }\n}%\n");
    }
    static Scene anyScene() {
        Scene scene = darkScene();
        addWall(scene, 1);
        return scene;
    }
    std::vector<std::string> readsOf(const std::string& stage) const {
        std::vector<std::string> names;
        for (const StageUse& use : renderer_->pipeline().program().plan().uses) {
            if (use.stage != stage) continue;
            for (const TargetRead& read : use.reads) names.push_back(read.target);
        }
        return names;
    }
    static glm::ivec4 bytesAt(const Image& image, std::uint32_t x, std::uint32_t y) {
        const std::byte* p = image.pixel(x, y);
        return {int(p[0]), int(p[1]), int(p[2]), int(p[3])};
    }
};

constexpr const char* kTwoRadii = R"({
  "name": "two-radii", "extends": "deferred",
  "targets": {
    "aoSmall": { "format": "R8", "clear": [1, 1, 1, 1] },
    "aoLarge": { "format": "R8", "clear": [1, 1, 1, 1] },
    "cc_ssaoBlurMap": { "format": "R8", "binding": 13, "clear": [1, 1, 1, 1] }
  },
  "blocks": { "CCSsao": { "binding": 12 } },
  "edits": [
    { "insert": { "stage": "SsaoStage", "name": "AoSmall", "params": { "seed": 3 }, "material": { "radius": 0.15 }, "writes": ["aoSmall"] },
      "before": "LightingStage" },
    { "insert": { "stage": "SsaoStage", "name": "AoLarge", "params": { "seed": 5 }, "material": { "radius": 0.9 }, "writes": ["aoLarge"] },
      "after": "AoSmall" },
    { "insert": { "stage": "FullscreenStage", "name": "AoMin", "effect": "min-ao",
                  "reads": { "aoA": "aoSmall", "aoB": "aoLarge" }, "writes": ["cc_ssaoBlurMap"] },
      "after": "AoLarge" },
    { "set": "LightingStage", "effect": "ssao-lighting" }
  ]
})";

TEST_F(CustomPipeline, TwoOcclusionMapsAreJoinedByJsonAlone) {
    renderer_->setScene(shippedScene("crease"));
    View view = sized(160, 90);
    load("deferred");
    const Image without = renderer_->render(view);
    std::vector<Image> alone;
    for (const auto& [seed, radius] : {std::pair("3", "0.15"), std::pair("5", "0.9")}) {
        load(
            "ao-only", {{"view", "raw"}},
            {{.path = "SsaoStage.params.seed", .value = seed}, {.path = "SsaoStage.material.radius", .value = radius}});
        alone.push_back(target(view, "cc_ssaoMap"));
    }
    loadDocument(kTwoRadii);
    EXPECT_THAT(readsOf("LightingStage"), Contains("cc_ssaoBlurMap"));
    view.keep = {"aoSmall", "aoLarge", "cc_ssaoBlurMap"};
    const Image picture = renderer_->render(view);
    const Image small = renderer_->target("aoSmall");
    const Image large = renderer_->target("aoLarge");
    const Image joined = renderer_->target("cc_ssaoBlurMap");
    // Both stages fill the same block of set 0, each for its own draw.
    EXPECT_EQ(small, alone[0]);
    EXPECT_EQ(large, alone[1]);
    EXPECT_NE(small, large);
    Image least = small;
    int fromSmall = 0;
    for (std::size_t i = 0; i < least.pixels.size(); ++i) {
        fromSmall += small.pixels[i] < large.pixels[i];
        least.pixels[i] = std::min(small.pixels[i], large.pixels[i]);
    }
    EXPECT_EQ(joined, least);
    EXPECT_GT(fromSmall, 0);
    EXPECT_NE(picture, without);
}

TEST_F(CustomPipeline, AComputeStageWritesEveryTexelOnce) {
    writeCompute("pattern", "layout(rgba8) uniform writeonly image2D image;",
                 "    imageStore(image, texel, vec4(float(texel.x), float(texel.y), 7.0, 255.0) / 255.0);");
    renderer_->setScene(anyScene());
    loadDocument(R"({ "name": "compute", "output": "out",
      "targets": { "image": { "format": "RGBA8" }, "out": { "format": "RGBA8" } },
      "flows": [ { "flow": "F", "stages": [
        { "stage": "ComputeStage", "name": "Fill", "effect": "pattern", "writes": ["image"] },
        { "stage": "FullscreenStage", "name": "Show", "effect": "copy", "reads": { "inputMap": "image" }, "writes": ["out"] }
      ] } ] })");
    for (const glm::uvec2 size : {glm::uvec2(8, 4), glm::uvec2(19, 13), glm::uvec2(1, 1)}) {
        const Image image = renderer_->render(sized(size.x, size.y));
        for (std::uint32_t y = 0; y < size.y; ++y)
            for (std::uint32_t x = 0; x < size.x; ++x) EXPECT_EQ(bytesAt(image, x, y), glm::ivec4(x, y, 7, 255));
    }
}

TEST_F(CustomPipeline, ComputeReadsWhatWasDrawnAndDrawsReadWhatWasComputed) {
    writeFragment("ramp", "", "result = vec4(floor(gl_FragCoord.xy), 0.0, 255.0) / 255.0;");
    // Each texel takes its mirror image's value: every thread reads what another part of the frame wrote.
    writeCompute("mirror", "layout(rgba8) uniform writeonly image2D image;\n  uniform sampler2D source;",
                 "    ivec2 last = textureSize(source, 0) - 1;\n"
                 "    if (texel.x <= last.x) imageStore(image, texel, texelFetch(source, last - texel, 0));");
    renderer_->setScene(anyScene());
    loadDocument(R"({ "name": "mirror", "output": "out",
      "targets": { "source": { "format": "RGBA8" }, "image": { "format": "RGBA8" }, "out": { "format": "RGBA8" } },
      "flows": [ { "flow": "F", "stages": [
        { "stage": "FullscreenStage", "name": "Draw", "effect": "ramp", "writes": ["source"] },
        { "stage": "ComputeStage", "name": "Mirror", "effect": "mirror", "writes": ["image"] },
        { "stage": "FullscreenStage", "name": "Show", "effect": "copy", "reads": { "inputMap": "image" }, "writes": ["out"] }
      ] } ] })");
    const Image image = renderer_->render(sized(21, 10));
    for (std::uint32_t y = 0; y < 10; ++y)
        for (std::uint32_t x = 0; x < 21; ++x) EXPECT_EQ(bytesAt(image, x, y), glm::ivec4(20 - x, 9 - y, 0, 255));
}

TEST_F(CustomPipeline, MipLevelsAreWiredByNameAndNumber) {
    writeCompute("base", "layout(rgba8) uniform writeonly image2D image;",
                 "    imageStore(image, texel, vec4(float(texel.x), float(texel.y), 0.0, 255.0) / 255.0);");
    // Keeps the lower right of each 2 x 2: (2x + 1, 2y + 1).
    writeCompute("halve",
                 "layout(rgba8) uniform readonly image2D fine;\n  layout(rgba8) uniform writeonly image2D coarse;",
                 "    imageStore(coarse, texel, imageLoad(fine, texel * 2 + 1));");
    writeFragment("pick", "uniform sampler2D level;", "result = texelFetch(level, ivec2(gl_FragCoord.xy), 0);");
    renderer_->setScene(anyScene());
    loadDocument(R"({ "name": "mips", "output": "out",
      "targets": { "pyramid": { "format": "RGBA8", "mips": 3 }, "out": { "format": "RGBA8", "scale": 0.25 } },
      "flows": [ { "flow": "F", "stages": [
        { "stage": "ComputeStage", "name": "Base", "effect": "base", "writes": ["pyramid@0"] },
        { "stage": "ComputeStage", "name": "Half", "effect": "halve", "reads": { "fine": "pyramid@0" }, "writes": ["pyramid@1"] },
        { "stage": "ComputeStage", "name": "Quarter", "effect": "halve", "reads": { "fine": "pyramid@1" }, "writes": ["pyramid@2"] },
        { "stage": "FullscreenStage", "name": "Show", "effect": "pick", "reads": { "level": "pyramid@2" }, "writes": ["out"] }
      ] } ] })");
    const Image image = renderer_->render(sized(32, 16));
    ASSERT_EQ(image.width, 8u);
    ASSERT_EQ(image.height, 4u);
    for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) EXPECT_EQ(bytesAt(image, x, y), glm::ivec4(4 * x + 3, 4 * y + 3, 0, 255));
}

TEST_F(CustomPipeline, AFullscreenStageDrawsIntoOneLevel) {
    writeFragment("shade", "uniform Properties { vec4 color; };", "result = color;");
    std::string text = readText(folder_ / "effects" / "shade.effect");
    text.replace(text.find("      rasterizerState"), 0, "      properties:\n        color: { value: [0, 0, 0, 1] }\n");
    writeEffect("shade", text);
    writeFragment("pick", "uniform sampler2D fine;\n  uniform sampler2D coarse;",
                  "result = vec4(texelFetch(fine, ivec2(0), 0).r, texelFetch(coarse, ivec2(1, 0), 0).r, 0.0, 1.0);");
    renderer_->setScene(anyScene());
    loadDocument(R"({ "name": "levels", "output": "out",
      "targets": { "two": { "format": "RGBA8", "mips": 2 }, "out": { "format": "RGBA8" } },
      "flows": [ { "flow": "F", "stages": [
        { "stage": "FullscreenStage", "name": "Fine", "effect": "shade", "material": { "color": [1, 0, 0, 1] }, "writes": ["two"] },
        { "stage": "FullscreenStage", "name": "Coarse", "effect": "shade", "material": { "color": [0.2, 0, 0, 1] }, "writes": ["two@1"] },
        { "stage": "FullscreenStage", "name": "Show", "effect": "pick", "reads": { "fine": "two@0", "coarse": "two@1" }, "writes": ["out"] }
      ] } ] })");
    const Image image = renderer_->render(sized(6, 6));
    EXPECT_EQ(bytesAt(image, 3, 3), glm::ivec4(255, 51, 0, 255));
}

/// A copy of a shipped file below the asset root with texts replaced.
std::string edited(std::string text, const std::vector<std::pair<std::string, std::string>>& edits) {
    for (const auto& [from, to] : edits) {
        EXPECT_NE(text.find(from), std::string::npos) << from;
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
    }
    return text;
}

TEST_F(CustomPipeline, EffectsThatTakeTheMatrixFromCCLocalDrawTheSamePicture) {
    const AssetRoots shipped = AssetRoots::standard();
    writeFileAtomically(folder_ / "effects/chunks/local-instance.chunk",
                        "#include <cc-local>\n"
                        "vec3 instancePositionWorld(vec3 p) { return (cc_matWorld * vec4(p, 1.0)).xyz; }\n"
                        "vec3 instanceDirectionWorld(vec3 d) { return mat3(cc_matWorld) * d; }\n"
                        "vec3 instanceNormalWorld(vec3 n) { return mat3(cc_matWorldIT) * n; }\n"
                        "float instanceHandedness() { return determinant(mat3(cc_matWorld)) < 0.0 ? -1.0 : 1.0; }\n");
    writeFileAtomically(folder_ / "effects/chunks/local-varyings-vs.chunk",
                        edited(readText(*shipped.find(AssetKind::Chunk, "standard-varyings-vs")),
                               {{"<instance>", "<local-instance>"}}));
    writeEffect("local-standard",
                edited(readText(*shipped.find(AssetKind::Effect, "standard")),
                       {{"<standard-varyings-vs>", "<local-varyings-vs>"}, {"<instance>", "<local-instance>"}}));
    Scene scene = shippedScene("crease");
    // One mirrored and unevenly scaled object more, and a blended one.
    addObject(scene, makeBox({0.5f, 0.25f, 0.75f}),
              glm::scale(glm::rotate(glm::translate(glm::mat4(1), {1.2f, 1.4f, -0.4f}), 0.6f, glm::vec3(0.6f, 0.8f, 0)),
                         glm::vec3(-1, 2, 0.5f)),
              1);
    SceneMaterial glass;
    glass.alphaMode = AlphaMode::Blend;
    glass.baseColor.a = 0.5f;
    scene.materials.push_back(glass);
    addWall(scene, 0.5f, {0, 1, 0.5f}, static_cast<int>(scene.materials.size()) - 1);
    renderer_->setScene(scene);
    for (const char* pipeline : {"deferred", "forward"}) {
        const Options options = std::string(pipeline) == "deferred" ? Options{{"fxaa", "false"}} : Options{};
        load(pipeline, options);
        const Image instanced = renderer_->render(sized(160, 90));
        Sets sets = {{.path = "ShadowStage.effect", .value = "local-standard"},
                     {.path = "TransparentStage.effect", .value = "local-standard"}};
        const bool deferred = std::string(pipeline) == "deferred";
        sets.push_back({.path = deferred ? "GbufferStage.effect" : "ForwardStage.effect", .value = "local-standard"});
        load(pipeline, options, sets);
        const Image local = renderer_->render(sized(160, 90));
        EXPECT_EQ(renderer_->render(sized(160, 90)), local) << pipeline;
        // The same sums in another order: last bits move an edge here and there.
        int differing = 0;
        for (std::size_t i = 0; i < local.pixels.size(); ++i)
            differing += std::abs(int(local.pixels[i]) - int(instanced.pixels[i])) > 1;
        EXPECT_LE(differing, 20) << pipeline;
    }
}

}  // namespace
}  // namespace crevice
