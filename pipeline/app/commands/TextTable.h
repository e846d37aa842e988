// Rows of words in aligned columns, as text for terminals or as Markdown.
#pragma once

#include <string>
#include <vector>

namespace crevice {

class TextTable {
public:
    /// The first row is the heading. Rows may be shorter than it.
    void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    bool empty() const { return rows_.size() < 2; }
    /// Columns two spaces apart, each line indented by `indent` spaces.
    std::string text(std::size_t indent = 0) const;
    std::string markdown() const;

private:
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace crevice
