// Calls of macros whose brackets conditions cross: one call for each branch.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cocos/text/MacroCall.h"

namespace crevice::cocos {

struct CallBranches {
    struct Branch {
        std::string directive;
        FlatSource::Origin origin{};
        BodyLines lines;  ///< The whole call in this branch, and what follows it up to where all are closed.
    };
    std::vector<Branch> branches;   ///< Of the first condition between the brackets, an #else the last. Empty: no call.
    std::size_t line = 0, end = 0;  ///< Behind the ')' of the last that is closed.
    std::size_t bytes = 0;          ///< That were looked at.
};

/// Reads the call of `name`, behind which column `at` of line `line` lies. None where the brackets stay open in a
/// branch that ends, other preprocessor lines stand between them, or the text is too long.
CallBranches splitCall(const CodeLines& lines, std::size_t line, std::size_t at, std::string_view name,
                       std::size_t maxBytes);

}  // namespace crevice::cocos
