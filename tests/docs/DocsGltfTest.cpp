// Each row of the tables in docs/gltf.md names a test, and the test exists.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "TestNames.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

TEST(DocsGltf, EveryRowNamesATestThatExists) {
    const fs::path root = CREVICE_TEST_SOURCE_DIR;
    const std::set<std::string> tests = testsThereAre(root / "tests");
    std::ifstream file(root / "docs" / "gltf.md");
    const std::regex name(R"(`((?:Gltf|GltfGpu)\w*\.\w+)`)");
    std::string line;
    int rows = 0;
    while (std::getline(file, line)) {
        std::sregex_iterator match(line.begin(), line.end(), name), end;
        const bool isRow = line.starts_with("| ") && !line.starts_with("| Feature") && !line.starts_with("| Extension");
        if (isRow) {
            ++rows;
            EXPECT_NE(match, end) << "no test: " << line;
        }
        for (; match != end; ++match) EXPECT_TRUE(tests.contains((*match)[1].str())) << (*match)[1].str();
    }
    EXPECT_GE(rows, 30);
}

/// Code → answers, of all cases in the tests' sources.
std::map<std::string, std::set<std::string>> answersInTests(const fs::path& folder) {
    const std::map<std::string, std::string> words = {
        {"Refused", "error"}, {"Fault", "warning"}, {"Told", "note"}, {"Silent", "nothing"}};
    std::map<std::string, std::set<std::string>> answers;
    const std::regex row(R"rx(\{"([A-Z_0-9]{4,})",\s*(Refused|Fault|Told|Silent)\b)rx");
    for (const char* name :
         {"GltfSchemaFaults", "GltfSemanticFaults", "GltfLinkFaults", "GltfDataFaults", "GltfContainerTest"}) {
        const std::string text = textOf(folder / (std::string(name) + ".cpp"));
        for (std::sregex_iterator match(text.begin(), text.end(), row), end; match != end; ++match)
            answers[(*match)[1].str()].insert(words.at((*match)[2].str()));
    }
    return answers;
}

// docs/gltf-faults.md says of every code what the tests expect, and nothing else.
TEST(DocsGltf, FaultsAreAnsweredAsTheTestsExpect) {
    const fs::path root = CREVICE_TEST_SOURCE_DIR;
    const auto expected = answersInTests(root / "tests" / "unit");
    const std::string page = textOf(root / "docs" / "gltf-faults.md");
    std::map<std::string, std::set<std::string>> told;
    const std::regex row(R"rx(\| ([A-Z_0-9]{4,}) \| ([a-z, ]+) \|)rx"), word("[a-z]+");
    for (std::sregex_iterator match(page.begin(), page.end(), row), end; match != end; ++match) {
        const std::string list = (*match)[2].str();
        for (std::sregex_iterator w(list.begin(), list.end(), word); w != end; ++w)
            told[(*match)[1].str()].insert(w->str());
    }
    EXPECT_EQ(told, expected);
    EXPECT_GE(told.size(), 140u);
    const std::set<std::string> tests = testsThereAre(root / "tests");
    const std::regex name(R"(`(Gltf\w+\.\w+)`)");
    for (std::sregex_iterator match(page.begin(), page.end(), name), end; match != end; ++match)
        EXPECT_TRUE(tests.contains((*match)[1].str())) << (*match)[1].str();
}

}  // namespace
}  // namespace crevice
