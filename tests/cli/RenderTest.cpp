// `crevice render`: which files it writes, and that options change the picture as they say.
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "CliTools.h"
#include "core/Image.h"

namespace crevice::cli {
namespace {

using Names = std::vector<std::string>;

/// A box that floats in nothing: no sky, so that the background shows.
constexpr const char* kBoxScene = R"({
  "objects": [ { "primitive": "box", "size": [1, 1, 1] } ],
  "cameras": [ { "name": "front", "eye": [0, 0, 3], "target": [0, 0, 0] },
               { "name": "side", "eye": [4, 2, 0], "target": [0, 0, 0] } ]
})";

class RenderTest : public CliTest {
protected:
    /// Runs and expects success and exactly these lines on stdout.
    void expectWritten(const std::string& arguments, const Names& paths) {
        SCOPED_TRACE("crevice " + arguments);
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        std::string expected;
        for (const std::string& written : paths) expected += written + "\n";
        EXPECT_EQ(outcome.out, expected);
        for (const std::string& written : paths) EXPECT_TRUE(std::filesystem::exists(path(written))) << written;
    }
    Image picture(const std::string& name) { return readImage(path(name)); }
};

TEST_F(RenderTest, WritesOnePicture) {
    expectWritten("render crease -o a.png --size 40x30", {"a.png"});
    EXPECT_EQ(files(), Names{"a.png"});
    EXPECT_EQ(picture("a.png").width, 40u);
    EXPECT_EQ(picture("a.png").height, 30u);
}

TEST_F(RenderTest, TheSameCommandGivesTheSameBytes) {
    ASSERT_EQ(run("render crease -o a.png --size 64x48").code, 0);
    ASSERT_EQ(run("render crease -o b.png --size 64x48 --no-cache").code, 0);
    EXPECT_EQ(picture("a.png"), picture("b.png"));
}

TEST_F(RenderTest, SeveralScenesGoToAFolder) {
    std::filesystem::create_directory(path("out"));
    write("box.scene.json", kBoxScene);
    expectWritten("render crease box.scene.json -o out/ --size 16x16 -q", {"out/crease.png", "out/box.png"});
    expectWritten("render crease -o out --size 16x16", {"out/crease.png"});
    EXPECT_EQ(files(), (Names{"box.scene.json", "out/box.png", "out/crease.png"}));
}

TEST_F(RenderTest, FramesAreNumberedOrTheLastIsWritten) {
    expectWritten("render crease -o f-%04d.png --frames 3 --size 16x16", {"f-0000.png", "f-0001.png", "f-0002.png"});
    expectWritten("render crease -o g%d.png --frames 2 --size 16x16", {"g0.png", "g1.png"});
    expectWritten("render crease -o last.png --frames 3 --size 16x16", {"last.png"});
    EXPECT_EQ(picture("last.png"), picture("f-0002.png"));
}

TEST_F(RenderTest, DumpsTargetsAsPngAndExr) {
    write("box.scene.json", kBoxScene);
    expectWritten(
        "render box.scene.json -q -o a.png --size 32x32 --near 1 --far 10 --dump viewDepth=z.png --dump "
        "viewDepth=z.exr "
        "--dump depth=d.png --dump cc_gbuffer_normalMap=n.png --dump cc_gbuffer_normalMap=n.exr --dump "
        "cc_ssaoMap=ao.png",
        {"a.png", "z.png", "z.exr", "d.png", "n.png", "n.exr", "ao.png"});
    const std::uint32_t c = 16;
    EXPECT_NEAR(picture("z.exr").at(c, c).r, 2.5f, 1e-4f);           // 3 away, less half the box
    EXPECT_NEAR(picture("z.png").at(c, c).r, 0.25f, 0.5f / 255.0f);  // by far
    EXPECT_NEAR(picture("d.png").at(c, c).r, 0.25f, 1.0f / 255.0f);  // the same from the depth buffer
    EXPECT_EQ(picture("z.png").at(0, 0).r, 1.0f);                    // nothing there
    const glm::vec4 normal = picture("n.exr").at(c, c);
    EXPECT_NEAR(normal.z, 1.0f, 1e-3f);
    EXPECT_NEAR(picture("n.png").at(c, c).z, 1.0f, 0.01f);  // faces the camera; no value is negative in this view
    EXPECT_EQ(picture("ao.png").at(0, 0).r, 1.0f);          // the sky is open
}

