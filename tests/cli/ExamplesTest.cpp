// Every example that a --help shows is run.
#include <fstream>

#include "CliTools.h"

namespace crevice::cli {
namespace {

class ExamplesTest : public CliTest {
protected:
    /// The commands below "Examples:" in a help text, without the program's name.
    static std::vector<std::string> examplesOf(const std::string& help) {
        std::vector<std::string> examples;
        const std::size_t begin = help.find("Examples:\n");
        if (begin == std::string::npos) return examples;
        for (const std::string& line : splitWords(help.substr(begin), '\n')) {
            if (line.starts_with("  crevice ")) examples.push_back(line.substr(10));
        }
        return examples;
    }

    /// Names under "Subcommands:".
    static std::vector<std::string> subcommandsOf(const std::string& help) {
        std::vector<std::string> names;
        const std::size_t begin = help.find("Subcommands:\n");
        if (begin == std::string::npos) return names;
        const std::string list = help.substr(begin, help.find("\n\n", begin) - begin);
        for (const std::string& line : splitWords(list, '\n')) {
            if (line.starts_with("  ") && line[2] != ' ') names.push_back(splitWords(line).front());
        }
        return names;
    }

    /// The help of a command and of all below it.
    void runExamples(const std::string& command, std::size_t& count) {
        const Outcome help = run(command.empty() ? "--help" : command + " --help");
        ASSERT_EQ(help.code, 0) << command;
        const std::vector<std::string> examples = examplesOf(help.out);
        EXPECT_FALSE(examples.empty()) << "crevice " << command << " --help shows no example";
        for (const std::string& example : examples) {
            const Outcome outcome = run(example);
            EXPECT_EQ(outcome.code, 0) << "crevice " << example << "\n" << outcome.err;
            EXPECT_NE(outcome.out, "") << "crevice " << example;
            ++count;
        }
        for (const std::string& name : subcommandsOf(help.out)) {
            runExamples(command.empty() ? name : command + " " + name, count);
        }
    }
};

TEST_F(ExamplesTest, EveryExampleRuns) {
    ASSERT_EQ(run("render crease -o a.png --size 16x16").code, 0);  // what the examples of `compare` read
    std::filesystem::copy_file(path("a.png"), path("b.png"));
    std::ofstream(path("mine.rpp")) << R"({ "__type__": "DeferredPipeline", "_flows": [] })";  // and of `import`
    const std::filesystem::path sources(CREVICE_TEST_SOURCE_DIR);
    std::filesystem::create_directory_symlink(sources / "tests/cocos/article-v36/engine", path("cocos-engine"));
    std::size_t count = 0;
    runExamples("", count);
    EXPECT_GE(count, 20u);
}

}  // namespace
}  // namespace crevice::cli
