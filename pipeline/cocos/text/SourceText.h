// A program or chunk as the flattener wants it: comments blanked, split into lines, its macros taken apart. Read once,
// used by every stage that includes it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace crevice::cocos {

enum class LineKind : std::uint8_t {
    Code,
    Include,
    Define,
    Undef,
    If,
    Ifdef,
    Ifndef,
    Elif,
    Else,
    Endif,
    Pragma,
    PragmaDefine,
    Dropped,  ///< #version and #line: ours alone.
    Other     ///< #extension, #error
};

/// True for #if, #ifdef, #ifndef, #elif, #else, #endif.
bool isConditional(LineKind kind);

/// A preprocessor line's kind and what follows its word; Code when `text` is none.
struct Directive {
    LineKind kind = LineKind::Code;
    std::string_view rest;  ///< Trimmed, to the end of the line, without a continuation's backslash.
};
Directive readDirective(std::string_view text);

struct SourceLine {
    std::string_view text;  ///< Without the line end.
    int line = 1;           ///< Of the file.
    LineKind kind = LineKind::Code;
    std::uint32_t span = 1;    ///< A directive with its continuation lines, which are the next entries.
    int macro = -1;            ///< Define, PragmaDefine: index into `macros`.
    bool conditional = false;  ///< Include: stands in a condition that is no include guard.
};

struct MacroDefinition {
    struct BodyLine {
        std::string_view text;
        int line = 1;  ///< Of the file.
    };
    std::string_view name;
    bool functionLike = false;
    bool fromPragma = false;
    bool bearsDirectives = false;  ///< A line of the body is a preprocessor line: GLSL's own preprocessor has no such.
    bool declares = false;         ///< The body holds a part of a declaration: in, out, uniform, buffer, a brace alone.
    bool dead = false;             ///< In a branch that no text of version 450 takes.
    bool conditional = false;      ///< In a condition that is no include guard: it may not hold.
    bool adoptsNextLine = false;   ///< `#define f(x)` and nothing behind it: the next line is the body.
    std::vector<std::string_view> parameters;
    std::vector<BodyLine> body;
    const struct SourceText* source = nullptr;
};

struct SourceText {
    std::string shown;  ///< Name in messages.
    std::string file;
    std::filesystem::path folder;
    std::string text;
    std::vector<SourceLine> lines;  ///< Without blank ones.
    std::vector<MacroDefinition> macros;
    std::unordered_set<std::string_view> splitCalls;      ///< Names in front of brackets that a condition stands in.
    std::unordered_set<std::string_view> declaringCalls;  ///< callsWithDeclarations()

    SourceText() = default;
    SourceText(const SourceText&) = delete;
    SourceText& operator=(const SourceText&) = delete;
};

/// `firstLine` is the line of `file` on which `text` begins.
std::unique_ptr<SourceText> readSource(std::string_view text, const std::string& shown, const std::string& file,
                                       const std::filesystem::path& folder, int firstLine);

/// Finds the calls that are open at a place: reads back from it, line by line.
class OpenCalls {
public:
    /// Takes the names in front of the brackets.
    explicit OpenCalls(std::unordered_set<std::string_view>& names) : names_(names) {}
    /// False when the statement begins in this line.
    bool readBack(std::string_view text);

private:
    std::unordered_set<std::string_view>& names_;
    std::size_t closed_ = 0;
    bool nameAbove_ = false;  ///< In front of a '(' that begins a line.
};
constexpr std::size_t kMostCallLines = 200;  ///< That one call reaches over, where conditions stand in it.

/// No preprocessor line, nor the continuation of one.
bool isCodeLine(const SourceText& source, std::size_t at);

/// `#define NAME(parameters) body` in one line.
std::string defineLine(const MacroDefinition& macro);

/// in, out, uniform, buffer, attribute, varying.
bool isInterfaceWord(std::string_view word);

/// Stands in front of a macro's name that is not expanded any more, while its line is put together.
constexpr char kFinal = '\1';

std::string_view trimBlank(std::string_view text);
/// The name at the front of a text, or nothing.
std::string_view leadingName(std::string_view text);
/// The name or number that ends in front of `at`, over blanks and line ends; a part of `text`, perhaps empty.
std::string_view nameBefore(std::string_view text, std::size_t at);
constexpr bool isNameStart(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
inline constexpr std::array<bool, 256> kNameParts = [] {
    std::array<bool, 256> parts{};
    for (std::size_t c = 0; c < 128; ++c) parts[c] = isNameStart(static_cast<char>(c)) || (c >= '0' && c <= '9');
    return parts;
}();
/// Asked of nearly every character of every text, hence a table.
inline bool isNamePart(char c) { return kNameParts[static_cast<unsigned char>(c)]; }

/// Behind a macro's name, does the tail make `#pragma define` a description (Cocos up to 3.4) instead of a macro?
bool isMetaTail(std::string_view tail);

}  // namespace crevice::cocos