TEST_F(RenderTest, DumpsSignedValuesAroundGrey) {
    write("box.scene.json", kBoxScene);
    ASSERT_EQ(run("render box.scene.json -q -o a.png --size 32x32 --eye -3,0,0 --dump cc_gbuffer_normalMap=n.png").code,
              0);
    const glm::vec4 normal = picture("n.png").at(16, 16);  // (-1, 0, 0)
    EXPECT_NEAR(normal.x, 0.0f, 0.01f);
    EXPECT_NEAR(normal.y, 0.5f, 0.01f);
    EXPECT_NEAR(normal.z, 0.5f, 0.01f);
}

TEST_F(RenderTest, TheBackgroundShowsWhereNothingIs) {
    write("box.scene.json", kBoxScene);
    const std::string render = "render box.scene.json -q --size 16x16 -o ";
    ASSERT_EQ(run(render + "none.png").code, 0);
    ASSERT_EQ(run(render + "clear.png --background transparent").code, 0);
    ASSERT_EQ(run(render + "orange.png --background #ff8000").code, 0);
    ASSERT_EQ(run(render + "floats.png --background 1,0.5,0").code, 0);
    EXPECT_EQ(picture("none.png").at(0, 0), glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(picture("clear.png").at(0, 0).a, 0.0f);
    EXPECT_EQ(picture("clear.png").at(8, 8).a, 1.0f);
    EXPECT_EQ(picture("orange.png").at(0, 0), glm::vec4(255, 128, 0, 255) / 255.0f);
    EXPECT_EQ(picture("floats.png").at(0, 0), glm::vec4(255, 128, 0, 255) / 255.0f);
}

TEST_F(RenderTest, CamerasAreChosenByNameIndexAndPlace) {
    write("box.scene.json", kBoxScene);
    const std::string render = "render box.scene.json -q --size 24x24 -o ";
    ASSERT_EQ(run(render + "first.png").code, 0);
    ASSERT_EQ(run(render + "front.png --camera front").code, 0);
    ASSERT_EQ(run(render + "side.png --camera side").code, 0);
    ASSERT_EQ(run(render + "one.png --camera 1").code, 0);
    ASSERT_EQ(run(render + "eye.png --eye 4,2,0 --target 0,0,0").code, 0);
    ASSERT_EQ(run(render + "minus.png --eye -4,.5,-.5").code, 0);
    ASSERT_EQ(run(render + "ortho.png --ortho 4").code, 0);
    EXPECT_EQ(picture("first.png"), picture("front.png"));
    EXPECT_EQ(picture("side.png"), picture("one.png"));
    EXPECT_EQ(picture("side.png"), picture("eye.png"));
    EXPECT_NE(picture("first.png"), picture("side.png"));
    EXPECT_NE(picture("minus.png"), picture("side.png"));
    EXPECT_NE(picture("ortho.png"), picture("first.png"));
}

TEST_F(RenderTest, SeedOptionAndSetChangeThePicture) {
    const std::string render = "render crease --size 48x48 -o x.png ";
    ASSERT_EQ(run(render + "--seed 3 --dump cc_ssaoMap=seed.png").code, 0);
    ASSERT_EQ(run(render + "--set SsaoStage.params.seed=3 --dump cc_ssaoMap=set.png").code, 0);
    ASSERT_EQ(run(render + "--seed 4 --dump cc_ssaoMap=other.png").code, 0);
    ASSERT_EQ(run(render + "--seed 4 --set SsaoStage.seed=3 --dump cc_ssaoMap=wins.png").code, 0);
    EXPECT_EQ(picture("seed.png"), picture("set.png"));
    EXPECT_NE(picture("seed.png"), picture("other.png"));
    EXPECT_EQ(picture("seed.png"), picture("wins.png"));
    ASSERT_EQ(run("render crease --size 48x48 -o off.png --option ssao=false").code, 0);
    ASSERT_EQ(run("render crease --size 48x48 -o deferred.png -p deferred").code, 0);
    EXPECT_EQ(picture("off.png"), picture("deferred.png"));
}

TEST_F(RenderTest, TimingsNameStagesAndSteps) {
    expectWritten("render crease -o a.png --size 32x16 --frames 2 --timings t.json", {"a.png", "t.json"});
    std::ifstream file(path("t.json"));
    const nlohmann::json times = nlohmann::json::parse(file);
    EXPECT_EQ(times["pixels"], 512);
    EXPECT_GT(times["frame_ms"], 0.0);
    EXPECT_EQ(times["frames_ms"].size(), 2u);
    double sum = 0;
    bool ssao = false;
    for (const auto& stage : times["stages"]) {
        sum += stage["ms"].get<double>();
        ssao = ssao || (stage["stage"] == "SsaoStage" && stage["flow"] == "LightingFlow");
    }
    EXPECT_TRUE(ssao);
    EXPECT_NEAR(sum, times["frame_ms"].get<double>(), 1e-3);
    for (const char* step : {"load_ms", "compile_ms", "prepare_ms", "render_ms", "write_ms"}) {
        EXPECT_GT(times["process"][step], 0.0) << step;
    }
}

TEST_F(RenderTest, VerboseTellsQuietDoesNot) {
    write("dark.scene.json", R"({ "objects": [ { "primitive": "box" } ] })");
    const Outcome verbose = run("render dark.scene.json -o a.png --size 16x16 -v");
    EXPECT_NE(verbose.err.find("auto radius"), std::string::npos) << verbose.err;
    EXPECT_NE(verbose.err.find("exposure"), std::string::npos);
    EXPECT_NE(verbose.err.find("note: the scene has no lights"), std::string::npos);
    const Outcome normal = run("render dark.scene.json -o a.png --size 16x16");
    EXPECT_EQ(normal.err.find("auto radius"), std::string::npos);
    EXPECT_NE(normal.err.find("note: the scene has no lights"), std::string::npos);
    EXPECT_EQ(run("render dark.scene.json -o a.png --size 16x16 -q").err, "");
    EXPECT_EQ(run("render dark.scene.json -o b.png --size 16x16 --no-default-light").err, "");
    EXPECT_NE(picture("a.png"), picture("b.png"));
}

TEST_F(RenderTest, ProgressIsForTerminalsOnly) {
    const Names arguments = splitWords("render crease -o a.png --size 16x16 --frames 2");
    const Outcome terminal = runWith(arguments, Stream::Read, Stream::Terminal);
    EXPECT_EQ(terminal.code, 0);
    EXPECT_NE(terminal.err.find("frame 2/2"), std::string::npos) << terminal.err;
    EXPECT_TRUE(terminal.err.ends_with("\r\033[K")) << "the line is taken away at the end";
    EXPECT_EQ(run(arguments).err, "");
    EXPECT_EQ(runWith(splitWords("render crease -o a.png --size 16x16 -q"), Stream::Read, Stream::Terminal).err, "");
}

TEST_F(RenderTest, NothingIsLeftWhenALaterSceneFails) {
    std::filesystem::create_directory(path("out"));
    write("bad.gltf", "{ \"asset\": ");
    const Outcome outcome = run("render crease bad.gltf -o out/ --size 16x16");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(files(), Names{"bad.gltf"});
}

TEST_F(RenderTest, NothingIsLeftWhenItIsInterrupted) {
    EXPECT_EQ(runInterrupted("render crease -o f%d.png --frames 1000 --size 64x64").code, -1);
    EXPECT_EQ(files(), Names{});
}

TEST_F(RenderTest, AnOldPictureStaysWhenTheNewOneFails) {
    write("a.png", "old");
    EXPECT_EQ(run("render crease -o a.png --size 16x16 --set SsaoStage.seed=x").code, 2);
    EXPECT_EQ(std::filesystem::file_size(path("a.png")), 3u);
    EXPECT_EQ(run("render crease -o a.png --size 16x16").code, 0);
    EXPECT_EQ(picture("a.png").width, 16u);
}

TEST_F(RenderTest, ValidationFindsNothing) {
    const Outcome outcome = run("render crease -o a.png --size 64x36 --validate --frames 2 --dump cc_ssaoMap=ao.png");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
}

TEST_F(RenderTest, ADocumentByPathFindsItsOwnEffects) {
    std::filesystem::create_directories(path("effects"));
    write("effects/red.effect", R"(CCEffect %{
  techniques:
  - passes:
    - vert: fullscreen-vs
      frag: red-fs
      rasterizerState: { cullMode: none }
      depthStencilState: { depthTest: false, depthWrite: false }
}%
CCProgram red-fs %{
  precision highp float;
  layout(location = 0) out vec4 color;
  void main() { color = vec4(1.0, 0.0, 0.0, 1.0); }
}%
)");
    write("red.pipeline.json", R"({
  "output": "finalColor",
  "targets": { "finalColor": { "format": "RGBA8" } },
  "flows": [ { "flow": "Red", "stages": [
    { "stage": "FullscreenStage", "effect": "red", "writes": ["finalColor"] } ] } ]
})");
    expectWritten("render crease -p red.pipeline.json -o a.png --size 8x8", {"a.png"});
    EXPECT_EQ(picture("a.png").at(4, 4), glm::vec4(1, 0, 0, 1));
}

