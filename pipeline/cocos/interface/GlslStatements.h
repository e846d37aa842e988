// Splits a shader's text into the statements outside of functions, with its conditions left standing.
#pragma once

#include <cstddef>
#include <vector>

#include "effect/GlslText.h"

namespace crevice::cocos {

/// Indices of tokens. A statement that spans preprocessor lines has their tokens (`directive`) inside.
struct GlslStatement {
    std::size_t begin = 0, end = 0;    ///< From the first word to the semicolon.
    std::size_t brace = 0, close = 0;  ///< Of a block's or a struct's body; 0 = none.
    std::size_t storage = 0;           ///< The word in, out, uniform or buffer; equal to `end` when there is none.
    bool conditional = false;          ///< Stands between #if and #endif.
};

/// Statements that declare interface variables, blocks or structs, in text order. Braces need not balance across the
/// branches of a condition: each branch begins at the depth of its #if.
std::vector<GlslStatement> findInterfaceStatements(const std::vector<GlslToken>& tokens);

}  // namespace crevice::cocos
