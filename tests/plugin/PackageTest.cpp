// The installed package: complete, movable, with headers that need nothing but what it brings or asks for.

#include <gtest/gtest.h>

#include "PackageTools.h"
#include "core/Files.h"

namespace crevice::package {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = CREVICE_TEST_SOURCE_DIR;
constexpr std::size_t kMaxExampleLines = 40;
constexpr std::size_t kMaxSsaoLines = 80;

std::vector<fs::path> filesBelow(const fs::path& folder, const std::string& ending) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && entry.path().string().ends_with(ending)) files.push_back(entry.path());
    }
    return files;
}

TEST(Package, HoldsWhatItPromises) {
    const fs::path root = work() / "crevice";
    for (const char* file :
         {"bin/crevice", "lib/libcrevice.so", "include/crevice/flow/RenderStage.h", "include/crevice/app/Renderer.h",
          "share/crevice/effects/ssao.effect", "share/crevice/effects/chunks/cc-camera.chunk",
          "share/crevice/assets/pipelines/ssao-deferred.pipeline.json", "share/crevice/assets/scenes/crease.scene.json",
          "lib/cmake/Crevice/CreviceConfig.cmake", "lib/cmake/Crevice/CreviceConfigVersion.cmake",
          "lib/cmake/Crevice/CreviceTargets.cmake", "lib/cmake/Crevice/CreviceAddPlugin.cmake"}) {
        EXPECT_TRUE(fs::is_regular_file(root / file)) << file;
    }
    EXPECT_FALSE(fs::exists(root / "include/crevice/app/commands")) << "the program's own headers are not public";
}

TEST(Package, FindsItsShareFolderAfterItWasMoved) {
    const Outcome outcome = crevice(".", "effects list");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("only-in-the-package"), std::string::npos) << outcome.text;
}

TEST(Package, NamesNoFolderOfItsBuild) {
    for (const char* ending : {".cmake", ".h", ".json", ".effect"}) {
        for (const fs::path& file : filesBelow(work() / "crevice", ending)) {
            const std::string text = readText(file);
            EXPECT_EQ(text.find(CREVICE_BUILD_DIR), std::string::npos) << file;
            EXPECT_EQ(text.find(kSource.string() + "/"), std::string::npos) << file;
        }
    }
}

TEST(Package, HeadersIncludeOnlyWhatIsThere) {
    const fs::path root = work() / "crevice/include/crevice";
    std::size_t count = 0;
    for (const fs::path& header : filesBelow(root, ".h")) {
        for (const std::string& include : includesOf(header)) {
            ++count;
            const std::string name = include.substr(1, include.size() - 2);
            const bool standard = name.find('/') == std::string::npos && name.find('.') == std::string::npos;
            const bool known = standard || name.starts_with("glm/") || name.starts_with("vulkan/");
            EXPECT_TRUE(include[0] == '<' ? known : fs::is_regular_file(root / name)) << header << ": " << include;
        }
    }
    EXPECT_GT(count, 100u);
}

TEST(Package, ExamplesAreShort) {
    std::size_t count = 0;
    for (const char* folder : {"outline", "stages", "library"}) {
        for (const auto& entry : fs::directory_iterator(work() / folder)) {
            if (entry.path().extension() != ".cpp") continue;
            ++count;
            EXPECT_LE(linesOf(entry.path()).size(), kMaxExampleLines) << entry.path();
        }
    }
    EXPECT_EQ(count, 6u) << "OutlineStage, LetterboxStage, HeightStage, Plugin, main, views";
}

TEST(Package, StagesIncludeOneHeader) {
    const std::vector<std::string> one = {"\"flow/RenderStage.h\""};
    EXPECT_EQ(includesOf(work() / "outline/OutlineStage.cpp"), one);
    EXPECT_EQ(includesOf(work() / "stages/LetterboxStage.cpp"), one);
    EXPECT_EQ(includesOf(work() / "stages/HeightStage.cpp"), one);
    EXPECT_EQ(includesOf(work() / "stages/Plugin.cpp"), one);
}

