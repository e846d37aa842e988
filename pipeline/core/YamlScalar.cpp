// Types of plain scalars by YAML 1.2, and the table of syntax messages.
#include "core/YamlScalar.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

namespace crevice {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

std::size_t skipDigits(std::string_view text, std::size_t pos) {
    while (pos < text.size() && isDigit(text[pos])) ++pos;
    return pos;
}

/// [-+]? ( \. [0-9]+ | [0-9]+ ( \. [0-9]* )? ) ( [eE] [-+]? [0-9]+ )?
bool looksLikeDecimal(std::string_view text) {
    std::size_t pos = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
    const std::size_t whole = skipDigits(text, pos);
    const bool hasWhole = whole > pos;
    pos = whole;
    if (pos < text.size() && text[pos] == '.') {
        const std::size_t fraction = skipDigits(text, pos + 1);
        if (!hasWhole && fraction == pos + 1) return false;
        pos = fraction;
    } else if (!hasWhole) {
        return false;
    }
    if (pos < text.size() && (text[pos] == 'e' || text[pos] == 'E')) {
        ++pos;
        if (pos < text.size() && (text[pos] == '-' || text[pos] == '+')) ++pos;
        const std::size_t exponent = skipDigits(text, pos);
        if (exponent == pos) return false;
        pos = exponent;
    }
    return pos == text.size();
}

std::optional<std::int64_t> parseInteger(std::string_view digits, int base) {
    std::int64_t value = 0;
    const char* end = digits.data() + digits.size();
    const auto result = std::from_chars(digits.data(), end, value, base);
    if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
    return value;
}

/// 0x1f and 0o17.
std::optional<Value> readPrefixedInteger(std::string_view text, const SourceLoc& where) {
    const bool hex = text.starts_with("0x");
    if (!hex && !text.starts_with("0o")) return std::nullopt;
    const std::string_view digits = text.substr(2);
    if (digits.empty() || digits.front() == '-') return std::nullopt;
    const bool valid = digits.find_first_not_of(hex ? "0123456789abcdefABCDEF" : "01234567") == std::string_view::npos;
    if (!valid) return std::nullopt;
    if (const auto value = parseInteger(digits, hex ? 16 : 8)) return Value::makeInteger(*value, where);
    throw Error(where, fmt::format("the number '{}' is too large", text), "the limit is 0x7fffffffffffffff");
}

Value readDecimal(std::string_view text, const SourceLoc& where) {
    const std::string_view unsignedPlus = text.starts_with('+') ? text.substr(1) : text;
    if (unsignedPlus.find_first_of(".eE") == std::string_view::npos) {
        if (const auto value = parseInteger(unsignedPlus, 10)) return Value::makeInteger(*value, where);
    }
    double value = 0;
    const auto result = std::from_chars(unsignedPlus.data(), unsignedPlus.data() + unsignedPlus.size(), value);
    if (result.ec == std::errc::result_out_of_range) {
        throw Error(where, fmt::format("the number '{}' is too large or too small", text),
                    "the limits are about 1.8e308 and 5e-324");
    }
    return Value::makeReal(value, where);
}

bool isOneOf(std::string_view text, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), text) != words.end();
}

bool isInfiniteOrNan(std::string_view text) {
    if (isOneOf(text, {".nan", ".NaN", ".NAN"})) return true;
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    return isOneOf(text, {".inf", ".Inf", ".INF"});
}

struct SyntaxText {
    std::string_view reason;  // how the parser's message begins
    std::string_view message;
    std::string_view help;
};

constexpr SyntaxText kSyntaxTexts[] = {
    {"end of map not found", "this line does not fit the object it stands in",
     "write 'key: value' with the indentation of the keys above"},
    {"end of sequence not found", "this line does not fit the list it stands in",
     "begin items with '- ' and the indentation of the items above"},
    {"end of map flow", "the object that begins with '{' is not closed before this",
     "close it with '}'; commas between members"},
    {"end of sequence flow", "the list that begins with '[' is not closed before this",
     "close it with ']'; commas between items"},
    {"illegal EOF in scalar", "the text ends inside quotes", "close the quotes"},
    {"illegal document indicator", "'---' or '...' stands inside quotes", "close the quotes before it"},
    {"illegal map value", "a ':' stands where no key is before it", "put text that holds ': ' into quotes"},
    {"illegal map key", "a key cannot begin here", "begin keys on their own line, or write { key: value }"},
    {"illegal block entry", "a list item cannot begin here", "begin items on their own line, or write [ a, b ]"},
    {"illegal flow end", "this bracket closes nothing", "remove it, or open it before"},
    {"unknown escape character", "this backslash begins no escape", "write a backslash as \\\\, or use single quotes"},
    {"bad character found while scanning hex", "an escape lacks hexadecimal digits", "write \\xXX or \\uXXXX"},
    {"invalid unicode", "an escape names no code point", "write \\uXXXX with a valid code point"},
    {"the referenced anchor is not defined", "this alias names no anchor above it",
     "write &name at the value to repeat, before it"},
    {"alias not found after *", "a '*' is not followed by the name of an anchor",
     "put text that begins with '*' into quotes"},
    {"anchor not found after &", "a '&' is not followed by a name", "put text that begins with '&' into quotes"},
    {"cannot assign multiple anchors", "a value has two anchors", "remove one of them"},
    {"cannot assign multiple tags", "a value has two tags", "remove one of them"},
    {"unknown token", "this character cannot begin a value", "put text that begins with '@', '`' or '%' into quotes"},
    {"bad file", "the document nests too deeply", "flatten the document"},
};

}  // namespace

Value readPlainYamlScalar(const std::string& text, const SourceLoc& where) {
    if (isOneOf(text, {"true", "True", "TRUE"})) return Value::makeBool(true, where);
    if (isOneOf(text, {"false", "False", "FALSE"})) return Value::makeBool(false, where);
    if (isInfiniteOrNan(text)) {
        throw Error(where, fmt::format("'{}' is not a finite number", text), "write a finite number");
    }
    if (auto number = readPrefixedInteger(text, where)) return *std::move(number);
    if (looksLikeDecimal(text)) return readDecimal(text, where);
    return Value::makeString(text, where);
}

Value readTaggedYamlScalar(const std::string& tag, const std::string& text, const SourceLoc& where) {
    if (tag == "!" || tag == "tag:yaml.org,2002:str") return Value::makeString(text, where);
    throw Error(where, fmt::format("tag '{}' is not known here", tag), "remove the tag; quotes make a string");
}

Problem explainYamlSyntax(std::string_view text, const TextPlaces& places, std::size_t offset,
                          std::string_view reason) {
    // The parser sometimes stops at the line break after the mistake's line or at the end of the text.
    const bool unknownPlace = offset == 0 && reason.starts_with("end of");
    std::size_t begin = unknownPlace ? text.size() : std::min(offset, text.size());
    if (begin == text.size()) {
        while (begin > 0 && (text[begin - 1] == '\n' || text[begin - 1] == '\r' || text[begin - 1] == ' ')) --begin;
    }
    const std::size_t end = std::min(text.find_first_of(" \r\n,", begin), text.size());
    Problem problem{Severity::Error,
                    places.at(begin, end),
                    "this is not valid YAML",
                    "check the indentation, brackets and quotes",
                    {}};
    for (const SyntaxText& entry : kSyntaxTexts) {
        if (!reason.starts_with(entry.reason)) continue;
        problem.message = entry.message;
        problem.help = entry.help;
    }
    return problem;
}

}  // namespace crevice
