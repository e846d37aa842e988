// Widths are counted in code points, so that "≥" takes one column.
#include "app/commands/TextTable.h"

#include <algorithm>

#include "core/TextPlaces.h"

namespace crevice {
namespace {

std::size_t widthOf(const std::string& cell) { return static_cast<std::size_t>(countCodePoints(cell)); }

std::string escapeMarkdown(const std::string& cell) {
    std::string result;
    for (const char c : cell) {
        if (c == '|') result += '\\';
        result += c;
    }
    return result;
}

}  // namespace

std::string TextTable::text(std::size_t indent) const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows_) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], widthOf(row[i]));
    }
    std::string result;
    for (const auto& row : rows_) {
        std::string line(indent, ' ');
        for (std::size_t i = 0; i < row.size(); ++i) line += row[i] + std::string(widths[i] - widthOf(row[i]) + 2, ' ');
        line.erase(line.find_last_not_of(' ') + 1);
        result += line + "\n";
    }
    return result;
}

std::string TextTable::markdown() const {
    std::string result;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        result += "|";
        for (std::size_t i = 0; i < rows_.front().size(); ++i) {
            result += " " + (i < rows_[r].size() ? escapeMarkdown(rows_[r][i]) : "") + " |";
        }
        result += "\n";
        if (r != 0) continue;
        result += "|";
        for (std::size_t i = 0; i < rows_.front().size(); ++i) result += "---|";
        result += "\n";
    }
    return result;
}

}  // namespace crevice
