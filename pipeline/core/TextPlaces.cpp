// Lines, columns and the check for plain UTF-8 that the document readers share.
#include "core/TextPlaces.h"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>

namespace crevice {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

bool isContinuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

/// Length of the well-formed UTF-8 sequence at `pos`, 0 when there is none (table 3-7 of the Unicode standard).
std::size_t utf8Length(std::string_view text, std::size_t pos) {
    const auto byte = [&](std::size_t i) {
        return pos + i < text.size() ? static_cast<unsigned char>(text[pos + i]) : 0u;
    };
    const auto continues = [&](std::size_t i) { return byte(i) >= 0x80 && byte(i) <= 0xbf; };
    const unsigned lead = byte(0);
    if (lead < 0x80) return 1;
    if (lead >= 0xc2 && lead <= 0xdf) return continues(1) ? 2 : 0;
    if (lead >= 0xe0 && lead <= 0xef) {
        const bool overlong = lead == 0xe0 && byte(1) < 0xa0;
        const bool surrogate = lead == 0xed && byte(1) > 0x9f;
        return continues(1) && continues(2) && !overlong && !surrogate ? 3 : 0;
    }
    if (lead >= 0xf0 && lead <= 0xf4) {
        const bool overlong = lead == 0xf0 && byte(1) < 0x90;
        const bool beyondUnicode = lead == 0xf4 && byte(1) > 0x8f;
        return continues(1) && continues(2) && continues(3) && !overlong && !beyondUnicode ? 4 : 0;
    }
    return 0;
}

}  // namespace

TextPlaces::TextPlaces(std::string_view text, std::string file, int firstLine)
    : text_(text), file_(std::move(file)), firstLine_(firstLine) {
    lineStarts_.push_back(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') lineStarts_.push_back(i + 1);
    }
}

SourceLoc TextPlaces::at(std::size_t begin, std::size_t end) const {
    begin = std::clamp(begin, lineStarts_.front(), std::max(text_.size(), lineStarts_.front()));
    const std::size_t line = lineOf(begin);
    SourceLoc where{file_, firstLine_ + static_cast<int>(line), columnOf(begin, lineStarts_[line]), 1};
    const std::size_t lineEnd = line + 1 < lineStarts_.size() ? lineStarts_[line + 1] - 1 : text_.size();
    end = std::min(end, lineEnd);
    if (end > begin) where.length = std::max(1, countCodePoints(text_.substr(begin, end - begin)));
    return where;
}

std::size_t TextPlaces::offsetOf(int line, int byteColumn) const {
    const auto index = static_cast<std::size_t>(std::max(line, 0));
    if (index >= lineStarts_.size()) return text_.size();
    return std::min(text_.size(), lineStarts_[index] + static_cast<std::size_t>(std::max(byteColumn, 0)));
}

std::size_t TextPlaces::lineOf(std::size_t offset) const {
    const auto after = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), offset);
    assert(after != lineStarts_.begin());
    return static_cast<std::size_t>(after - lineStarts_.begin()) - 1;
}

int TextPlaces::columnOf(std::size_t offset, std::size_t lineStart) const {
    const bool goesOn = last_.offset >= lineStart && last_.offset <= offset;
    const Cursor from = goesOn ? last_ : Cursor{lineStart, 1};
    last_ = {offset, from.column + countCodePoints(text_.substr(from.offset, offset - from.offset))};
    return last_.column;
}

int countCodePoints(std::string_view text) {
    return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) { return !isContinuation(c); }));
}

void checkDocumentSize(std::string_view text, const std::string& file, std::size_t maxBytes) {
    if (text.size() <= maxBytes) return;
    throw Error(SourceLoc{file, 0, 0, 1},
                fmt::format("the document has {} bytes, more than the {} that are read", text.size(), maxBytes),
                "split the document");
}

void checkPlainText(std::string_view text, const TextPlaces& places) {
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8Length(text, i);
        if (length == 0) {
            throw Error(places.at(i), "this byte is not UTF-8", "save the file with the encoding UTF-8");
        }
        const auto byte = static_cast<unsigned char>(text[i]);
        const bool control = (byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') || byte == 0x7f;
        if (control) {
            throw Error(places.at(i), fmt::format("a control character (0x{:02x}) stands in the text", byte),
                        "remove it; a text file holds none but tabs and line breaks");
        }
        i += length;
    }
}

}  // namespace crevice
