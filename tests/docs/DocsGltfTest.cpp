// Each row of the tables in docs/gltf.md names a test, and the test exists.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace crevice {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// "Suite.Name" of every TEST and TEST_F.
std::set<std::string> testsThereAre(const fs::path& folder) {
    std::set<std::string> names;
    const std::regex macro(R"(TEST(?:_F|_P)?\((\w+),\s*(\w+)\))");
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".cpp") continue;
        const std::string text = textOf(entry.path());
        for (std::sregex_iterator match(text.begin(), text.end(), macro), end; match != end; ++match)
            names.insert((*match)[1].str() + "." + (*match)[2].str());
    }
    return names;
}

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

}  // namespace
}  // namespace crevice
