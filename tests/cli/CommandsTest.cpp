// What the commands without a device print, and their exit codes.
#include <cstring>

#include <nlohmann/json.hpp>

#include "CliTools.h"
#include "core/Image.h"

namespace crevice::cli {
namespace {

using nlohmann::json;

class CommandsTest : public CliTest {
protected:
    bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
};

constexpr const char* kBrokenEffect = R"(CCEffect %{
  techniques:
  - passes:
    - vert: fullscreen-vs
      frag: broken-fs
}%
CCProgram broken-fs %{
  precision highp float;
  in vec2 v_uv;
  layout(location = 0) out vec4 color;
  void main() { color = nothing; }
}%
)";

TEST_F(CommandsTest, ValidateTellsOfEachPipeline) {
    const Outcome good = run("validate ssao-deferred deferred -q");
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_TRUE(good.out.starts_with("ssao-deferred: ok, ")) << good.out;
    EXPECT_TRUE(has(good.out, "\ndeferred: ok, ")) << good.out;
    const Outcome mixed = run("validate nosuch deferred -q");
    EXPECT_EQ(mixed.code, 2);
    EXPECT_TRUE(mixed.out.starts_with("deferred: ok, ")) << mixed.out;
    EXPECT_TRUE(has(mixed.err, "no pipeline named 'nosuch'"));
}

TEST_F(CommandsTest, ValidateCompilesShadersAndNamesTheLine) {
    write("broken.effect", kBrokenEffect);
    write("own.pipeline.json",
          R"({"extends": "deferred", "edits": [{"set": "PostProcessStage", "effect": "broken.effect"}]})");
    const Outcome outcome = run("validate own.pipeline.json");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(has(outcome.err, "broken.effect:11:")) << outcome.err;
}

TEST_F(CommandsTest, FlattenResolvesOptions) {
    const Outcome kept = run("flatten ssao-deferred --option ssao=false");
    EXPECT_EQ(kept.code, 0) << kept.err;
    EXPECT_TRUE(has(kept.out, "\"$ssao\""));
    EXPECT_TRUE(has(kept.out, "// "));
    const Outcome resolved = run("flatten ssao-deferred --resolve --option ssao=false");
    EXPECT_EQ(resolved.code, 0) << resolved.err;
    EXPECT_FALSE(has(resolved.out, "\"$ssao\""));
    write("flat.pipeline.json", resolved.out);
    EXPECT_EQ(run("validate flat.pipeline.json -q").code, 0);
}

TEST_F(CommandsTest, PlanFollowsOptions) {
    const Outcome on = run("plan ssao-deferred");
    EXPECT_EQ(on.code, 0) << on.err;
    EXPECT_TRUE(has(on.out, "SsaoStage")) << on.out;
    EXPECT_TRUE(has(on.out, "cc_ssaoBlurMap 13")) << on.out;
    const Outcome off = run("plan ssao-deferred --option ssao=false -q");
    EXPECT_EQ(off.code, 0);
    EXPECT_TRUE(has(off.out, "Disabled: SsaoStage")) << off.out;
    EXPECT_FALSE(has(off.out, " 4 SsaoStage"));
    EXPECT_TRUE(has(on.out, " 4 SsaoStage"));
    EXPECT_TRUE(run("plan deferred --dot -q").out.starts_with("digraph"));
    EXPECT_TRUE(has(run("plan deferred crease --size 640x360 -q").out, "640×360"));
}

TEST_F(CommandsTest, StagesShowParameters) {
    const Outcome list = run("stages");
    EXPECT_EQ(list.code, 0);
    EXPECT_TRUE(has(list.out, "SsaoStage         12"));
    EXPECT_TRUE(has(run("stages SsaoStage").out, "seed       uint"));
    EXPECT_TRUE(has(run("stages --markdown").out, "## SsaoStage\n"));
    const json all = json::parse(run("stages --json").out);
    const auto ssao =
        std::find_if(all.begin(), all.end(), [](const json& stage) { return stage["class"] == "SsaoStage"; });
    ASSERT_NE(ssao, all.end());
    EXPECT_EQ((*ssao)["priority"], 12);
    EXPECT_EQ((*ssao)["params"][0]["key"], "seed");
    EXPECT_EQ((*ssao)["params"][0]["schema"]["minimum"], 0);
}

