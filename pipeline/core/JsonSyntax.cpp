// Walks from the last good token to the mistake and chooses the message for it.
#include "core/JsonSyntax.h"

#include <algorithm>

#include <fmt/format.h>

namespace crevice {
namespace {

constexpr std::size_t kMaxQuotedBytes = 40;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$'; }
bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

class Explainer {
public:
    Explainer(std::string_view text, const TextPlaces& places, const JsonState& state, std::size_t stopByte,
              std::string_view reason)
        : text_(text), places_(places), state_(state), stop_(std::min(stopByte, text.size())), reason_(reason) {}

    Problem explain() const {
        const std::size_t pos = skipJsonBlanks(text_, state_.end);
        if (has(reason_, "invalid comment")) return commentProblem();
        // In `01` and `truefalse` the parser takes a good token and refuses the rest of the word.
        if (stop_ < state_.end) return valueProblem(state_.begin);
        switch (state_.after) {
            case JsonState::After::Nothing:
                return firstValueProblem(pos);
            case JsonState::After::ObjectStart:
                return keyProblem(pos);
            case JsonState::After::Key:
                return colonProblem(pos);
            case JsonState::After::ArrayStart:
                return valueProblem(pos);
            case JsonState::After::ObjectValue:
                return separatorProblem(pos, '}');
            case JsonState::After::ArrayValue:
                return separatorProblem(pos, ']');
            case JsonState::After::Document:
                break;
        }
        return problem(pos, fmt::format("unexpected {} after the end of the document", found(pos)),
                       "a JSON document is one value; remove what follows it");
    }

private:
    char charAt(std::size_t pos) const { return pos < text_.size() ? text_[pos] : '\0'; }

    std::string found(std::size_t pos) const {
        if (pos >= text_.size()) return "the end of the text";
        const JsonToken token = jsonTokenAt(text_, pos);
        std::string word(text_.substr(token.begin, std::min(token.end - token.begin, kMaxQuotedBytes)));
        if (token.end - token.begin > kMaxQuotedBytes) word += "…";
        if (word.front() == '"') {
            word.erase(0, 1);
            if (word.ends_with('"')) word.pop_back();
            return "the string '" + word + "'";
        }
        return word.front() == '\'' ? word : "'" + word + "'";
    }

    Problem problem(std::size_t pos, std::string message, std::string help) const {
        const std::size_t end = pos < text_.size() ? jsonTokenAt(text_, pos).end : pos;
        return Problem{Severity::Error, places_.at(pos, end), std::move(message), std::move(help), {}};
    }

    Problem endProblem(std::string expected) const {
        std::size_t last = text_.size();
        while (last > state_.end && isBlank(text_[last - 1])) --last;
        Problem result = problem(last, "the text ends where " + expected + " is expected", "complete the document");
        if (state_.opener.line > 0) result.remarks.push_back({state_.opener, "what is not closed begins here"});
        return result;
    }

    Problem firstValueProblem(std::size_t pos) const {
        if (pos < text_.size()) return valueProblem(pos);
        return problem(pos, "the document is empty", "a JSON document is one value, such as { }");
    }

    Problem keyProblem(std::size_t pos) const {
        if (pos >= text_.size()) return endProblem("a key or '}'");
        if (charAt(pos) == '"') return stringProblem(pos);
        if (charAt(pos) == ',') return problem(pos, "a comma stands where a key is expected", "remove the comma");
        return problem(pos, fmt::format("expected a key in double quotes, found {}", found(pos)),
                       "write keys as \"key\": value");
    }

    Problem colonProblem(std::size_t pos) const {
        if (pos >= text_.size()) return endProblem("':' and a value");
        if (charAt(pos) == ':') return valueProblem(skipJsonBlanks(text_, pos + 1));
        return problem(pos, fmt::format("expected ':' after key '{}', found {}", state_.key, found(pos)),
                       fmt::format("write \"{}\": value", state_.key));
    }

    Problem separatorProblem(std::size_t pos, char close) const {
        if (pos >= text_.size()) return endProblem(fmt::format("',' or '{}'", close));
        if (charAt(pos) == ',') {
            const std::size_t next = skipJsonBlanks(text_, pos + 1);
            if (charAt(next) == close) {
                return problem(pos, fmt::format("a comma stands before '{}'", close), "remove the comma");
            }
            if (next >= text_.size()) return endProblem(close == '}' ? "a key" : "a value");
            return close == '}' ? keyProblem(next) : valueProblem(next);
        }
        // The comma is missing where the value ended, which may be a line above the token that shows it.
        const std::string_view between = text_.substr(state_.end, pos - state_.end);
        const bool nextLine = has(between, "\n");
        Problem result = problem(nextLine ? state_.end : pos,
                                 fmt::format("expected ',' or '{}' after the value, found {}", close, found(pos)),
                                 fmt::format("separate {} by commas", close == '}' ? "members" : "items"));
        if (nextLine) result.where.length = 1;
        return result;
    }

