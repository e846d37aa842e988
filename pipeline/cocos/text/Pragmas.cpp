// Reads pragmas word by word.
#include "cocos/text/Pragmas.h"

#include <fmt/format.h>

#include <charconv>

#include "cocos/text/Conditions.h"
#include "cocos/text/SourceText.h"

namespace crevice::cocos {
namespace {

/// What stands in the brackets at the front of `text`, nested ones included; `text` moves behind them.
std::optional<std::string_view> takeBrackets(std::string_view& text) {
    text = trimBlank(text);
    if (!text.starts_with('(')) return std::nullopt;
    int depth = 0;
    char quote = '\0';
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quote != '\0') {
            if (c == quote) quote = '\0';
            continue;
        }
        if (c == '\'' || c == '"') quote = c;
        if (c == '(') ++depth;
        if (c == ')' && --depth == 0) {
            const std::string_view inside = text.substr(1, i - 1);
            text.remove_prefix(i + 1);
            return trimBlank(inside);
        }
    }
    return std::nullopt;
}

std::string_view unquote(std::string_view text) {
    text = trimBlank(text);
    const bool quoted =
        text.size() >= 2 && (text.front() == '\'' || text.front() == '"') && text.back() == text.front();
    return quoted ? text.substr(1, text.size() - 2) : text;
}

