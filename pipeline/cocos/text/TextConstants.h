// Whole numbers that stand in a shader's text: array sizes, with the object-like macros and constants they are made of.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "effect/GlslText.h"

namespace crevice::cocos {

/// What `#define NAME value` and `const int NAME = value` of one text say. Conditions are not evaluated.
class TextConstants {
public:
    struct Result {
        std::int64_t value = 0;
        bool certain = true;  ///< False: a name has several values, of which the largest was taken, or `# define`.
    };

    /// Takes in a whole text: a name may be defined below its use, in a branch or by a pragma. Function-like macros are
    /// no constants; `# define`, which Cocos' compiler leaves to the GLSL compiler, counts as uncertain.
    void addText(const std::vector<GlslToken>& tokens);
    /// A number from outside of the text, uncertain: what a macro may be at most.
    void addLimit(std::string_view name, std::int64_t largest) { limits_[name] = largest; }

    /// + - * / % << >> and parentheses over numbers and names. A macro's words take its name's place, as in C: with
    /// `#define A 1 + 1` A * 3 is 4; of one with several values each counts as a whole. Nothing when a name is unknown,
    /// a division is by zero, or names go round in circles.
    std::optional<Result> evaluate(const GlslToken* begin, const GlslToken* end) const;

private:
    friend class ConstantReader;
    void addDefine(const std::vector<GlslToken>& tokens, std::size_t first, std::size_t end);
    struct Range {
        const GlslToken* begin;
        const GlslToken* end;
        bool certain;
        bool macro;  ///< Words that take the name's place, no value.
    };
    std::map<std::string_view, std::vector<Range>> values_;
    std::map<std::string_view, std::int64_t> limits_;
};

}  // namespace crevice::cocos
