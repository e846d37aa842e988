// Mistakes on the command line: each has words of its own, exit code 2 and leaves no file.
#include "CliTools.h"

namespace crevice::cli {
namespace {

class UsageTest : public CliTest {};

TEST_F(UsageTest, VersionAndHelpAreResults) {
    const Outcome version = run("--version");
    EXPECT_EQ(version.code, 0);
    EXPECT_EQ(version.out, "crevice " CREVICE_VERSION "\n");
    EXPECT_EQ(version.err, "");
    const Outcome help = run("--help");
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("Usage: crevice"), std::string::npos);
    EXPECT_EQ(help.err, "");
}

TEST_F(UsageTest, SubcommandsAreChecked) {
    expectRefused("", "no subcommand given", "crevice --help");
    expectRefused("rendr", "unknown subcommand 'rendr'", "did you mean 'render'?");
    expectRefused("effects lst", "unknown subcommand 'lst'", "did you mean 'list'?");
}

TEST_F(UsageTest, OptionsAreChecked) {
    expectRefused("render crease --sise 8x8", "unknown option '--sise'", "did you mean '--size'?");
    expectRefused("render crease --frame=8", "unknown option '--frame'", "did you mean '--frames'?");
    expectRefused("plan deferred --zzz", "unknown option '--zzz'", "crevice plan --help");
    expectRefused("render crease -o a.png --eye", "option '--eye' needs a value", "crevice render --help");
    expectRefused("render crease -o a.png --size 8x8 --size 9x9", "option '--size' is given more than once",
                  "crevice render --help");
    expectRefused("flatten deferred forward", "unexpected argument 'forward'", "crevice flatten --help");
    expectRefused("render crease -o a.png -q -v", "-q and -v contradict each other", "give one");
}

TEST_F(UsageTest, SizesAreChecked) {
    for (const char* size : {"12", "ax5", "5x", "x5", "5x5x5", "5.5x5", "5x5px", "0x10000000000000000000"}) {
        expectRefused(std::string("render crease -o a.png --size ") + size,
                      std::string("--size: '") + size + "' is not a size", "WIDTHxHEIGHT");
    }
    for (const char* size : {"0x5", "5x0", "-5x5", "16385x1", "1x16385"}) {
        expectRefused(std::string("render crease -o a.png --size ") + size,
                      std::string("--size: '") + size + "' is out of range", "1 to 16384");
    }
}

TEST_F(UsageTest, CamerasAreChecked) {
    const std::string render = "render crease -o a.png --size 8x8 ";
    for (const char* vector : {"1,2", "1,2,3,4", "1,b,2", "nan,0,0", "1e50,0,0", "1,,2"}) {
        expectRefused(render + "--eye " + vector, std::string("--eye: '") + vector + "' is not a vector",
                      "three numbers with commas");
    }
    expectRefused(render + "--target 0,0,0", "--target needs --eye", "--eye 0,1,4 --target 0,0,0");
    expectRefused(render + "--up 0,0,1", "--up needs --eye", "place the camera");
    expectRefused(render + "--eye 1,1,1 --target 1,1,1", "--eye and --target are the same point", "move one");
    expectRefused(render + "--eye 1,1,1 --up 0,0,0", "--up: '0,0,0' has no direction", "--up 0,1,0");
    expectRefused(render + "--eye 1,1,1 --camera 0", "--camera and --eye contradict each other", "not both");
    expectRefused(render + "--fov 40 --ortho 2", "--fov and --ortho contradict each other", "perspective");
    expectRefused(render + "--fov 180", "--fov: '180' is out of range", "between 0 and 180");
    expectRefused(render + "--fov -4", "--fov: '-4' is out of range", "between 0 and 180");
    expectRefused(render + "--fov wide", "--fov: 'wide' is not a number", "0.5");
    expectRefused(render + "--ortho 0", "--ortho: '0' is out of range", "above 0");
    expectRefused(render + "--near 0", "--near: '0' is out of range", "above 0");
    expectRefused(render + "--near 5 --far 5", "--near is not in front of --far", "smaller");
    expectRefused("render default -o a.png --camera strol", "--camera: the scene has no camera 'strol'", "0 'walk'");
    expectRefused("render default -o a.png --camera 7", "--camera: the scene has no camera '7'", "cameras: 0 'walk'");
}

TEST_F(UsageTest, WhatTheInputsSayIsToldBeforeADeviceIsLookedFor) {
    const std::string render = "render default -o a.png --device none-of-that-name ";
    expectRefused(render + "--camera strol", "--camera: the scene has no camera 'strol'", "0 'walk'");
    expectRefused(render + "--set SsaoStage.samples=65", "'samples' in params of stage 'SsaoStage' is 65", "1 to 64");
    write("unknown.pipeline.json",
          R"({"extends": "deferred", "edits": [{"insert": {"stage": "NoStage"}, "after": "Fxaa"}]})");
    expectRefused(render + "-p unknown.pipeline.json", "no stage class is registered under 'NoStage'", "classes:");
    write("cut.gltf", "{");
    expectRefused("render cut.gltf -o a.png --device none-of-that-name", "the text ends where a key",
                  "complete the document");
    expectRefused(render, "no Vulkan device 'none-of-that-name'", "devices:");  // Nothing else is wrong.
}

TEST_F(UsageTest, ScenesAreChecked) {
    write("notes.txt", "no scene");
    expectRefused("render -o a.png", "no scene given", "default");
    expectRefused("render defalt -o a.png", "no scene named 'defalt'", "did you mean 'default'?");
    expectRefused("render missing.gltf -o a.png", "scene 'missing.gltf' does not exist", "check the path");
    expectRefused("render notes.txt -o a.png", "'notes.txt' is not a scene", ".gltf, .glb, .scene.json or .scene");
}

TEST_F(UsageTest, OutputsAreChecked) {
    expectRefused("render crease", "no output given", "-o OUT.png");
    expectRefused("render crease -o gone/a.png", "-o: folder 'gone' does not exist", "mkdir -p gone");
    expectRefused("render crease -o a.jpg", "-o: '.jpg' is not a kind of picture", ".png (8 bits) or .exr");
    expectRefused("render crease -o a", "-o: 'a' has no extension", ".png");
    expectRefused("render crease default -o a.png", "-o: 2 scenes cannot go into the one file 'a.png'", "-o a/");
    expectRefused("render crease crease -o .", "two scenes would be written to './crease.png'", "different folders");
    expectRefused("render crease -o a.png --dump viewDepth=./a.png", "'./a.png' would be written twice", "own name");
    expectRefused("render crease -o a.png --timings gone/t.json", "--timings: folder 'gone' does not exist", "mkdir");
    expectRefused("render crease -o a.png --frames 0", "--frames: '0' is out of range", "from 1");
    expectRefused("render crease -o a.png --frames many", "--frames: 'many' is not a whole number", "from 1");
}

TEST_F(UsageTest, ColoursAreChecked) {
    for (const char* color : {"#12345", "#gggggg", "reddish", "1,2", "1,x,0"}) {
        expectRefused(std::string("render crease -o a.png --background ") + color,
                      std::string("--background: '") + color + "' is not a colour", "#rrggbb");
    }
    expectRefused("render crease -o a.png --background 1,2,0", "--background: '1,2,0' is out of range", "0 to 1");
}

TEST_F(UsageTest, PipelinesAreChecked) {
    const std::string render = "render crease -o a.png ";
    expectRefused(render + "-p ssao-defered", "no pipeline named 'ssao-defered'", "did you mean 'ssao-deferred'");
    expectRefused(render + "-p gone.pipeline.json", "no pipeline file 'gone.pipeline.json'", "a name");
    expectRefused(render + "--option sao=false", "no option named 'sao'", "did you mean 'ssao'?");
    expectRefused(render + "--option ssao", "--option: 'ssao' has no '='", "NAME=VALUE");
    expectRefused(render + "--option ssao=true --option ssao=false", "--option: 'ssao' is given more than once",
                  "once");
    expectRefused(render + "--set SsaoStage.sed=3", "unknown key 'sed'", "seed");
    expectRefused(render + "--set =3", "--set: '=3' has no '='", "STAGE.path=VALUE");
    expectRefused(render + "--dump cc_ssaoMpa=x.png", "--dump: pipeline 'ssao-deferred' has no target 'cc_ssaoMpa'",
                  "did you mean 'cc_ssaoMap'?");
    expectRefused(render + "--dump cc_ssaoMap", "--dump: 'cc_ssaoMap' has no '='", "TARGET=FILE.png");
    expectRefused(render + "--dump cc_ssaoMap=x.bmp", "--dump: '.bmp' is not a kind of picture", ".exr");
    expectRefused("render crease default -o . --dump viewDepth=x.png", "--dump writes one file, and there are 2 scenes",
                  "one at a time");
    expectRefused(render + "--seed -3", "--seed: '-3' is out of range", "from 0 to 4294967295");
    expectRefused(render + "--seed 3 -p deferred", "--seed: no stage of pipeline 'deferred' has a seed",
                  "leave --seed");
    expectRefused(render + "--plugin gone.so", "plugin 'gone.so' does not exist", "--plugin ./libNAME.so");
    expectRefused(render + "--plugin-path gone", "--plugin-path: folder 'gone' does not exist", "existing folder");
    expectRefused(render + "--device nosuch", "no Vulkan device 'nosuch'", "devices:");
}

TEST_F(UsageTest, PluginsOfADocumentAreLookedUpInFoldersThatWereNamed) {
    write("own.pipeline.json", R"({"extends": "deferred", "plugins": ["sparkle"]})");
    expectRefused("validate own.pipeline.json", "the pipeline needs plugin 'sparkle'", "--plugin-path DIR");
    expectRefused("validate own.pipeline.json --plugin-path .", "the pipeline needs plugin 'sparkle'", "libsparkle.so");
    write("path.pipeline.json", R"({"extends": "deferred", "plugins": ["../sparkle"]})");
    expectRefused("validate path.pipeline.json", "plugin '../sparkle' is a path", "--plugin-path DIR");
    write("libsparkle.so", "no library");
    expectRefused("validate own.pipeline.json --plugin-path .", "plugin './libsparkle.so' cannot be loaded", "");
}

TEST_F(UsageTest, OtherCommandsCheckTheirArguments) {
    expectRefused("validate", "no pipeline given", "crevice validate ssao-deferred");
    expectRefused("flatten", "no pipeline given", "crevice flatten");
    expectRefused("plan", "no pipeline given", "crevice plan");
    expectRefused("plan deferred --size big", "--size: 'big' is not a size", "WIDTHxHEIGHT");
    expectRefused("stages SsaoStge", "no stage class named 'SsaoStge'", "did you mean 'SsaoStage'?");
    expectRefused("stages --json --markdown", "--markdown and --json contradict each other", "choose");
    expectRefused("effects show", "no effect given", "crevice effects show");
    expectRefused("effects show ssoa", "no effect", "did you mean 'ssao'?");
    expectRefused("effects compile", "no effect given", "crevice effects compile");
    expectRefused("effects compile ssao --define NO_SUCH=1", "--define: no pass of these effects tests macro 'NO_SUCH'",
                  "SSAO_SAMPLES");
    expectRefused("effects compile ssao --json --text", "--json and --text contradict each other", "choose");
    expectRefused("schema -o gone/a.json", "-o: folder 'gone' does not exist", "mkdir");
    expectRefused("compare", "two pictures are needed", "crevice compare a.png b.png");
    expectRefused("compare a.png b.png --rmse -1", "--rmse: '-1' is out of range", "from 0");
    expectRefused("info nosuch", "no scene named 'nosuch'", "shipped scenes");
}

}  // namespace
}  // namespace crevice::cli
