// GLSL as text: comments blanked, split into words.
#include "effect/GlslText.h"

#include <array>
#include <cstdint>

namespace crevice {
namespace {

enum CharClass : std::uint8_t { kOther, kSpace, kLetter, kDigit };

/// ASCII only, whatever the locale.
constexpr std::array<CharClass, 256> kClasses = [] {
    std::array<CharClass, 256> classes{};
    for (const char c : {' ', '\t', '\n', '\v', '\f', '\r'}) classes[static_cast<unsigned char>(c)] = kSpace;
    for (unsigned c = '0'; c <= '9'; ++c) classes[c] = kDigit;
    for (unsigned c = 'a'; c <= 'z'; ++c) classes[c] = classes[c - 'a' + 'A'] = kLetter;
    classes['_'] = kLetter;
    return classes;
}();

CharClass classOf(char c) { return kClasses[static_cast<unsigned char>(c)]; }
bool isNamePart(char c) { return classOf(c) >= kLetter; }
bool isDigit(char c) { return classOf(c) == kDigit; }

/// End of the number that begins at `at`: digits, letters, dots, and a sign behind an exponent's e.
std::size_t numberEnd(std::string_view text, std::size_t at) {
    const bool hex = text.substr(at, 2) == "0x" || text.substr(at, 2) == "0X";
    while (at < text.size()) {
        const char c = text[at];
        const bool sign = !hex && (c == '+' || c == '-') && (text[at - 1] == 'e' || text[at - 1] == 'E');
        if (!isNamePart(c) && c != '.' && !sign) break;
        ++at;
    }
    return at;
}

}  // namespace

bool GlslToken::isName() const { return !text.empty() && classOf(text.front()) == kLetter; }

std::string blankComments(std::string_view text) {
    std::string out(text);
    enum class In { Code, Line, Block } in = In::Code;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const char c = out[i];
        const char next = i + 1 < out.size() ? out[i + 1] : '\0';
        if (c == '\r') out[i] = ' ';
        if (in == In::Code && c == '/' && (next == '/' || next == '*')) {
            in = next == '/' ? In::Line : In::Block;
            out[i] = out[i + 1] = ' ';
            ++i;
        } else if (in == In::Line && c == '\n') {
            in = In::Code;
        } else if (in == In::Block && c == '*' && next == '/') {
            in = In::Code;
            out[i] = out[i + 1] = ' ';
            ++i;
        } else if (in != In::Code && c != '\n') {
            out[i] = ' ';
        }
    }
    return out;
}

std::vector<GlslToken> tokenizeGlsl(std::string_view text) {
    std::vector<GlslToken> tokens;
    tokens.reserve(text.size() / 4);
    int line = 1;
    std::size_t lineStart = 0;
    bool directive = false, blankSoFar = true;
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (c == '\n') {
            // A backslash as the last character of a line joins the next one to it.
            std::size_t last = i;
            while (directive && last > lineStart && (text[last - 1] == ' ' || text[last - 1] == '\t')) --last;
            directive = directive && last != lineStart && text[last - 1] == '\\';
            ++line;
            lineStart = ++i;
            blankSoFar = true;
            continue;
        }
        if (classOf(c) == kSpace || c == '\\') {
            ++i;
            continue;
        }
        if (c == '#' && blankSoFar) directive = true;
        blankSoFar = false;
        std::size_t end = i + 1;
        if (classOf(c) == kLetter) {
            while (end < text.size() && isNamePart(text[end])) ++end;
        } else if (isDigit(c) || (c == '.' && end < text.size() && isDigit(text[end]))) {
            end = numberEnd(text, i + 1);
        }
        tokens.push_back({text.substr(i, end - i), line, static_cast<int>(i - lineStart) + 1, directive});
        i = end;
    }
    return tokens;
}

std::size_t directiveEnd(const std::vector<GlslToken>& tokens, std::size_t first) {
    std::size_t end = first + 1;
    // Two directives in a row differ by the '#' that begins the second one on a later line.
    while (end < tokens.size() && tokens[end].directive &&
           !(tokens[end].text == "#" && tokens[end].line > tokens[end - 1].line))
        ++end;
    return end;
}

}  // namespace crevice
