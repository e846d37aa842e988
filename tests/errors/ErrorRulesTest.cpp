// What all messages have in common: a place, quoted names, help, a cause of their own; and the table of docs/errors.md.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "CaseFile.h"
#include "core/Files.h"

namespace crevice::errors {
namespace {

constexpr std::size_t kFewestCases = 200;
constexpr const char* kTableBegin =
    "<!-- causes: written by the tests of tests/errors; a test fails when it is stale -->\n";
constexpr const char* kTableEnd = "<!-- end of causes -->\n";

/// The text of a message from one `error:` to the next.
std::vector<std::string> splitProblems(const Case& c) {
    static const std::regex kHeadline("^([^ ].*?: )?error: .*");
    std::vector<std::string> problems;
    std::istringstream lines(c.expected);
    for (std::string line; std::getline(lines, line);) {
        if (std::regex_match(line, kHeadline)) problems.emplace_back();
        if (!problems.empty()) problems.back() += line + "\n";
    }
    return problems;
}

/// Words that look like names of code or files and stand outside of quotes.
std::vector<std::string> unquotedNames(const std::string& message) {
    static const std::regex kQuoted("(^|[ (\\[>=])'[^']*'");
    static const std::regex kName(
        "[A-Za-z0-9]*[a-z][A-Z][A-Za-z0-9]*|\\w*[a-z]_\\w+|\\w+\\.(json|effect|chunk|gltf|glb|png)\\b");
    static const std::regex kEntry("\\w+\\[[0-9]+\\]");  // accessors[3], as glTF counts
    static const std::set<std::string> kWords = {"glTF", "WebP"};
    const std::string rest = std::regex_replace(std::regex_replace(message, kQuoted, "$1"), kEntry, "");
    std::vector<std::string> names;
    for (std::sregex_iterator it(rest.begin(), rest.end(), kName), end; it != end; ++it)
        if (!kWords.contains(it->str())) names.push_back(it->str());
    return names;
}

TEST(ErrorRules, ThereAreEnoughCasesInEveryArea) {
    EXPECT_GE(readAllCases().size(), kFewestCases);
    EXPECT_EQ(listAreas(), (std::vector<std::string>{"arguments", "cocos", "effects", "gltf", "json", "materials",
                                                     "pipelines", "planner", "scenes"}));
}

TEST(ErrorRules, EveryErrorHasACause) {
    for (const Case& c : readAllCases()) EXPECT_EQ(c.headlines().size(), c.causes.size()) << c.id();
}

TEST(ErrorRules, PlacesAreLinesAndColumns) {
    static const std::regex kColumn("[^:]+:([1-9][0-9]*:[1-9][0-9]*|LINE:COLUMN)"), kFile("[^:]+");
    for (const Case& c : readAllCases()) {
        for (const Headline& line : c.headlines()) {
            const std::string what = c.id() + ": " + line.place + ": " + line.message;
            if (c.place == "none") {
                EXPECT_EQ(line.place, "") << what;
            } else {
                EXPECT_TRUE(std::regex_match(line.place, c.place == "file" ? kFile : kColumn)) << what;
            }
        }
    }
}

TEST(ErrorRules, EveryErrorSaysWhatToDo) {
    for (const Case& c : readAllCases()) {
        for (const std::string& problem : splitProblems(c))
            EXPECT_NE(problem.find("\nhelp: "), std::string::npos) << c.id() << "\n" << problem;
    }
}

TEST(ErrorRules, NamesStandInSingleQuotes) {
    for (const Case& c : readAllCases()) {
        for (const Headline& line : c.headlines()) {
            EXPECT_EQ(line.message.find_first_of("\"`"), std::string::npos) << c.id() << ": " << line.message;
            EXPECT_EQ(unquotedNames(line.message), std::vector<std::string>{}) << c.id() << ": " << line.message;
        }
    }
}

TEST(ErrorRules, HeadlinesBeginSmallAndEndWithoutAFullStop) {
    for (const Case& c : readAllCases()) {
        for (const Headline& line : c.headlines()) {
            ASSERT_FALSE(line.message.empty()) << c.id();
            EXPECT_FALSE(line.message.ends_with('.')) << c.id() << ": " << line.message;
            EXPECT_FALSE(line.message.ends_with("\n")) << c.id() << ": " << line.message;
        }
    }
}

TEST(ErrorRules, CausesDoNotShareAMessage) {
    std::map<std::string, std::pair<std::string, std::string>> owners;  // pattern → cause, case
    for (const Case& c : readAllCases()) {
        const std::vector<Headline> lines = c.headlines();
        for (std::size_t i = 0; i < std::min(lines.size(), c.causes.size()); ++i) {
            const auto [owner, isNew] =
                owners.emplace(messagePattern(lines[i].message), std::pair{c.causes[i], c.id()});
            EXPECT_EQ(owner->second.first, c.causes[i])
                << c.id() << " and " << owner->second.second << " say: " << owner->first;
        }
    }
}

TEST(ErrorRules, SeveralMistakesAreReportedInOneRun) {
    std::map<std::string, std::size_t> most;  // area → errors of its richest case
    for (const Case& c : readAllCases()) most[c.area] = std::max(most[c.area], c.headlines().size());
    for (const char* area : {"cocos", "pipelines", "planner", "effects", "materials", "scenes"})
        EXPECT_GE(most[area], 3u) << area;
}

TEST(ErrorRules, NoLibrarySpeaksForItself) {
    for (const Case& c : readAllCases()) {
        for (const char* text : {"json.exception", "yaml-cpp", "parse error", "syntax error, unexpected",
                                 "ERROR: ", "what():", "terminate", "std::", "tinygltf", "Failed to ", "failed to ",
                                 "CLI::", "basic_string", "filesystem error", "bad_alloc", "vk::", "VK_ERROR"})
            EXPECT_EQ(c.expected.find(text), std::string::npos) << c.id() << " says: " << text;
    }
}

TEST(ErrorRules, NoMachineIsNamed) {
    for (const Case& c : readAllCases()) {
        for (const char* text : {CREVICE_TEST_SOURCE_DIR, "/tmp/", "/home/", "/root/"})
            EXPECT_EQ(c.expected.find(text), std::string::npos) << c.id() << " says: " << text;
    }
}

/// Markdown: one table per area, a row per cause with the first message of it.
std::string tableOfCauses() {
    std::string text, area;
    std::set<std::string> seen;
    for (const Case& c : readAllCases()) {
        const std::vector<Headline> lines = c.headlines();
        for (std::size_t i = 0; i < std::min(lines.size(), c.causes.size()); ++i) {
            if (!seen.insert(c.causes[i]).second) continue;
            if (area != c.area) text += "\n### " + c.area + "\n\n| Cause | For example | Case |\n|---|---|---|\n";
            area = c.area;
            const std::string message = std::regex_replace(lines[i].message, std::regex("[|]"), "\\|");
            text += "| " + c.causes[i] + " | " + message + " | `" + c.id() + "` |\n";
        }
    }
    return text + "\n";
}

TEST(ErrorRules, TheDocumentListsAllCauses) {
    std::string document = readText(CREVICE_ERROR_DOCUMENT);
    const std::size_t begin = document.find(kTableBegin), end = document.find(kTableEnd);
    ASSERT_TRUE(begin != std::string::npos && end != std::string::npos && begin < end) << "docs/errors.md";
    const std::size_t first = begin + std::string(kTableBegin).size();
    const char* update = std::getenv("CREVICE_UPDATE_GOLDEN");
    if (update && std::string(update) == "1") {
        document.replace(first, end - first, tableOfCauses());
        std::ofstream(CREVICE_ERROR_DOCUMENT, std::ios::binary) << document;
        return;
    }
    EXPECT_EQ(document.substr(first, end - first), tableOfCauses())
        << "docs/errors.md is stale: run crevice_error_tests with CREVICE_UPDATE_GOLDEN=1 twice";
}

}  // namespace
}  // namespace crevice::errors
