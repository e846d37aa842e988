// One walk: what joins to the last character written goes in front of the splices that part them.
#include "cocos/text/Splices.h"

#include <string_view>
#include <utility>

#include "cocos/text/SourceText.h"

namespace crevice::cocos {
namespace {

bool joins(char a, char b) {
    const auto isWord = [](char c) { return isNamePart(c) || c == '.'; };
    const auto isOperator = [](char c) { return std::string_view("+-*/%&|^<>=!~").find(c) != std::string_view::npos; };
    if (isWord(a)) return isWord(b) || (b == '(' && a != '.');
    return (isOperator(a) && isOperator(b)) || (a == '#' && b == '#');
}

/// Behind the line end, when a backslash at `at` stands in front of one; `at` when not. Blanks between them are let
/// pass, as everywhere in Cocos' texts.
std::size_t endOfSplice(std::string_view text, std::size_t at) {
    if (text[at] != '\\') return at;
    const std::size_t end = text.find_first_not_of(" \t\v\f", at + 1);
    return end != std::string_view::npos && text[end] == '\n' ? end + 1 : at;
}

}  // namespace

std::string joinParted(std::string text) {
    if (text.find('\\') == std::string::npos) return text;
    std::string out, held;  // held: splices behind the last character of `out`.
    out.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        if (const std::size_t end = endOfSplice(text, at); end > at) {
            held.append(text, at, end - at);
            at = end;
            continue;
        }
        if (!held.empty() && (out.empty() || !joins(out.back(), text[at]))) out += std::exchange(held, {});
        out += text[at++];
    }
    return out += held;
}

}  // namespace crevice::cocos