TEST_F(CommandsTest, SchemaGoesToAFileOrOut) {
    const Outcome out = run("schema");
    EXPECT_EQ(out.code, 0);
    EXPECT_TRUE(has(json::parse(out.out).dump(), "SsaoStage"));
    const Outcome file = run("schema -o pipeline.schema.json");
    EXPECT_EQ(file.out, "pipeline.schema.json\n");
    EXPECT_EQ(files(), std::vector<std::string>{"pipeline.schema.json"});
}

TEST_F(CommandsTest, EffectsAreListedAndShown) {
    EXPECT_TRUE(has(run("effects list").out, "\nssao "));
    EXPECT_EQ(run("effects").out, run("effects list").out);
    const Outcome show = run("effects show ssao -p ssao-deferred");
    EXPECT_EQ(show.code, 0) << show.err;
    EXPECT_TRUE(has(show.out, "SSAO_SAMPLES       64        1 … 64")) << show.out;
    EXPECT_TRUE(has(show.out, "CCSsao                uniform block  0    12")) << show.out;
}

TEST_F(CommandsTest, EffectsCompileTellsYesAndNo) {
    write("broken.effect", kBrokenEffect);
    const Outcome good = run("effects compile copy vignette");
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_TRUE(has(good.out, "ok     copy technique 0 pass 0 (default)"));
    EXPECT_TRUE(has(good.out, "2 compiled, 0 failed; 2 effects\n"));
    const Outcome bad = run("effects compile broken.effect copy");
    EXPECT_EQ(bad.code, 1);
    EXPECT_TRUE(has(bad.out, "FAILED broken.effect technique 0 pass 0"));
    EXPECT_TRUE(has(bad.out, "1 compiled, 1 failed; 2 effects\n"));
    EXPECT_TRUE(has(bad.err, "broken.effect:11:")) << bad.err;
    const json results = json::parse(run("effects compile broken.effect copy --json -q").out);
    EXPECT_EQ(results[0]["ok"], false);
    EXPECT_EQ(results[1]["ok"], true);
    EXPECT_GT(results[1]["bytes"]["fragment"], 0);
}

TEST_F(CommandsTest, EffectsCompileTakesMacros) {
    const json all = json::parse(run("effects compile ssao-blur --all-variants --json").out);
    EXPECT_EQ(all.size(), 2u);  // two ends of BLUR_AXIS
    const json given = json::parse(run("effects compile ssao-blur --define BLUR_AXIS=1 --all-variants --json").out);
    ASSERT_EQ(given.size(), 1u);
    EXPECT_EQ(given[0]["defines"]["BLUR_AXIS"], "1");
    EXPECT_TRUE(has(run("effects compile copy --text").out, "#version 450"));
}

TEST_F(CommandsTest, EffectsCompileVariesNoMacroThatAPassEmbeds) {
    std::filesystem::create_directories(path("game/assets"));
    write("game/package.json", "{}");
    write("game/assets/e.effect",
          "CCEffect %{\n  techniques:\n  - passes:\n    - { vert: 'vs:vert', frag: 'fs:frag' }\n"
          "    - { vert: 'vs:vert', frag: 'fs:frag', embeddedMacros: { NUM: 2 } }\n}%\n"
          "CCProgram vs %{\n  vec4 vert() { return vec4(1.0); }\n}%\n"
          "CCProgram fs %{\n  #pragma define-meta NUM range([0, 3])\n  vec4 frag() {\n    #if NUM == 2\n"
          "    return vec4(2.0);\n    #endif\n    #if ON\n    return vec4(1.0);\n    #endif\n"
          "    return vec4(0.0);\n  }\n}%\n");
    const Outcome outcome = run("effects compile game --all-variants");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    // NUM's two ends times ON's two values in pass 0, ON's two alone in pass 1.
    EXPECT_TRUE(has(outcome.out, "6 compiled, 0 failed")) << outcome.out;
    EXPECT_TRUE(has(outcome.out, "NUM=3")) << outcome.out;
}

