// Declarations that are handed to a macro: `IF_SHADOWS(uniform sampler2D map;)`.
#pragma once

#include <string_view>
#include <unordered_set>

#include "cocos/text/SourceText.h"

namespace crevice::cocos {

/// Names in front of brackets that hold an interface word (isInterfaceWord()), in code and in the bodies of macros.
/// They need be no macros: functions have `in` and `out` between theirs. Nothing else may stand between the brackets'
/// begin and the word than the rest of its statement.
std::unordered_set<std::string_view> callsWithDeclarations(const SourceText& source);

}  // namespace crevice::cocos
