// Turns byte offsets of a text into lines and columns (in code points), for the document readers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/Error.h"

namespace crevice {

class TextPlaces {
public:
    /// `text` must outlive this object. A byte order mark does not count as a column.
    TextPlaces(std::string_view text, std::string file, int firstLine = 1);

    /// The place of a byte; `end` > `begin` underlines up to there, at most to the end of the line.
    /// Cheap when offsets ascend, as they do while a text is read.
    SourceLoc at(std::size_t begin, std::size_t end = 0) const;
    /// Byte offset of a line and a byte column, both from 0 (as yaml-cpp counts); clamped to the text.
    std::size_t offsetOf(int line, int byteColumn) const;
    const std::string& file() const { return file_; }

private:
    struct Cursor {
        std::size_t offset = 0;
        int column = 1;
    };
    std::size_t lineOf(std::size_t offset) const;
    int columnOf(std::size_t offset, std::size_t lineStart) const;

    std::string_view text_;
    std::string file_;
    int firstLine_;
    std::vector<std::size_t> lineStarts_;
    mutable Cursor last_;  // the previous answer, so that long lines are not counted again from their start
};

/// The number of code points in UTF-8 text.
int countCodePoints(std::string_view text);

/// Throws Error when the file is larger than a document may be.
void checkDocumentSize(std::string_view text, const std::string& file, std::size_t maxBytes);

/// Throws Error at the first byte that is not UTF-8 or is a control character other than tab and line break.
void checkPlainText(std::string_view text, const TextPlaces& places);

}  // namespace crevice
