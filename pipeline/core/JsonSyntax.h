// Explains in words what is wrong with JSON text at the place where the parser stopped.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/Error.h"
#include "core/TextPlaces.h"

namespace crevice {

/// A token of JSON text: bytes [begin, end).
struct JsonToken {
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// Skips spaces, line breaks and comments.
std::size_t skipJsonBlanks(std::string_view text, std::size_t pos);
/// The token that begins at or after `pos`: punctuation, a string with its quotes, or a run of other characters.
JsonToken jsonTokenAt(std::string_view text, std::size_t pos);

/// What the reader had understood when the parser refused the text.
struct JsonState {
    enum class After { Nothing, ObjectStart, Key, ArrayStart, ObjectValue, ArrayValue, Document };
    After after = After::Nothing;
    std::size_t begin = 0;  ///< of the last good token
    std::size_t end = 0;    ///< of the last good token
    std::string key;        ///< of the member being read
    SourceLoc opener;       ///< of the innermost open object or array
};

/// `stopByte` (offset) and `reason` come from the parser; the reason only chooses between our own texts.
Problem explainJsonSyntax(std::string_view text, const TextPlaces& places, const JsonState& state, std::size_t stopByte,
                          std::string_view reason);

}  // namespace crevice
