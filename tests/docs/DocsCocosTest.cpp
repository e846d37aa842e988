// docs/cocos-runtime.md: all faults of the article and of the demo are there, and every test it names exists.
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "TestNames.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

/// Rows of the tables below a heading, up to the next one.
std::vector<std::string> rowsBelow(const std::string& heading) {
    std::ifstream file(fs::path(CREVICE_TEST_SOURCE_DIR) / "docs" / "cocos-runtime.md");
    std::vector<std::string> rows;
    bool inside = false;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("## ")) inside = line == "## " + heading;
        if (inside && line.starts_with("| ") && !line.starts_with("| #") && !line.starts_with("| Issue"))
            rows.push_back(line);
    }
    return rows;
}

std::vector<std::string> testsIn(const std::string& row) {
    static const std::regex kName(R"(`([A-Z]\w+\.[A-Z]\w+)`)");
    std::vector<std::string> names;
    for (std::sregex_iterator match(row.begin(), row.end(), kName), end; match != end; ++match)
        names.push_back((*match)[1].str());
    return names;
}

void expectTests(const std::vector<std::string>& rows) {
    static const std::set<std::string> kTests = testsThereAre(fs::path(CREVICE_TEST_SOURCE_DIR) / "tests");
    for (const std::string& row : rows) {
        // What cannot occur has no test: the row says why.
        EXPECT_TRUE(!testsIn(row).empty() || row.find("cannot occur") != std::string::npos) << row;
        for (const std::string& name : testsIn(row)) EXPECT_TRUE(kTests.contains(name)) << name;
    }
}

TEST(DocsCocos, EveryFaultHasItsNumberAndATest) {
    const std::vector<std::string> rows = rowsBelow("Faults of the article's and the demo's setup");
    std::set<int> numbers;
    for (const std::string& row : rows) numbers.insert(std::stoi(row.substr(2)));
    ASSERT_EQ(rows.size(), 27u);
    EXPECT_EQ(numbers.size(), 27u);
    EXPECT_EQ(*numbers.begin(), 1);
    EXPECT_EQ(*numbers.rbegin(), 27);
    expectTests(rows);
}

TEST(DocsCocos, TheArticlesFourIssuesAreAbsentByTests) {
    const std::vector<std::string> rows = rowsBelow("The article's known issues");
    EXPECT_EQ(rows.size(), 4u);
    expectTests(rows);
}

}  // namespace
}  // namespace crevice
