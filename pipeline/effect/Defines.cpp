// The macros of a shader: found in its conditions, described by `#pragma define-meta`.
#include "effect/Defines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "core/Text.h"
#include "effect/GlslText.h"
#include "effect/Includes.h"

namespace crevice {
namespace {

using Tokens = std::vector<GlslToken>;

std::optional<int> toInteger(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// First token of the tail of a metadata pragma (its name), or 0 when the directive is none. Cocos up to 3.4 wrote it
/// `define`.
std::size_t metaName(const Tokens& tokens, std::size_t first, std::size_t end) {
    const auto word = [&](std::size_t i) { return first + i < end ? tokens[first + i].text : std::string_view(); };
    if (word(1) != "pragma" || word(2) != "define") return 0;
    if (word(3) == "-" && word(4) == "meta") return first + 5;
    const std::string_view tail = word(4);
    const bool meta =
        tail.empty() ||
        ((tail == "range" || tail == "options" || tail == "default" || tail == "editor") && word(5) == "(");
    return meta ? first + 3 : 0;
}

class Finder {
public:
    explicit Finder(Problems& problems) : problems_(problems) {}

    void read(const FlatSource& source) {
        source_ = &source;
        const Tokens tokens = tokenizeGlsl(source.text);
        for (std::size_t at = 0; at < tokens.size(); ++at) {
            if (!tokens[at].directive || tokens[at].text != "#") continue;
            const std::size_t end = directiveEnd(tokens, at);
            readDirective(tokens, at, end);
            at = end - 1;
        }
    }

    std::vector<DefineInfo> finish() {
        std::vector<DefineInfo> result;
        for (DefineInfo& info : found_) {
            const bool inText = defined_.contains(info.name);
            info.ownDefault = inText && guarded_.contains(info.name);
            if (!inText || info.ownDefault) result.push_back(std::move(info));
        }
        return result;
    }

private:
    void readDirective(const Tokens& tokens, std::size_t first, std::size_t end) {
        if (first + 1 >= end) return;
        const std::string_view word = tokens[first + 1].text;
        if (const std::size_t name = metaName(tokens, first, end); name != 0) {
            readMeta(tokens, name, end);
        } else if (word == "define" && first + 2 < end) {
            defined_.emplace(tokens[first + 2].text);
        } else if (word == "ifdef" || word == "ifndef") {
            if (first + 2 < end) mention(tokens[first + 2], false);
            if (word == "ifndef" && first + 2 < end) guarded_.emplace(tokens[first + 2].text);
        } else if (word == "if" || word == "elif") {
            readCondition(tokens, first + 2, end);
        }
    }

    void readCondition(const Tokens& tokens, std::size_t at, std::size_t end) {
        for (; at < end; ++at) {
            if (!tokens[at].isName()) continue;
            if (tokens[at].text != "defined") {
                mention(tokens[at], true);
                continue;
            }
            if (at + 1 < end && tokens[at + 1].text == "(") ++at;
            if (at + 1 < end) mention(tokens[++at], false);
        }
    }

    void mention(const GlslToken& token, bool tested) {
        const std::string_view name = token.text;
        if (name.starts_with("GL_") || name.starts_with("__") || name.starts_with("CREVICE_INCLUDED_") ||
            name == "VULKAN")
            return;
        DefineInfo& info = entry(token);
        info.tested = info.tested || tested;
    }

    DefineInfo& entry(const GlslToken& token) {
        const auto it =
            std::find_if(found_.begin(), found_.end(), [&](const DefineInfo& info) { return info.name == token.text; });
        if (it != found_.end()) return *it;
        DefineInfo info;
        info.name = token.text;
        info.where = source_->locate(token.line, token.column, static_cast<int>(token.text.size()));
        found_.push_back(std::move(info));
        return found_.back();
    }

    void readMeta(const Tokens& tokens, std::size_t at, std::size_t end) {
        if (at >= end || !tokens[at].isName()) return;
        const GlslToken& name = tokens[at];
        DefineInfo& info = entry(name);
        info.described = true;
        bool hasDefault = false;
        while (++at < end) {
            const std::string_view word = tokens[at].text;
            const std::vector<std::string> values = readList(tokens, at, end);
            if (word == "range") {
                readRange(info, values, name);
            } else if (word == "options") {
                info.type = DefineType::String;
                info.options = values;
            } else if (word == "default" && !values.empty()) {
                info.defaultValue = values[0] == "true" ? "1" : values[0] == "false" ? "0" : values[0];
                hasDefault = true;
            } else if (word != "editor" && word != "default") {
                report(name, fmt::format("unknown '{}' in define-meta of '{}'", word, info.name));
            }
        }
        if (!hasDefault && info.type == DefineType::String && !info.options.empty())
            info.defaultValue = info.options[0];
        if (!hasDefault && info.range) info.defaultValue = std::to_string(info.range->first);
    }

    void readRange(DefineInfo& info, const std::vector<std::string>& values, const GlslToken& name) {
        info.type = DefineType::Number;
        const auto low = values.size() == 2 ? toInteger(values[0]) : std::nullopt;
        const auto high = values.size() == 2 ? toInteger(values[1]) : std::nullopt;
        if (!low || !high || *low > *high)
            return report(name, fmt::format("the range of '{}' is not two ascending integers", info.name));
        info.range = {*low, *high};
    }

    /// Values of `word([a, b])` or `word(a)`; `at` moves from the word to the closing parenthesis.
    static std::vector<std::string> readList(const Tokens& tokens, std::size_t& at, std::size_t end) {
        std::vector<std::string> values{std::string()};
        if (at + 1 >= end || tokens[at + 1].text != "(") return {};
        int depth = 0;
        while (++at < end) {
            const std::string_view text = tokens[at].text;
            if (text == "(") ++depth;
            if (text == ")" && --depth == 0) break;
            if (text == ",")
                values.emplace_back();
            else if (text != "(" && text != "[" && text != "]" && text != "'" && text != "\"")
                values.back() += text;
        }
        std::erase(values, std::string());
        return values;
    }

    void report(const GlslToken& token, std::string message) {
        problems_.error(source_->locate(token.line, token.column, static_cast<int>(token.text.size())),
                        std::move(message),
                        "write: #pragma define-meta NAME range([0, 3]) | options([a, b]) default(a)");
    }

    Problems& problems_;
    const FlatSource* source_ = nullptr;
    std::vector<DefineInfo> found_;
    std::set<std::string, std::less<>> defined_, guarded_;
};

}  // namespace

std::vector<DefineInfo> findDefines(const std::vector<const FlatSource*>& stages, Problems& problems) {
    Finder finder(problems);
    for (const FlatSource* stage : stages) finder.read(*stage);
    return finder.finish();
}

void checkDefine(const DefineInfo& info, const std::string& value, const SourceLoc& where, Problems& problems) {
    const bool isWord = !value.empty() &&
                        value.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.+-") ==
                            std::string::npos;
    if (!isWord)
        return problems.error(where, fmt::format("'{}' is no value for define '{}'", value, info.name),
                              "give a number or one word");
    if (!info.described) return;
    const auto number = toInteger(value);
    if (info.type == DefineType::String) {
        if (!info.options.empty() && std::find(info.options.begin(), info.options.end(), value) == info.options.end())
            problems.error(where, fmt::format("define '{}' cannot be '{}'", info.name, value),
                           didYouMean(value, info.options, "options"));
    } else if (!number) {
        problems.error(where, fmt::format("define '{}' needs an integer, not '{}'", info.name, value),
                       info.type == DefineType::Bool ? "give 0 or 1" : "");
    } else if (info.type == DefineType::Bool && *number != 0 && *number != 1) {
        problems.error(where, fmt::format("define '{}' is {}, but it is on or off", info.name, value), "give 0 or 1");
    } else if (info.range && (*number < info.range->first || *number > info.range->second)) {
        problems.error(where, fmt::format("define '{}' is {}, outside its range", info.name, value),
                       fmt::format("give {} to {}", info.range->first, info.range->second));
    }
}

std::string defineLines(const std::vector<DefineInfo>& infos, const Defines& values) {
    std::string lines;
    for (const DefineInfo& info : infos) {
        const auto given = values.find(info.name);
        if (given == values.end() && info.ownDefault) continue;
        const std::string& value = given != values.end() ? given->second : info.defaultValue;
        const bool onlyIfDefined = !info.tested && !info.described && value == "0";
        if (!onlyIfDefined) lines += fmt::format("#define {} {}\n", info.name, value);
    }
    return lines;
}

std::string withoutDefineMeta(const FlatSource& source) {
    const Tokens tokens = tokenizeGlsl(source.text);
    std::set<int> lines;
    for (std::size_t at = 0; at < tokens.size(); ++at) {
        if (!tokens[at].directive || tokens[at].text != "#") continue;
        const std::size_t end = directiveEnd(tokens, at);
        if (metaName(tokens, at, end) != 0)
            for (std::size_t i = at; i < end; ++i) lines.insert(tokens[i].line);
        at = end - 1;
    }
    std::string out;
    int line = 1;
    for (std::size_t at = 0; at < source.text.size(); ++line) {
        const std::size_t end = std::min(source.text.find('\n', at), source.text.size());
        if (!lines.contains(line)) out.append(source.text, at, end - at);
        out.push_back('\n');
        at = end + 1;
    }
    return out;
}

}  // namespace crevice
