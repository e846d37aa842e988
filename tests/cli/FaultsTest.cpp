// Faults of the system around the program: a full disk, limits, no driver, a sudden end. Earlier files stay, nothing
// half-written appears, and the message says what to do.
#include <sys/resource.h>

#include "CliTools.h"
#include "core/Files.h"
#include "core/Image.h"
#include "tests/ScopedVariable.h"

namespace crevice::cli {
namespace {

using test::ScopedVariable;
using Names = std::vector<std::string>;

/// The largest file that the program may write.
class ScopedFileSize {
public:
    explicit ScopedFileSize(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit limited{bytes, old_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limited);
    }
    ~ScopedFileSize() { setrlimit(RLIMIT_FSIZE, &old_); }
    ScopedFileSize(const ScopedFileSize&) = delete;
    ScopedFileSize& operator=(const ScopedFileSize&) = delete;

private:
    rlimit old_{};
};

class FaultsTest : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        write("a.png", "an earlier picture");
    }
    void expectUntouched() {
        EXPECT_EQ(files(), Names{"a.png"});
        EXPECT_EQ(readText(path("a.png")), "an earlier picture");
    }
};

TEST_F(FaultsTest, AFileThatMayNotGrowIsAnErrorAndTheEarlierOneStays) {
    Outcome outcome;
    {
        const ScopedFileSize limit(1500);  // bytes; enough for the messages, not for the picture
        outcome = run("render crease -o a.png --size 160x90 -q --no-cache");
    }
    EXPECT_EQ(outcome.code, 1);
    expectHas(outcome.err, "error: cannot write 'a.png': File too large");
    expectHas(outcome.err, "help: raise the limit with `ulimit -f`, or write elsewhere");
    expectUntouched();
}

TEST_F(FaultsTest, AFullDiskIsAnErrorAndNoFileOfTheRunAppears) {
    const Outcome outcome = run("render crease -o a.png --size 16x16 -q --timings /dev/full");
    EXPECT_EQ(outcome.code, 1);
    expectHas(outcome.err, "error: cannot write '/dev/full': No space left on device");
    expectHas(outcome.err, "help: free some space, or write elsewhere");
    expectUntouched();
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full")) << "a device must never be replaced by a file";
}

TEST_F(FaultsTest, AFolderThatTakesNoFilesIsSaidBeforeAnythingIsDone) {
    const Outcome outcome = run("render crease -o /proc/a.png --size 16x16 -q");
    EXPECT_NE(outcome.code, 0);
    expectHas(outcome.err, "/proc");
    expectHas(outcome.err, "help: ");
    expectUntouched();
}

TEST_F(FaultsTest, NoVulkanDriverIsSaidInWords) {
    const ScopedVariable icd("VK_ICD_FILENAMES", "/nonexistent/icd.json");
    const ScopedVariable driver("VK_DRIVER_FILES", "/nonexistent/icd.json");
    const Outcome outcome = run("render crease -o a.png --size 16x16 -q");
    EXPECT_EQ(outcome.code, 2);
    expectHas(outcome.err, "error: no Vulkan driver was found");
    expectHas(outcome.err, "mesa-vulkan-drivers");
    expectUntouched();
}

/// `COMMAND …` with the article's project in our own words.
std::string withArticle(const std::string& before, const std::string& after) {
    const std::string article = CREVICE_TEST_SOURCE_DIR "/tests/cocos/article-v36/";
    return before + " " + article + "project/assets/pipeline/ssao-deferred-pipeline.rpp --engine " + article +
           "engine " + after;
}

TEST_F(FaultsTest, ImportWritesAWholeDocumentOrNone) {
    write("a.pipeline.json", "an earlier document");
    const auto expectEarlier = [&] {
        EXPECT_EQ(files(), (Names{"a.pipeline.json", "a.png"}));
        EXPECT_EQ(readText(path("a.pipeline.json")), "an earlier document");
    };
    Outcome outcome;
    {
        const ScopedFileSize limit(1000);  // the document is larger; each of its messages is not
        outcome = run(withArticle("import", "-o a.pipeline.json -q"));
    }
    EXPECT_EQ(outcome.code, 1);
    expectHas(outcome.err, "error: cannot write 'a.pipeline.json': File too large");
    expectEarlier();
    std::filesystem::create_symlink("/dev/full", path("full.json"));  // documents end in .json
    outcome = run(withArticle("import", "-o full.json -q"));
    EXPECT_EQ(outcome.code, 1);
    expectHas(outcome.err, "error: cannot write 'full.json': No space left on device");
    EXPECT_TRUE(std::filesystem::is_symlink(path("full.json")));
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
    std::filesystem::remove(path("full.json"));
    outcome = run(withArticle("import", "-o /proc/a.pipeline.json -q"));
    EXPECT_NE(outcome.code, 0);
    expectHas(outcome.err, "/proc");
    expectHas(outcome.err, "help: ");
    expectEarlier();
}

TEST_F(FaultsTest, ACocosPipelineWritesAWholePictureOrNone) {
    const std::string small = "-o a.png --size 160x90 -q";
    Outcome outcome;
    {
        const ScopedFileSize limit(1500);
        outcome = run(withArticle("render crease -p", small));  // what the caches cannot keep is no error
    }
    EXPECT_EQ(outcome.code, 1);
    expectHas(outcome.err, "error: cannot write 'a.png': File too large");
    expectUntouched();
    outcome = run(withArticle("render crease -p", "-o a.png --size 16x16 -q --dump cc_ssaoMap=/proc/ao.png"));
    EXPECT_NE(outcome.code, 0);
    expectHas(outcome.err, "/proc");
    expectUntouched();
    outcome = run(withArticle("render crease -p", "-o a.png --size 16x16 -q --timings /dev/full"));
    EXPECT_EQ(outcome.code, 1);
    expectHas(outcome.err, "error: cannot write '/dev/full': No space left on device");
    expectUntouched();
}

// Whatever instant the end comes at, the name holds the old picture or the whole new one.
TEST_F(FaultsTest, AKilledRunLeavesTheOldPictureOrAWholeOne) {
    for (const int delayMs : {0, 2, 5}) {
        write("a.png", "an earlier picture");
        runKilled("render crease -o a.png --size 320x180 -q", delayMs);
        const bool old = readText(path("a.png")) == "an earlier picture";
        EXPECT_TRUE(old || readImage(path("a.png")).width == 320);
    }
}

}  // namespace
}  // namespace crevice::cli
