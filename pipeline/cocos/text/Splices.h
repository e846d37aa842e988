// Words that a backslash at a line's end parts: the language joins them without a blank.
#pragma once

#include <string>

namespace crevice::cocos {

/// Moves the rest of a parted name, number or operator, and a macro's '(', up to the line on which it begins (C and
/// GLSL 4.20, section 3.1: the backslash and the line end are taken away before words are read). Lines keep their
/// number, and the backslash stays at the end of the first. `text` has no comments.
std::string joinParted(std::string text);

}  // namespace crevice::cocos