TEST_F(CommandsTest, EffectsCompileFindsTheCocosProjectAboveAPath) {
    std::filesystem::create_directories(path("game/assets/chunks"));
    std::filesystem::create_directories(path("game/assets/effects"));
    write("game/package.json", "{}");
    write("game/assets/chunks/half.chunk", "vec4 half4() { return vec4(0.5); }\n");
    write("game/assets/effects/grey.effect",
          "CCEffect %{\n  techniques:\n  - passes:\n    - { vert: 'vs:vert', frag: 'fs:frag' }\n}%\n"
          "CCProgram vs %{\n  in vec3 a_position;\n  vec4 vert() { return vec4(a_position, 1.0); }\n}%\n"
          "CCProgram fs %{\n  #include <half>\n  vec4 frag() { return half4(); }\n}%\n");
    for (const char* word : {"game", "game/assets/effects", "game/assets/effects/grey.effect"}) {
        const Outcome outcome = run(std::string("effects compile ") + word);
        EXPECT_EQ(outcome.code, 0) << word << outcome.err;
        EXPECT_TRUE(has(outcome.out, "1 compiled, 0 failed")) << outcome.out;
    }
}

TEST_F(CommandsTest, EffectsCompileReadsCocosFolders) {
    const std::string assets = "engine/editor/assets/";
    std::filesystem::create_directories(path(assets + "effects"));
    std::filesystem::create_directories(path(assets + "chunks"));
    write(assets + "chunks/common.chunk", "vec4 half4() { return vec4(0.5); }\n");
    write(assets + "effects/good.effect",
          "CCEffect %{\n  techniques:\n  - passes: [ { vert: vs:vert, frag: fs:frag } ]\n}%\n"
          "CCProgram vs %{\n  #include <common>\n  #if USE_PLACE\n    in vec4 a_place;\n  #endif\n"
          "  vec4 vert () { return half4(); }\n}%\n"
          "CCProgram fs %{\n  uniform sampler2D map;\n  #if USE_OTHER\n    in vec4 v_missing;\n  #endif\n  vec4 frag "
          "() {\n  #if USE_PLACE\n    return v_missing;\n"
          "  #endif\n    return texture(map, vec2(0.5)); }\n}%\n");
    const Outcome good = run("effects compile --engine engine --define UNKNOWN=1");
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_TRUE(has(good.out, "1 compiled, 0 failed; 1 effect\n")) << good.out;
    std::filesystem::create_directories(path(assets + "default_file_content/effect"));
    write(
        assets + "default_file_content/effect/new.effect",
        "CCEffect %{\n  techniques:\n  - passes: [ { vert: vs, frag: vs } ]\n}%\nCCProgram vs %{ void main() {} }%\n");
    const Outcome withTemplates = run("effects compile --engine engine");
    EXPECT_TRUE(has(withTemplates.out, "2 compiled, 0 failed; 2 effects\n")) << withTemplates.out << withTemplates.err;
    const Outcome bad = run("effects compile engine/editor/assets/effects --engine engine --define USE_PLACE=1");
    EXPECT_EQ(bad.code, 1);
    EXPECT_TRUE(has(bad.out, "FAILED ")) << bad.out;
    EXPECT_TRUE(has(bad.out, ": not declared: v_missing with USE_PLACE (but good.effect:15 with USE_OTHER)\n"))
        << bad.out;
    EXPECT_TRUE(has(bad.out, "0 compiled, 1 failed, 1 of them use what their source does not declare; 1 effect\n"))
        << bad.out;
    EXPECT_TRUE(has(bad.err, "good.effect:19:")) << bad.err;
    const json missing = json::parse(run("effects compile good --engine engine --define USE_PLACE=1 --json").out);
    EXPECT_EQ(missing["passes"][0]["undeclared"][0]["name"], "v_missing");
    EXPECT_EQ(missing["passes"][0]["undeclared"][0]["with"], json::array({"USE_PLACE"}));
    const json all = json::parse(run("effects compile good --engine engine --json -q").out);
    EXPECT_EQ(all["compiled"], 1);
    const json& shader = all["effects"][0]["shaders"][0];
    EXPECT_EQ(shader["name"], "good|vs:vert|fs:frag");
    EXPECT_EQ(shader["attributes"],
              json::parse(R"([{"name":"a_place","defines":["USE_PLACE"],"format":44,"location":0}])"));
    EXPECT_EQ(shader["samplerTextures"][0]["binding"], 0);
    EXPECT_EQ(run("effects compile good --engine nowhere").code, 2);
}

