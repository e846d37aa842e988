// As much of Markdown as the tests of the documents need: fenced blocks, links, headings.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/Files.h"

namespace crevice::docs {

struct Block {
    std::string language;  ///< The first word behind the three backquotes.
    std::string file;      ///< The second: the block is that file.
    std::string text;
    int line = 0;  ///< Of the opening fence, from 1.
};

struct Link {
    std::string target;  ///< Without "#heading".
    std::string anchor;
    int line = 0;
};

std::vector<std::string> splitLines(const std::string& text);
std::vector<Block> blocksOf(const std::string& markdown);
/// Links and images outside of fenced blocks and code spans.
std::vector<Link> linksOf(const std::string& markdown);
/// The names by which headings are linked to: lower case, spaces as "-", other signs left out.
std::vector<std::string> anchorsOf(const std::string& markdown);
/// README.md and everything below docs/, sorted.
std::vector<std::filesystem::path> allDocuments();

}  // namespace crevice::docs