/// "[a, b]" → a, b.
std::vector<std::string> readList(std::string_view text) {
    text = trimBlank(text);
    if (text.starts_with('[')) text.remove_prefix(1);
    if (text.ends_with(']')) text.remove_suffix(1);
    std::vector<std::string> items;
    while (!trimBlank(text).empty()) {
        const auto comma = std::min(text.find(','), text.size());
        items.emplace_back(unquote(text.substr(0, comma)));
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return items;
}

std::optional<int> toInteger(std::string_view text) {
    int value = 0;
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::string readDefault(std::string_view text) {
    if (text == "true") return "1";
    return text == "false" ? "0" : std::string(text);
}

void readMetaPart(std::string_view word, std::string_view inside, DefineInfo& info, bool& hasDefault, Pragma& pragma) {
    if (word == "range") {
        const auto ends = readList(inside);
        const auto low = ends.size() == 2 ? toInteger(ends[0]) : std::nullopt;
        const auto high = ends.size() == 2 ? toInteger(ends[1]) : std::nullopt;
        info.type = DefineType::Number;
        if (!low || !high || *low > *high)
            pragma.mistake = fmt::format("the range of '{}' is not two ascending integers", info.name);
        else
            info.range = {*low, *high};
    } else if (word == "options") {
        info.type = DefineType::String;
        info.options = readList(inside);
        if (info.options.empty()) pragma.mistake = fmt::format("'{}' has no options", info.name);
    } else if (word == "default") {
        const auto values = readList(inside);
        hasDefault = !values.empty();
        if (hasDefault) info.defaultValue = readDefault(values[0]);
    }
}

/// "NAME range([0, 3]) default(1) editor(…)". `old` = by the compiler up to 3.4, for which every default is a constant.
Pragma readMeta(std::string_view text, bool old) {
    Pragma pragma;
    StageMacro macro;
    DefineInfo& info = macro.info;
    info.name = leadingName(text);
    if (info.name.empty()) {
        pragma.mistake = "the pragma names no macro";
        return pragma;
    }
    info.described = true;
    bool hasDefault = false;
    text = trimBlank(text.substr(info.name.size()));
    while (!text.empty() && pragma.mistake.empty()) {
        const std::string_view word = leadingName(text);
        text.remove_prefix(word.size());
        const auto inside = takeBrackets(text);
        if (word.empty() || !inside) break;  // What follows is no part of the description.
        readMetaPart(word, *inside, info, hasDefault, pragma);
        // Of several tags the last decides the type; a default that is no bool belongs to the engine.
        if (word == "range" || word == "options") macro.constant = false;
        if (word == "default") macro.constant = old || (trimBlank(*inside) != "true" && trimBlank(*inside) != "false");
        text = trimBlank(text);
    }
    macro.hasDefault = hasDefault;
    if (!hasDefault && info.range) info.defaultValue = std::to_string(info.range->first);
    if (!hasDefault && !info.options.empty()) info.defaultValue = info.options[0];
    if (hasDefault && info.type == DefineType::Bool) {
        const auto number = toInteger(info.defaultValue);
        if (number && *number != 0 && *number != 1) info.type = DefineType::Number;
    }
    if (pragma.mistake.empty()) pragma.meta = std::move(macro);
    return pragma;
}

/// "[NAME, condition, level]": those of GLES do not exist for Vulkan.
Pragma readExtension(std::string_view inside) {
    Pragma pragma;
    const auto parts = readList(inside);
    if (parts.empty() || parts[0].empty()) {
        pragma.mistake = "the pragma names no extension";
        return pragma;
    }
    const bool wanted = parts.size() < 2 || decideByVersion(parts[1]) == true;
    if (!wanted || parts[0].starts_with("GL_OES_")) return pragma;
    pragma.extension = fmt::format("#extension {} : {}", parts[0], parts.size() > 2 ? parts[2] : "enable");
    return pragma;
}

Pragma makeMark(PragmaMark::Kind kind, std::string_view name, std::string_view value) {
    Pragma pragma;
    pragma.mark = PragmaMark{kind, std::string(name), std::string(value), 0};
    return pragma;
}

/// "in NAME", "out highp NAME": an input attachment, or an output.
Pragma readSubpass(std::string_view word, std::string_view text) {
    const char scalar = word.starts_with('i') || word.starts_with('u') ? word.front() : 'f';
    const bool color = word.ends_with("Color");
    const std::string_view direction = leadingName(text);
    text = trimBlank(text.substr(direction.size()));
    std::string_view name = leadingName(text);
    if (name == "highp" || name == "mediump" || name == "lowp") name = leadingName(trimBlank(text.substr(name.size())));
    Pragma pragma;
    const bool known = direction == "in" || (color && (direction == "out" || direction == "inout"));
    if (name.empty() || !known) {
        pragma.mistake = name.empty() && known
                             ? "the pragma names no subpass input"
                             : fmt::format("'#pragma {}' is not in{}", word, color ? ", out or inout" : "");
        return pragma;
    }
    pragma = makeMark(color ? PragmaMark::Kind::SubpassColor : PragmaMark::Kind::SubpassDepth, name, direction);
    pragma.mark->scalar = scalar;
    return pragma;
}

/// Is it `subpassColor`, `isubpassStencil`, …?
bool isSubpass(std::string_view word) {
    if (word.starts_with('i') || word.starts_with('u')) word.remove_prefix(1);
    return word == "subpassColor" || word == "subpassDepth" || word == "subpassStencil";
}

}  // namespace

Pragma readPragma(std::string_view rest) {
    rest = trimBlank(rest);
    const std::string_view word = leadingName(rest);
    std::string_view tail = trimBlank(rest.substr(word.size()));
    if (word == "define") {
        const bool old = !tail.starts_with("-meta");
        return readMeta(old ? tail : trimBlank(tail.substr(5)), old);
    }
    if (word == "rate") {
        const std::string_view name = leadingName(tail);
        return makeMark(PragmaMark::Kind::Rate, name, leadingName(trimBlank(tail.substr(name.size()))));
    }
    if (isSubpass(word)) return readSubpass(word, tail);
    const bool called = word == "builtin" || word == "extension" || word == "glBinding" || word == "format";
    if (!called) return {};
    Pragma pragma;
    const auto inside = takeBrackets(tail);
    if (!inside || inside->empty()) {
        pragma.mistake = fmt::format("'#pragma {}' has no value in brackets", word);
        return pragma;
    }
    if (word == "extension") return readExtension(*inside);
    if (word == "glBinding") return makeMark(PragmaMark::Kind::GlBinding, {}, *inside);
    if (word == "format") return makeMark(PragmaMark::Kind::Format, {}, *inside);
    if (*inside == "global") return makeMark(PragmaMark::Kind::BuiltinGlobal, {}, {});
    if (*inside == "local") return makeMark(PragmaMark::Kind::BuiltinLocal, {}, {});
    pragma.mistake = fmt::format("'builtin({})' is neither global nor local", *inside);
    return pragma;
}

std::string_view pragmaExample(std::string_view rest) {
    const std::string_view word = leadingName(trimBlank(rest));
    if (word == "builtin") return "write #pragma builtin(global) or #pragma builtin(local)";
    if (word == "extension") return "write #pragma extension([NAME, __VERSION__ > 310, require])";
    if (word == "format") return "write #pragma format(RGBA8)";
    if (word == "glBinding") return "write #pragma glBinding(0)";
    if (isSubpass(word)) return "write #pragma subpassColor in NAME";
    return "write such as: #pragma define-meta NAME range([0, 3]) | options([a, b]) default(a)";
}

int subpassNumber(const std::vector<PragmaMark>& marks, const PragmaMark& mark, bool output) {
    const auto isDepth = [](const PragmaMark& m) { return m.kind == PragmaMark::Kind::SubpassDepth; };
    // Read, then read and written, then written; within these colours first, by name.
    const auto rank = [&](const PragmaMark& m) {
        return (m.value == "in" ? 0 : m.value == "inout" ? 2 : 4) + (isDepth(m) ? 1 : 0);
    };
    int number = 0;
    bool depth = false;
    for (const PragmaMark& other : marks) {
        if (!isDepth(other) && other.kind != PragmaMark::Kind::SubpassColor) continue;
        if (output ? other.value == "in" : other.value == "out") continue;
        const bool before = rank(other) != rank(mark) ? rank(other) < rank(mark)
                            : rank(mark) == 4         ? other.line < mark.line
                                                      : other.name < mark.name;
        if (!before || (isDepth(other) && (isDepth(mark) || depth))) continue;  // Depth and stencil share one.
        depth = depth || isDepth(other);
        ++number;
    }
    return number;
}

}  // namespace crevice::cocos
