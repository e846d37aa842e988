// Finds where a shader's text declares and mentions its interface variables, for error messages and plans.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/Error.h"
#include "effect/GlslText.h"
#include "effect/Includes.h"

namespace crevice {

/// Names of one stage's text. Conditions are not evaluated: a name in an untaken branch counts as well.
class Declarations {
public:
    explicit Declarations(const FlatSource& source);

    /// Where a block, sampler, image or varying is declared; line 0 if nowhere.
    SourceLoc declared(std::string_view name) const;
    /// First mention of any of the names behind their declaration; line 0 if none.
    SourceLoc firstUse(std::string_view name, const std::vector<std::string>& members) const;
    /// Every word of the text once, sorted.
    std::vector<std::string> names() const;

private:
    struct Range {
        std::size_t begin = 0, end = 0;  ///< Tokens of the declaration, with the body of a block.
        std::size_t name = 0;
        std::size_t instance = 0;  ///< Token of a block's instance name; 0 = none.
    };
    void readDeclaration(std::size_t& at);
    SourceLoc locate(std::size_t token) const;

    const FlatSource& source_;
    std::vector<GlslToken> tokens_;
    std::unordered_map<std::string_view, Range> declared_;  ///< The names lie in the text.
};

}  // namespace crevice
