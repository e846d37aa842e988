// Finds where a shader's text declares and mentions its interface variables.
#include "effect/Declarations.h"

#include <algorithm>
#include <cstdint>

namespace crevice {
namespace {

bool isStorage(std::string_view word) { return word == "uniform" || word == "buffer" || word == "in" || word == "out"; }

}  // namespace

Declarations::Declarations(const FlatSource& source) : source_(source), tokens_(tokenizeGlsl(source.text)) {
    int depth = 0;
    for (std::size_t at = 0; at < tokens_.size(); ++at) {
        const GlslToken& token = tokens_[at];
        if (token.directive) continue;
        if (token.text == "{" || token.text == "(") ++depth;
        if (token.text == "}" || token.text == ")") --depth;
        if (depth == 0 && isStorage(token.text)) readDeclaration(at);
    }
}

/// From the storage word to the semicolon. `at` ends on the semicolon.
void Declarations::readDeclaration(std::size_t& at) {
    Range range{at, at, 0, 0};
    bool body = false, ended = false;
    int depth = 0;
    std::vector<std::size_t> declarators;
    for (; at < tokens_.size(); ++at) {
        const GlslToken& token = tokens_[at];
        if (token.directive) continue;
        if (token.text == ";" && depth == 0) break;
        if (token.text == "{" && depth == 0) body = true;
        if (depth == 0 && token.isName() && !ended) {
            if (body)
                range.instance = at;
            else
                range.name = at;
        }
        if (token.text == "[" || token.text == "=") ended = true;
        if (token.text == "," && depth == 0 && !body) {
            declarators.push_back(range.name);
            ended = false;
        }
        if (token.text == "{" || token.text == "(") ++depth;
        if (token.text == "}" || token.text == ")") --depth;
    }
    range.end = at;
    declarators.push_back(range.name);
    for (const std::size_t name : declarators) {
        range.name = name;
        if (name != 0) declared_.emplace(tokens_[name].text, range);
    }
}

SourceLoc Declarations::locate(std::size_t token) const {
    const GlslToken& t = tokens_[token];
    return source_.locate(t.line, t.column, static_cast<int>(t.text.size()));
}

SourceLoc Declarations::declared(std::string_view name) const {
    const auto it = declared_.find(name);
    return it == declared_.end() ? SourceLoc{} : locate(it->second.name);
}

SourceLoc Declarations::firstUse(std::string_view name, const std::vector<std::string>& members) const {
    const auto it = declared_.find(name);
    if (it == declared_.end()) return {};
    const Range& range = it->second;
    std::vector<std::string_view> wanted;
    if (range.instance != 0)
        wanted.push_back(tokens_[range.instance].text);
    else
        wanted.assign(members.begin(), members.end());
    if (range.instance == 0) wanted.push_back(name);
    // Most words have another length than all that are wanted.
    std::uint64_t lengths = 0;
    for (const std::string_view word : wanted) lengths |= 1ull << (word.size() & 63u);
    for (std::size_t at = range.end; at < tokens_.size(); ++at) {
        const GlslToken& token = tokens_[at];
        if ((lengths >> (token.text.size() & 63u) & 1u) == 0 || token.directive) continue;
        if (std::find(wanted.begin(), wanted.end(), token.text) != wanted.end()) return locate(at);
    }
    return {};
}

std::vector<std::string> Declarations::names() const {
    std::vector<std::string_view> words;
    for (const GlslToken& token : tokens_)
        if (token.isName()) words.push_back(token.text);
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    return {words.begin(), words.end()};
}

}  // namespace crevice
