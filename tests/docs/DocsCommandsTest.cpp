// The commands that the documents show are run, in their order, in an empty folder; the files they name must then
// exist.
#include <cstdlib>
#include <fstream>
#include <regex>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "Markdown.h"

namespace crevice::docs {
namespace {

namespace fs = std::filesystem;

class DocsCommands : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("crevice-docs-" + std::to_string(getpid()));
        fs::create_directories(folder_);
        // Some documents show the projects that the tests keep.
        fs::create_directory_symlink(fs::path(CREVICE_TEST_SOURCE_DIR) / "tests", folder_ / "tests");
    }
    void TearDown() override {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }

    /// The exit code of a line as a shell runs it, with `crevice` and `build/crevice` as the program under test.
    int run(const std::string& line) {
        const std::string program = std::regex_replace(line, std::regex("(^|[;&|] *)(build/)?crevice "),
                                                       "$1" + std::string(CREVICE_PROGRAM) + " ");
        const std::string command = "cd '" + folder_.string() + "' && " + program + " >out.txt 2>err.txt";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    void write(const std::string& file, const std::string& text) {
        fs::create_directories((folder_ / file).parent_path());
        std::ofstream(folder_ / file) << text;
    }
    void expectOutputs(const std::string& line) {
        static const std::regex output("(?:-o|--heat|--timings|--dump \\S+?=?) ?([\\w./-]+\\.(?:png|exr|json))");
        for (std::sregex_iterator found(line.begin(), line.end(), output), end; found != end; ++found) {
            EXPECT_TRUE(fs::exists(folder_ / (*found)[1].str())) << (*found)[1] << " was not written";
        }
    }

    fs::path folder_;
};

bool isOurs(const std::string& line) { return line.starts_with("crevice ") || line.starts_with("build/crevice "); }

TEST_P(DocsCommands, Run) {
    const fs::path document = fs::path(CREVICE_TEST_SOURCE_DIR) / GetParam();
    int count = 0;
    for (const Block& block : blocksOf(readText(document))) {
        if (!block.file.empty()) write(block.file, block.text);
        if (block.language != "sh") continue;
        for (const std::string& line : splitLines(block.text)) {
            if (!isOurs(line)) continue;
            SCOPED_TRACE(document.string() + ": " + line);
            EXPECT_EQ(run(line), 0) << readText(folder_ / "err.txt");
            expectOutputs(line);
            ++count;
        }
    }
    EXPECT_GE(count, 1);
}

INSTANTIATE_TEST_SUITE_P(Of, DocsCommands,
                         testing::Values("README.md", "docs/quickstart.md", "docs/command-line.md",
                                         "docs/troubleshooting.md", "docs/reference.md", "docs/ao/debug-views.md",
                                         "docs/from-cocos.md"),
                         [](const auto& c) {
                             return std::regex_replace(std::string(c.param), std::regex("\\W"), "_");
                         });

}  // namespace
}  // namespace crevice::docs
