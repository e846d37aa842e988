// Reads the bodies of macros word by word; a macro's body is read in its place.
#include "cocos/analysis/MacroAliases.h"

#include <charconv>
#include <optional>
#include <unordered_set>

namespace crevice::cocos {
namespace {

std::optional<long long> wholeNumber(std::string_view body) {
    long long number = 0;
    const auto [end, error] = std::from_chars(body.data(), body.data() + body.size(), number);
    if (body.empty() || error != std::errc{} || end != body.data() + body.size()) return std::nullopt;
    return number;
}

/// The first name, taken off with what stands before it; empty at the end. Letters of numbers are no names.
std::string_view takeName(std::string_view& text) {
    while (!text.empty()) {
        std::size_t length = 1;
        if (isNameStart(text.front())) {
            const std::string_view name = leadingName(text);
            text.remove_prefix(name.size());
            return name;
        }
        if (text.front() >= '0' && text.front() <= '9')
            while (length < text.size() && isNamePart(text[length])) ++length;
        text.remove_prefix(length);
    }
    return {};
}

}  // namespace

void MacroAliases::open(std::string_view name, std::vector<std::string_view>& bodies) const {
    const auto found = definitions_.find(name);
    if (found == definitions_.end()) return;
    for (auto macro = found->second.rbegin(); macro != found->second.rend(); ++macro)
        if (!(*macro)->functionLike && !(*macro)->body.empty()) bodies.push_back((*macro)->body.front().text);
}

ConditionName MacroAliases::follow(std::string_view name) {
    ConditionName result;
    result.outside = false;
    const auto found = definitions_.find(name);
    if (found == definitions_.end()) return result;
    std::vector<std::string_view> bodies;  // What is left of each, the innermost last.
    open(name, bodies);
    if (found->second.size() == 1 && bodies.size() == 1)
        if ((result.value = wholeNumber(trimBlank(bodies.front())))) return result;
    std::unordered_set<std::string_view> seen{name};
    while (!bodies.empty() && !exhausted()) {
        const std::string_view word = takeName(bodies.back());
        ++words_;
        if (word.empty())
            bodies.pop_back();
        else if (word == "defined" || !seen.insert(word).second)
            continue;
        else if (isOutside_(word))
            result.alias.emplace_back(word);
        else
            open(word, bodies);
    }
    return result;
}

}  // namespace crevice::cocos