TEST_F(CommandsTest, InfoDescribesScenes) {
    const Outcome scene = run("info default");
    EXPECT_EQ(scene.code, 0) << scene.err;
    for (const char* word : {"meshes", "triangles", "materials", "lights", "0 'walk'", "auto radius", "exposure"}) {
        EXPECT_TRUE(has(scene.out, word)) << word;
    }
    const Outcome devices = run("info");
    EXPECT_EQ(devices.code, 0) << devices.err;
    EXPECT_TRUE(has(devices.out, "R11G11B10F"));
}

TEST_F(CommandsTest, CompareMeasures) {
    Image a(2, 1, Format::RGBA8), b(2, 1, Format::RGBA8);
    for (Image* image : {&a, &b}) {
        for (std::uint32_t x = 0; x < 2; ++x) image->pixel(x, 0)[3] = std::byte{255};
    }
    b.pixel(1, 0)[0] = std::byte{51};  // 0.2 in one of six values
    writeImage(path("a.png"), a);
    writeImage(path("b.png"), b);
    writeImage(path("wide.png"), Image(3, 1, Format::RGBA8));
    const Outcome equal = run("compare a.png a.png");
    EXPECT_EQ(equal.code, 0);
    EXPECT_EQ(equal.out, "rmse      0\nmax       0\nmean abs  r 0  g 0  b 0\npsnr      infinite\n");
    const Outcome different = run("compare a.png b.png --heat heat.png");
    EXPECT_EQ(different.code, 1);
    EXPECT_EQ(different.out,
              "rmse      0.0816497\nmax       0.2\nmean abs  r 0.1  g 0  b 0\npsnr      21.76 dB\nheat.png\n");
    const Image heat = readImage(path("heat.png"));
    EXPECT_EQ(heat.at(0, 0), glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(heat.at(1, 0), glm::vec4(1, 1, 1, 1));
    EXPECT_EQ(run("compare a.png b.png --rmse 0.09").code, 0);
    EXPECT_EQ(run("compare a.png b.png --rmse 0.08").code, 1);
    EXPECT_EQ(run("compare a.png b.png --rmse 0.09 --max 0.1").code, 1);
    EXPECT_EQ(run("compare a.png b.png --max 0.21").code, 0);
    expectRefused("compare a.png wide.png", "the sizes differ: 'a.png' is 2x1, 'wide.png' is 3x1", "same --size", 1);
    EXPECT_EQ(run("compare a.png gone.png").code, 2);
}

TEST_F(CommandsTest, CompareCountsTheChannelsOfTheFiles) {
    Image a(2, 1, Format::R32F), b(2, 1, Format::R32F), wide(2, 1, Format::RG32F);
    const float half = 0.5f;
    std::memcpy(b.pixel(1, 0), &half, sizeof half);
    std::memcpy(wide.pixel(1, 0), &half, sizeof half);
    writeImage(path("a.exr"), a);
    writeImage(path("b.exr"), b);
    writeImage(path("wide.exr"), wide);
    EXPECT_EQ(run("compare a.exr b.exr").out,
              "rmse      0.353553\nmax       0.5\nmean abs  r 0.25\npsnr      9.03 dB\n");
    EXPECT_EQ(run("compare a.exr wide.exr").out,
              "rmse      0.25\nmax       0.5\nmean abs  r 0.25  g 0\npsnr      12.04 dB\n");
    EXPECT_EQ(run("compare b.exr b.exr").code, 0);
}

TEST_F(CommandsTest, AClosedPipeIsNoFailureAFullDiskIs) {
    const Outcome closed = runWith({"schema"}, Stream::ClosedPipe, Stream::Read);
    EXPECT_EQ(closed.code, 0);
    EXPECT_EQ(closed.err, "");
    for (const char* command : {"schema", "--version"}) {
        const Outcome full = runWith({command}, Stream::FullDisk, Stream::Read);
        EXPECT_EQ(full.code, 1) << command;
        EXPECT_TRUE(has(full.err, "error: the results cannot be written")) << full.err;
    }
}

}  // namespace
}  // namespace crevice::cli
