// Words that a stage's macros may get from outside: from the options of a description, a material, a command line.
#pragma once

#include <string_view>
#include <unordered_set>
#include <vector>

#include "cocos/analysis/LiveFunctions.h"
#include "cocos/flatten/Flattener.h"

namespace crevice::cocos {

/// The options and the default of a description.
void addWordsOf(const DefineInfo& info, MacroBodies& bodies);

/// Adds options and defaults to `bodies`. Into `hints` go the macros that no description holds to options or numbers
/// and no condition takes for numbers, and the lines of `#pragma define`. `defined` are the names that the text defines
/// itself: nobody else gives them a value.
void readOutsideNames(const std::vector<FlatDirective>& directives, std::string_view text,
                      const std::unordered_set<std::string_view>& defined, MacroBodies& bodies, LiveHints& hints);

}  // namespace crevice::cocos
