// From compiler messages to the conditions of the lines they speak of.
#include "app/commands/MissingNames.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>

#include "core/Text.h"
#include "effect/GlslText.h"

namespace crevice {
namespace {

constexpr std::array<std::string_view, 4> kMissing = {"undeclared identifier", "no matching overloaded function",
                                                      "no such field in structure", "no such field in vector"};
constexpr std::array<std::string_view, 9> kNoTypes = {"return", "else",    "case",    "in",    "out",
                                                      "inout",  "precise", "discard", "define"};
constexpr std::size_t kMostPlaces = 2;  ///< That are named: the rest says nothing new.

using cocos::StageText;

/// Line of the flat text, from 0; npos = none.
std::size_t lineOf(const StageText& stage, const SourceLoc& where) {
    for (std::size_t i = 0; i < stage.flat.lines.size(); ++i)
        if (stage.flat.lines[i].line == where.line && stage.flat.files[stage.flat.lines[i].file] == where.file)
            return i;
    return std::string::npos;
}

const std::vector<std::string>& conditionsAt(const StageText& stage, std::size_t line) {
    return stage.conditions[line < stage.conditionOf.size() ? stage.conditionOf[line] : 0];
}

/// `TYPE name` or `#define name`: a call or an expression has no name in front.
bool isDeclaration(const std::vector<GlslToken>& tokens, std::size_t at) {
    if (at == 0) return false;
    const std::string_view before = tokens[at - 1].text;
    if (tokens[at].directive) return before == "define";
    const bool type = tokens[at - 1].isName() && !tokens[at - 1].directive &&
                      std::find(kNoTypes.begin(), kNoTypes.end(), before) == kNoTypes.end();
    return type || before == "struct";
}

void addDeclarations(MissingName& missing, const StageText& stage, const std::vector<GlslToken>& tokens) {
    for (std::size_t at = 0; at < tokens.size() && missing.otherwise.size() < kMostPlaces; ++at) {
        if (tokens[at].text != missing.name || !isDeclaration(tokens, at)) continue;
        const auto line = static_cast<std::size_t>(tokens[at].line) - 1;
        const SourceLoc where = stage.flat.locate(tokens[at].line);
        std::string place = fmt::format("{}:{}", std::filesystem::path(where.file).filename().string(), where.line);
        if (const auto& with = conditionsAt(stage, line); !with.empty()) place += " with " + join(with);
        if (std::find(missing.otherwise.begin(), missing.otherwise.end(), place) == missing.otherwise.end())
            missing.otherwise.push_back(std::move(place));
    }
}

}  // namespace

std::vector<MissingName> missingNames(const Error& error) {
    std::vector<MissingName> names;
    for (const Problem& problem : error.problems()) {
        const std::string& message = problem.message;
        const std::size_t begin = message.find('\'');
        const std::size_t end = begin == std::string::npos ? begin : message.find('\'', begin + 1);
        const bool missing = std::any_of(kMissing.begin(), kMissing.end(),
                                         [&](const auto& part) { return message.find(part) != std::string::npos; });
        if (!missing || end == std::string::npos) continue;
        const std::string name = message.substr(begin + 1, end - begin - 1);
        const auto same = [&](const MissingName& other) { return other.name == name; };
        if (std::none_of(names.begin(), names.end(), same)) names.push_back({name, problem.where, {}});
    }
    return names;
}

void explainMissing(std::vector<MissingName>& names, const std::vector<StageText>& stages) {
    for (const StageText& stage : stages) {
        const std::vector<GlslToken> tokens = tokenizeGlsl(stage.flat.text);
        for (MissingName& missing : names) {
            const std::size_t line = lineOf(stage, missing.where);
            if (line == std::string::npos) continue;
            if (missing.usedWith.empty()) missing.usedWith = conditionsAt(stage, line);
            addDeclarations(missing, stage, tokens);
        }
    }
}

std::string missingText(const std::vector<MissingName>& names) {
    std::vector<std::string> texts;
    for (const MissingName& missing : names) {
        std::string text = missing.name;
        if (!missing.usedWith.empty()) text += " with " + join(missing.usedWith);
        if (!missing.otherwise.empty()) text += " (but " + join(missing.otherwise, "; ") + ")";
        texts.push_back(std::move(text));
    }
    return join(texts, "; ");
}

}  // namespace crevice