    Problem valueProblem(std::size_t pos) const {
        if (pos >= text_.size()) return endProblem("a value");
        const char c = charAt(pos);
        if (c == '"') return stringProblem(pos);
        if (c == '\'') return problem(pos, "a string stands in single quotes", "write strings in double quotes");
        const JsonToken token = jsonTokenAt(text_, pos);
        const std::string_view word = text_.substr(token.begin, token.end - token.begin);
        if (has(word, "NaN") || has(word, "nan") || has(word, "Infinity") || has(word, "inf")) {
            return problem(pos, found(pos) + " is not a number that JSON can hold", "write a finite number");
        }
        if (c == '-' || c == '+' || c == '.' || (c >= '0' && c <= '9')) return numberProblem(pos);
        if (isLetter(c)) {
            return problem(pos, "unknown word " + found(pos),
                           "the words of JSON are true, false and null; strings stand in double quotes");
        }
        return problem(pos, fmt::format("expected a value, found {}", found(pos)),
                       "a value is a string, a number, true, false, null, [ ] or { }");
    }

    Problem numberProblem(std::size_t pos) const {
        if (has(reason_, "number overflow")) {
            return problem(pos, fmt::format("the number {} is too large", found(pos)), "the limit is about 1.8e308");
        }
        return problem(
            pos, found(pos) + " is not a number as JSON writes it",
            "write digits, then perhaps a fraction and an exponent: -12, 0.5, 1e-3; no leading '+', '.' or 0");
    }

    Problem stringProblem(std::size_t pos) const {
        Problem result = problem(stop_, "", "");
        result.where = places_.at(stop_, stop_ + 1);
        if (has(reason_, "ill-formed UTF-8")) {
            result.message = "the string holds a byte that is not UTF-8";
            result.help = "save the file with the encoding UTF-8";
        } else if (has(reason_, "missing closing quote") || charAt(stop_) == '\n' || charAt(stop_) == '\r') {
            result.where = places_.at(pos);
            result.message = "the string that begins here is not closed on its line";
            result.help = "close it with '\"'; write a line break as \\n";
        } else if (has(reason_, "control character")) {
            result.message = fmt::format("a control character (0x{:02x}) stands in a string",
                                         static_cast<unsigned>(static_cast<unsigned char>(charAt(stop_))));
            result.help = "write it as \\t or \\u00XX";
        } else if (has(reason_, "surrogate") || has(reason_, "hex digits")) {
            result.message = "'\\u' is not followed by a code point";
            result.help = "write four hexadecimal digits, and pairs of surrogates for code points above U+FFFF";
        } else {
            result.message = "this backslash begins no escape";
            result.help = "the escapes are \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\uXXXX; write a backslash as \\\\";
        }
        return result;
    }

    Problem commentProblem() const {
        std::size_t slash = std::min(stop_, text_.size());
        while (slash > state_.end && charAt(slash) != '/') --slash;
        const bool open = has(reason_, "missing closing");
        if (open) slash = std::max(state_.end, text_.rfind("/*"));
        return problem(slash, open ? "the comment that begins here is not closed" : "this '/' begins no comment",
                       "comments are '// to the end of the line' or '/* between */'");
    }

    std::string_view text_;
    const TextPlaces& places_;
    const JsonState& state_;
    std::size_t stop_;
    std::string_view reason_;
};

}  // namespace

std::size_t skipJsonBlanks(std::string_view text, std::size_t pos) {
    while (pos < text.size()) {
        if (isBlank(text[pos])) {
            ++pos;
        } else if (text.substr(pos).starts_with("//")) {
            pos = std::min(text.find_first_of("\r\n", pos), text.size());
        } else if (text.substr(pos).starts_with("/*")) {
            const std::size_t close = text.find("*/", pos + 2);
            if (close == std::string_view::npos) return text.size();
            pos = close + 2;
        } else {
            break;
        }
    }
    return std::min(pos, text.size());
}

JsonToken jsonTokenAt(std::string_view text, std::size_t pos) {
    pos = skipJsonBlanks(text, pos);
    if (pos >= text.size()) return {text.size(), text.size()};
    std::size_t end = pos + 1;
    if (text[pos] == '"') {
        while (end < text.size() && text[end] != '"' && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
        return {pos, std::min(end + 1, text.size())};
    }
    constexpr std::string_view kPunctuation = "{}[],:";
    if (kPunctuation.find(text[pos]) != std::string_view::npos) return {pos, end};
    return {pos, std::min(text.find_first_of("{}[],:\" \t\r\n/", end), text.size())};
}

Problem explainJsonSyntax(std::string_view text, const TextPlaces& places, const JsonState& state, std::size_t stopByte,
                          std::string_view reason) {
    return Explainer(text, places, state, stopByte, reason).explain();
}

}  // namespace crevice