TEST(Package, TheSsaoStageIsWrittenAsAnOutsiderWould) {
    const fs::path stage = kSource / "stages/SsaoStage.cpp";
    EXPECT_EQ(includesOf(stage),
              (std::vector<std::string>{"\"CocosTargets.h\"", "\"SsaoKernel.h\"", "\"flow/RenderStage.h\""}));
    EXPECT_LT(linesOf(stage).size(), kMaxSsaoLines);
}

/// Refused with code 2, in words, and nothing is written.
void expectRefused(const std::string& folder, const std::string& arguments, const std::string& message,
                   const std::string& help) {
    const Outcome outcome = crevice(folder, "render crease --size 32x32 -o refused.png " + arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_NE(outcome.text.find("error: "), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find(message), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("help: "), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find(help), std::string::npos) << outcome.text;
    EXPECT_FALSE(fs::exists(work() / folder / "refused.png"));
}

TEST(PluginRefusal, OtherAbi) {
    expectRefused("refused", "--plugin libabi.so",
                  "plugin 'libabi.so' was built for plugin ABI 2, this program has ABI 1", "rebuild the plugin");
}

TEST(PluginRefusal, OtherCompiler) {
    expectRefused("refused", "--plugin libcompiler.so", "plugin 'libcompiler.so' was built by tinycc 0.9, this program",
                  "the same compiler");
}

TEST(PluginRefusal, OtherBuildType) {
    expectRefused("refused", "--plugin libtype.so", "plugin 'libtype.so' is a sanitized build, this program a ",
                  "CMAKE_BUILD_TYPE");
}

TEST(PluginRefusal, NoPlugin) {
    expectRefused("refused", "--plugin libnothing.so", "'libnothing.so' is no Crevice plugin", "CREVICE_PLUGIN");
}

TEST(PluginRefusal, NoLibrary) {
    expectRefused("refused", "--plugin libtext.so", "plugin 'libtext.so' cannot be loaded", "crevice_add_plugin()");
}

TEST(PluginRefusal, MissingFile) {
    expectRefused("refused", "--plugin libgone.so", "plugin 'libgone.so' does not exist", "--plugin ./libNAME.so");
}

TEST(PluginRefusal, ClassOfAnotherPlugin) {
    expectRefused("refused", "--plugin ../outline/build/liboutline.so --plugin libduplicate.so",
                  "stage class 'OutlineStage' of libduplicate.so is already registered by "
                  "../outline/build/liboutline.so",
                  "rename one of the two classes");
}

TEST(PluginRefusal, TheSamePluginTwiceIsOnePlugin) {
    const Outcome outcome = crevice("outline", "stages --plugin build/liboutline.so --plugin ./build/liboutline.so");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
}

TEST(PluginRefusal, DocumentsLoadNothingByThemselves) {
    expectRefused("outline", "-p outline.pipeline.json",
                  "outline.pipeline.json:5:15: error: the pipeline needs plugin 'outline'",
                  "--plugin DIR/liboutline.so");
    // Not even when it lies beside the document.
    fs::copy_file(work() / "outline/build/liboutline.so", work() / "outline/liboutline.so",
                  fs::copy_options::overwrite_existing);
    expectRefused("outline", "-p outline.pipeline.json", "which the caller has not allowed", "--plugin-path DIR");
    fs::remove(work() / "outline/liboutline.so");
    expectRefused("outline", "-p outline.pipeline.json --plugin-path .", "plugin 'outline', which was not found",
                  "looked for liboutline.so in: .");
}

TEST(PluginRefusal, ParametersOutOfRange) {
    expectRefused("outline", "-p outline.pipeline.json --plugin build/liboutline.so --set Ink.params.width=9",
                  "'width'", "1 … 8");
}

}  // namespace
}  // namespace crevice::package