// Each scene's shadow maps have its own size, whichever scene comes first; `--set` wins over all.
TEST_F(RenderTest, ScenesOfCocosBringTheSizeOfTheirShadowMaps) {
    std::filesystem::create_directories(path("game/assets"));
    write("game/package.json", "{}");
    const auto addScene = [&](const std::string& name, int side) {
        write("game/assets/" + name + ".scene",
              R"([ { "__type__": "cc.SceneAsset", "scene": { "__type__": "cc.Scene", "_children": [
      { "__type__": "cc.Node", "_components": [
        { "__type__": "cc.MeshRenderer", "_mesh": { "__uuid__": "1263d74c-8167-4928-91a6-4e2672411f47@17020" } } ] } ],
      "_globals": { "__type__": "cc.SceneGlobals", "shadows": { "__type__": "cc.ShadowsInfo", "_enabled": true,
        "_type": 1, "_size": { "__type__": "cc.Vec2", "x": )" +
                  fmt::format(R"({0}, "y": {0} }} }} }} }} }} ])", side));
    };
    addScene("small", 64);
    addScene("large", 2048);
    addScene("last", 64);
    std::filesystem::create_directory(path("out"));
    const std::string article = std::string(CREVICE_TEST_SOURCE_DIR) + "/tests/cocos/article-v36/";
    const auto heldWith = [&](const std::string& scenes, const std::string& more = "") {
        const Outcome outcome =
            run("render " + scenes + " -o out/ -v --size 32x18 -p " + article +
                "project/assets/pipeline/ssao-deferred-pipeline.rpp --engine " + article + "engine" + more);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        Names held;  // "4.2 MiB" for each scene
        for (std::size_t at = 0; (at = outcome.err.find("targets hold ", at)) != std::string::npos; ++at)
            held.push_back(outcome.err.substr(at + 13, outcome.err.find("MiB", at) - at - 13));
        return held;
    };
    const std::string small = "game/assets/small.scene", large = "game/assets/large.scene";
    const Names one = heldWith(small), other = heldWith(large);
    ASSERT_EQ(one.size(), 1u);
    ASSERT_EQ(other.size(), 1u);
    EXPECT_NE(one, other);
    EXPECT_EQ(heldWith(small + " " + large + " game/assets/last.scene"), (Names{one[0], other[0], one[0]}));
    EXPECT_EQ(heldWith(large + " " + small, " --set cc_shadowMap.size=[64,64] --set shadowDepth.size=[64,64]"),
              (Names{one[0], one[0]}));
}

TEST_F(RenderTest, TheBackgroundOfOneSceneIsNotThatOfTheNext) {
    std::filesystem::create_directories(path("game/assets"));
    write("game/package.json", "{}");
    write("game/assets/red.scene",
          R"([ { "__type__": "cc.SceneAsset", "scene": { "__type__": "cc.Scene", "_children": [
      { "__type__": "cc.Node", "_components": [ { "__type__": "cc.Camera", "_clearFlags": 7,
        "_color": { "__type__": "cc.Color", "r": 255, "g": 0, "b": 0, "a": 255 } } ] },
      { "__type__": "cc.Node", "_components": [
        { "__type__": "cc.MeshRenderer", "_mesh": { "__uuid__": "1263d74c-8167-4928-91a6-4e2672411f47@17020" } } ] }
      ] } } ])");
    write("box.scene.json", kBoxScene);
    std::filesystem::create_directory(path("out"));
    ASSERT_EQ(run("render game/assets/red.scene box.scene.json -o out/ --size 16x16 -p deferred").code, 0);
    const glm::vec4 red = picture("out/red.png").at(0, 0);
    EXPECT_GT(red.r, 0.5f);
    EXPECT_EQ(picture("out/box.png").at(0, 0), glm::vec4(0, 0, 0, 1));
}

}  // namespace
}  // namespace crevice::cli
