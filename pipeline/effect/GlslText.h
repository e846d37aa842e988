// GLSL as text: comments blanked, split into words, without knowing the grammar.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crevice {

struct GlslToken {
    std::string_view text;  ///< An identifier, a number, or one character.
    int line = 1;           ///< Counted from 1 in the text given.
    int column = 1;
    bool directive = false;  ///< Part of a preprocessor line (with its continuation lines).
    bool isName() const;
};

/// The text with comments and carriage returns replaced by spaces: lines and columns stay.
std::string blankComments(std::string_view text);

/// Words of a text without comments. The tokens point into it.
std::vector<GlslToken> tokenizeGlsl(std::string_view text);

/// Index behind the last token of the preprocessor line that begins at `first` (its '#').
std::size_t directiveEnd(const std::vector<GlslToken>& tokens, std::size_t first);

}  // namespace crevice
