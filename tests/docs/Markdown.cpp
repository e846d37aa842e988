// Line by line: a fence opens and closes blocks, everything else is prose.
#include "Markdown.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>

namespace crevice::docs {
namespace {

namespace fs = std::filesystem;

bool isFence(const std::string& line) { return line.starts_with("```"); }

Block openBlock(const std::string& fence, int line) {
    const std::string words = fence.substr(3);
    const std::size_t space = words.find(' ');
    return {words.substr(0, space), space == std::string::npos ? "" : words.substr(space + 1), "", line};
}

/// Prose with the text of blocks and code spans blanked out, so that nothing in code counts as a link.
std::vector<std::string> proseLines(const std::string& markdown) {
    std::vector<std::string> lines = splitLines(markdown);
    bool inBlock = false;
    for (std::string& line : lines) {
        const bool fence = isFence(line);
        if (fence) inBlock = !inBlock;
        if (fence || inBlock) line.clear();
    }
    return lines;
}

}  // namespace

std::vector<std::string> splitLines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::vector<Block> blocksOf(const std::string& markdown) {
    std::vector<Block> blocks;
    bool inBlock = false;
    int number = 0;
    for (const std::string& line : splitLines(markdown)) {
        ++number;
        if (isFence(line)) {
            if (!inBlock) blocks.push_back(openBlock(line, number));
            inBlock = !inBlock;
        } else if (inBlock) {
            blocks.back().text += line + "\n";
        }
    }
    return blocks;
}

std::vector<Link> linksOf(const std::string& markdown) {
    static const std::regex code("`[^`]*`");
    static const std::regex link("\\]\\(([^)#\\s]*)(#([^)\\s]*))?\\)|<img[^>]* src=\"([^\"]*)\"");
    std::vector<Link> links;
    int number = 0;
    for (const std::string& line : proseLines(markdown)) {
        ++number;
        const std::string text = std::regex_replace(line, code, "code");
        for (std::sregex_iterator found(text.begin(), text.end(), link), end; found != end; ++found) {
            const std::smatch& match = *found;
            links.push_back({match[4].matched ? match[4].str() : match[1].str(), match[3].str(), number});
        }
    }
    return links;
}

std::vector<std::string> anchorsOf(const std::string& markdown) {
    std::vector<std::string> anchors;
    for (const std::string& line : proseLines(markdown)) {
        if (!line.starts_with("#")) continue;
        std::string anchor;
        for (const char c : line.substr(line.find_first_not_of("# "))) {
            const auto byte = static_cast<unsigned char>(c);
            if (c == ' ') anchor += '-';
            if (std::isalnum(byte) || c == '-' || c == '_' || byte >= 0x80) {
                anchor += static_cast<char>(std::tolower(byte));
            }
        }
        anchors.push_back(anchor);
    }
    return anchors;
}

std::vector<fs::path> allDocuments() {
    const fs::path root = CREVICE_TEST_SOURCE_DIR;
    std::vector<fs::path> documents{root / "README.md"};
    for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
        if (entry.path().extension() == ".md") documents.push_back(entry.path());
    }
    std::sort(documents.begin(), documents.end());
    return documents;
}

}  // namespace crevice::docs
