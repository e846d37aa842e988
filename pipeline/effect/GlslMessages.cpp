// Turns glslang's log into problems at the author's file and line.
#include "effect/GlslMessages.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <sstream>

#include "core/Text.h"
#include "effect/Declarations.h"
#include "effect/GlslTypeText.h"

namespace crevice {
namespace {

/// "ERROR: 0:12: 'word' : what is wrong" taken apart.
struct Message {
    bool error = false;
    int line = 0;
    std::string word, text;
};

std::optional<Message> parseMessage(std::string_view line) {
    Message message;
    if (line.starts_with("ERROR: "))
        message.error = true;
    else if (!line.starts_with("WARNING: "))
        return std::nullopt;
    line.remove_prefix(message.error ? 7 : 9);
    const auto colon = line.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const char* end = line.data() + line.size();
    const auto [rest, error] = std::from_chars(line.data() + colon + 1, end, message.line);
    if (error != std::errc{} || rest == end || *rest != ':') return std::nullopt;
    line = std::string_view(rest + 1, static_cast<std::size_t>(end - rest - 1));
    if (line.starts_with(' ')) line.remove_prefix(1);
    const auto close = line.find("' : ");
    if (line.starts_with('\'') && close != std::string_view::npos) {
        message.word = line.substr(1, close - 1);
        line.remove_prefix(close + 4);
    }
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    message.text = plainGlslTypes(std::string(line));
    while (!message.text.empty() && message.text.back() == ' ') message.text.pop_back();
    return message;
}

std::vector<std::string_view> splitLines(std::string_view text) {
    std::vector<std::string_view> lines;
    for (std::size_t at = 0; at < text.size();) {
        const auto end = std::min(text.find('\n', at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

/// Column and width of a word in a line of the stage's text; the whole line when it is not there.
SourceLoc placeOf(const StageSource& source, int line, std::string_view word) {
    const auto lines = splitLines(source.text);
    if (line < 1 || line > static_cast<int>(lines.size())) return source.flat.locate(line);
    const std::string_view text = lines[static_cast<std::size_t>(line) - 1];
    auto at = word.empty() ? std::string_view::npos : text.find(word);
    auto length = word.size();
    if (at == std::string_view::npos) {
        at = std::min(text.find_first_not_of(" \t"), text.size());
        length = std::max<std::size_t>(1, text.substr(at).size());
    }
    return source.flat.locate(line, static_cast<int>(at) + 1, static_cast<int>(length));
}

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// "uniform vec3 x;" without a block: the name that should move into one.
std::string looseUniformName(const StageSource& source, int line) {
    const auto lines = splitLines(source.text);
    if (line < 1 || line > static_cast<int>(lines.size())) return {};
    const auto tokens = tokenizeGlsl(lines[static_cast<std::size_t>(line) - 1]);
    for (std::size_t i = 1; i < tokens.size(); ++i)
        if ((tokens[i].text == ";" || tokens[i].text == "[" || tokens[i].text == "=") && tokens[i - 1].isName())
            return std::string(tokens[i - 1].text);
    return {};
}

constexpr std::string_view kSyntaxError = "syntax error";

/// A token of glslang's grammar as it stands in a program: SEMICOLON → ';', RETURN → 'return'.
std::string plainToken(const std::string& token) {
    static const std::map<std::string, std::string, std::less<>> kTokens = {{"COMMA", "','"},
                                                                            {"SEMICOLON", "';'"},
                                                                            {"LEFT_PAREN", "'('"},
                                                                            {"RIGHT_PAREN", "')'"},
                                                                            {"LEFT_BRACE", "'{'"},
                                                                            {"RIGHT_BRACE", "'}'"},
                                                                            {"LEFT_BRACKET", "'['"},
                                                                            {"RIGHT_BRACKET", "']'"},
                                                                            {"EQUAL", "'='"},
                                                                            {"COLON", "':'"},
                                                                            {"DOT", "'.'"},
                                                                            {"IDENTIFIER", "a name"},
                                                                            {"INTCONSTANT", "a number"},
                                                                            {"FLOATCONSTANT", "a number"},
                                                                            {"$end", "the end of the program"}};
    if (const auto known = kTokens.find(token); known != kTokens.end()) return known->second;
    return "'" + lowerCase(token) + "'";
}

/// "syntax error, unexpected RETURN, expecting COMMA or SEMICOLON" → "unexpected 'return', expected ',' or ';'".
std::string plainSyntax(const std::string& text) {
    std::istringstream words(text.substr(std::min(text.size(), kSyntaxError.size() + 2)));
    std::string plain;
    for (std::string word; words >> word;) {
        const bool comma = word.ends_with(',');
        if (comma) word.pop_back();
        const bool isToken =
            word == "$end" || std::any_of(word.begin(), word.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
        plain += (plain.empty() ? "" : " ") + (word == "expecting" ? "expected" : isToken ? plainToken(word) : word);
        if (comma) plain += ',';
    }
    return plain.empty() ? "this cannot be read" : plain;
}

std::string adviceFor(std::string_view text) {
    if (text == "undeclared identifier") return "declare it, or include the chunk that does";
    if (contains(text, "function return type") || contains(text, "function's return type"))
        return "return a value of the type that the function declares";
    if (contains(text, "cannot convert")) return conversionAdvice(std::string(text));
    if (contains(text, "constructor") || contains(text, "construction"))
        return "give as many components as the type has";
    if (contains(text, "no matching overloaded function"))
        return "check the function's name and the types of its arguments";
    return "programs are GLSL 4.50 for Vulkan: see docs/effect-format.md";
}

std::string_view lineOf(const StageSource& source, int line) {
    const auto lines = splitLines(source.text);
    return line < 1 || line > static_cast<int>(lines.size()) ? std::string_view()
                                                             : lines[static_cast<std::size_t>(line) - 1];
}

/// A character that stands in no GLSL program outside of its comments: where and what it is.
std::optional<Problem> strangeCharacter(const StageSource& source, int line) {
    const std::string_view text = lineOf(source, line);
    const auto isStrange = [](char c) {
        return static_cast<unsigned char>(c) >= 0x7f || (c >= 0 && c < ' ' && c != '\t');
    };
    const auto at = std::find_if(text.begin(), text.end(), isStrange);
    if (at == text.end()) return std::nullopt;
    SourceLoc where = source.flat.locate(line, static_cast<int>(at - text.begin()) + 1, 1);
    return Problem{Severity::Error, where,
                   fmt::format("the byte 0x{:02x} is no part of GLSL", static_cast<unsigned char>(*at)),
                   "outside of comments only ASCII is allowed: look for full-width brackets, commas and blanks"};
}

/// Functions of GLSL ES 1, which Cocos' older effects still call.
std::string adviceForOldFunctions(std::string_view line) {
    for (const auto& [old, now] : {std::pair{"texture2DLod(", "textureLod"},
                                   {"textureCubeLod(", "textureLod"},
                                   {"texture2DProj(", "textureProj"},
                                   {"texture2D(", "texture"},
                                   {"textureCube(", "texture"}}) {
        if (!contains(line, old)) continue;
        const std::string_view name(old);
        return fmt::format("GLSL 4.50 has {}() instead of {}()", now, name.substr(0, name.size() - 1));
    }
    return {};
}

/// A function that is a macro of the stage too: GLSL does not expand a macro within itself.
bool isMacroOf(const StageSource& source, const std::string& name) {
    return !name.empty() && contains(source.text, "#define " + name + "(");
}

/// An #if or #elif whose expression glslang could not read; it names the line behind.
Problem describeCondition(const StageSource& source, int line) {
    const auto isCondition = [&](int at) {
        std::string_view text = lineOf(source, at);
        text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
        return text.starts_with("#if") || text.starts_with("#elif");
    };
    while (line > 1 && !isCondition(line)) --line;
    return {Severity::Error, placeOf(source, line, {}), "this condition is no complete expression",
            "close its brackets, and give every operator its two sides"};
}

/// Link messages in one line, names in single quotes.
std::string plainLink(std::string text) {
    const auto replace = [&](std::string_view from, std::string_view to) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
    };
    replace("Linking vertex and fragment stages: ", "");
    replace(":;", ":");
    replace("\" ", "'");
    replace("\"", "'");
    replace("Types must match", "types must match");
    return text;
}

/// glslang's own name of what the line does, and no word of the program: 'assign' and 'constructor' may be either.
bool isOperation(const Message& message, std::string_view line) {
    if (message.word == "=") return true;
    if (message.word != "assign" && message.word != "constructor") return false;
    for (const char* text : {"cannot convert", "l-value required", "not enough data", "wrong operand"})
        if (contains(message.text, text)) return true;
    const auto tokens = tokenizeGlsl(line);
    return std::none_of(tokens.begin(), tokens.end(), [&](const auto& token) { return token.text == message.word; });
}

Problem describe(const Message& message, const StageSource& source, int line) {
    if (contains(message.text + message.word, "non-opaque uniforms outside a block")) {
        const std::string name = looseUniformName(source, line);
        return {Severity::Error, placeOf(source, line, name), fmt::format("uniform '{}' stands outside a block", name),
                fmt::format("put it into a block: uniform Properties {{ … {}; }};", name.empty() ? "name" : name)};
    }
    if (message.word == "#error") {  // glslang repeats its text word by word; the line itself reads better.
        const std::string_view text = splitLines(source.text)[static_cast<std::size_t>(line) - 1];
        const auto begin = text.find_first_not_of(' ', text.find("error") + 5);
        return {Severity::Error, placeOf(source, line, {}),
                "#error " + std::string(text.substr(std::min(begin, text.size()))),
                "the program refuses itself: change what it asks for, such as a define"};
    }
    if (message.word == "preprocessor evaluation") return describeCondition(source, line);
    const bool syntax = message.text.starts_with(kSyntaxError);
    if (syntax || contains(message.text, "unexpected token")) {
        if (auto strange = strangeCharacter(source, line)) return *strange;
    }
    Problem problem{Severity::Error, placeOf(source, line, message.word),
                    "GLSL: " + (syntax ? plainSyntax(message.text) : message.text),
                    syntax ? "a ';' or a bracket may be missing in front of it" : adviceFor(message.text)};
    if (!message.word.empty() && !isOperation(message, lineOf(source, line)))
        problem.message = fmt::format("GLSL: '{}': {}", message.word, message.text);
    if (const std::string old = adviceForOldFunctions(lineOf(source, line)); !old.empty()) {
        problem.help = old;
    } else if (contains(message.text, "no matching overloaded function") && isMacroOf(source, message.word)) {
        problem.help =
            fmt::format("macro '{}' stands for itself in the end: GLSL expands no macro twice", message.word);
    } else if (message.text == "undeclared identifier" || contains(message.text, "no matching overloaded function")) {
        auto names = Declarations(source.flat).names();
        std::erase(names, message.word);
        if (const auto near = nearestNames(message.word, names, 1); !near.empty())
            problem.help = fmt::format("did you mean '{}'?", near[0]);
    }
    return problem;
}

/// For a line that a macro wrote: where the author called it.
std::vector<Remark> callOf(const StageSource& source, int line) {
    const auto call = source.flat.calls.find(line);
    if (call == source.flat.calls.end()) return {};
    const SourceLoc where{source.flat.files[call->second.file], call->second.line};
    return {{where, "written by the macro called here"}};
}

/// Remarks that only say that an error was said before.
bool isSummary(const Message& message) {
    return contains(message.text, "compilation terminated") || contains(message.text, "compilation errors") ||
           message.text == "missing #endif";
}

}  // namespace

void reportGlslMessages(std::string_view log, const StageSource& source, Problems& problems) {
    const int headLines = static_cast<int>(std::count(source.head.begin(), source.head.end(), '\n'));
    for (const std::string_view raw : splitLines(log)) {
        const auto message = parseMessage(raw);
        if (!message || !message->error || (isSummary(*message) && problems.hasErrors())) continue;
        const int line = message->line - headLines;
        if (line < 1) {
            problems.error(source.flat.locate(1),
                           fmt::format("GLSL: in the defines: {} {}", message->word, message->text),
                           "check the values of the defines");
            continue;
        }
        const Problem problem = describe(*message, source, line);
        problems.error(problem.where, problem.message, problem.help, callOf(source, line));
        if (message->word == "#error") return;  // What follows is only that the text ends too early.
    }
}

void reportLinkMessages(std::string_view log, const std::vector<StageSource>& sources, Problems& problems) {
    std::string text;
    for (std::string_view line : splitLines(log)) {
        if (line.starts_with("WARNING")) continue;
        if (line.starts_with("ERROR: ")) line.remove_prefix(7);
        line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
        if (!line.empty()) text += (text.empty() ? "" : "; ") + std::string(line);
    }
    // The variables a link message speaks of are those interface names that it contains.
    SourceLoc where;
    std::vector<std::string> seen;
    for (const StageSource& source : sources) {
        const Declarations declarations(source.flat);
        for (const GlslToken& token : tokenizeGlsl(text)) {
            const SourceLoc place = token.isName() ? declarations.declared(token.text) : SourceLoc{};
            if (place.line == 0) continue;
            where = place;  // the last one: the fragment program is the author's own, the vertex program often shared
            seen.push_back(fmt::format("{}:{}", place.file, place.line));
            break;
        }
    }
    if (where.line == 0 && !sources.empty()) where = sources.front().flat.locate(1);
    problems.error(where, "GLSL: the stages do not fit together: " + plainLink(text),
                   seen.size() > 1 ? "declared at " + join(seen, " and ") : adviceFor(text));
}

}  // namespace crevice
