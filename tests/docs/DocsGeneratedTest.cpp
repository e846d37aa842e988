// What documents quote from the program is what it says today: parameter tables, help texts, the JSON Schema.
// CREVICE_UPDATE_DOCS=1 writes the quotations anew instead of comparing them.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "Markdown.h"

namespace crevice::docs {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = CREVICE_TEST_SOURCE_DIR;

bool updating() { return std::getenv("CREVICE_UPDATE_DOCS") != nullptr; }

std::string outputOf(const std::string& arguments) {
    FILE* pipe = popen((std::string(CREVICE_PROGRAM) + " " + arguments + " 2>/dev/null").c_str(), "r");
    if (!pipe) return "";
    std::string text;
    char buffer[4096];
    for (std::size_t size; (size = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, size);
    EXPECT_EQ(pclose(pipe), 0) << arguments;
    return text;
}

/// What stands between the marks for a command: tables as Markdown, everything else as a block of text. The heading of
/// a stage and the path of an effect are left to the document.
std::string quotation(const std::string& arguments) {
    std::string text = outputOf(arguments);
    if (arguments.ends_with("--markdown")) {
        const std::size_t priority = text.find("Priority: ");
        return "\n" + (priority == std::string::npos ? text : text.substr(priority));
    }
    if (arguments.starts_with("effects show ")) text.erase(0, text.find('\n') + 2);
    while (text.ends_with("\n\n")) text.pop_back();
    return "```\n" + text + "```\n";
}

/// The document with everything between `<!-- crevice ARGUMENTS -->` and `<!-- end -->` made anew.
std::string withQuotations(const std::string& markdown, int& count) {
    static const std::regex begin("^<!-- crevice (.*) -->$");
    std::ostringstream out;
    bool inside = false;
    for (const std::string& line : splitLines(markdown)) {
        std::smatch match;
        if (line == "<!-- end -->") inside = false;
        if (!inside) out << line << "\n";
        if (std::regex_match(line, match, begin)) {
            out << quotation(match[1]);
            inside = true;
            ++count;
        }
    }
    EXPECT_FALSE(inside) << "a mark <!-- end --> is missing";
    return out.str();
}

void expectText(const fs::path& path, const std::string& text) {
    if (updating()) {
        fs::create_directories(path.parent_path());
        std::ofstream(path) << text;
    }
    EXPECT_EQ(readText(path), text) << path << " is stale: CREVICE_UPDATE_DOCS=1 writes it anew";
}

TEST(DocsGenerated, QuotationsAreCurrent) {
    int count = 0;
    for (const fs::path& document : allDocuments()) {
        const std::string text = readText(document);
        if (text.find("<!-- crevice ") == std::string::npos) continue;
        expectText(document, withQuotations(text, count));
    }
    EXPECT_GE(count, 15);
}

TEST(DocsGenerated, SchemaIsCurrent) {
    expectText(kRoot / "assets" / "schema" / "pipeline.schema.json", outputOf("schema"));
}

std::vector<std::string> stageClasses() {
    std::vector<std::string> names;
    for (const std::string& line : splitLines(outputOf("stages"))) {
        if (line.find(" builtin ") != std::string::npos) names.push_back(line.substr(0, line.find(' ')));
    }
    return names;
}

TEST(DocsGenerated, EveryStageHasAPageWithItsParameters) {
    const std::vector<std::string> names = stageClasses();
    EXPECT_GE(names.size(), 10u);
    for (const std::string& name : names) {
        const fs::path page = kRoot / "docs" / "stages" / (name + ".md");
        ASSERT_TRUE(fs::exists(page)) << "stage class " << name << " has no " << page;
        const std::string text = readText(page);
        for (const std::string& line : splitLines(outputOf("stages " + name + " --markdown"))) {
            if (!line.starts_with("| ")) continue;
            EXPECT_NE(text.find(line), std::string::npos) << page << " lacks this row of its parameters:\n" << line;
        }
        for (const char* topic : {"eads", "rites"}) {
            EXPECT_NE(text.find(topic), std::string::npos) << page << " does not say what the stage " << topic;
        }
    }
}

TEST(DocsGenerated, EverySubcommandIsDescribed) {
    const std::string text = readText(kRoot / "docs" / "command-line.md");
    const std::string help = outputOf("--help");
    const std::size_t begin = help.find("Subcommands:\n");
    ASSERT_NE(begin, std::string::npos);
    int count = 0;
    for (const std::string& line : splitLines(help.substr(begin))) {
        std::smatch match;
        if (!std::regex_search(line, match, std::regex("^  ([a-z][a-z-]*)"))) continue;
        if (match[1] == "crevice") break;  // the examples
        EXPECT_NE(text.find("\n## " + match[1].str() + "\n"), std::string::npos) << match[1];
        ++count;
    }
    EXPECT_GE(count, 10);
}

}  // namespace
}  // namespace crevice::docs
