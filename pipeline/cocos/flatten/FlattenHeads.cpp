// Declarations whose head a condition chooses.
#include <algorithm>

#include "cocos/flatten/FlattenRun.h"

namespace crevice::cocos {
namespace {

constexpr std::size_t kMaxHeads = 16;   ///< In one declaration.
constexpr std::size_t kMaxCopies = 16;  ///< Of a declaration with several chosen heads.

}  // namespace

std::string_view Flattener::calledBy(std::string_view name) const {
    for (std::size_t i = 0; i < limits_.maxDepth && !isOpenChoice(name); ++i) {
        const MacroDefinition* macro = definitionOf(name);
        if (macro == nullptr || macro->functionLike || macro->body.size() != 1 || table_->isRecursive(name) ||
            std::find(active_.begin(), active_.end(), name) != active_.end())
            break;
        const std::string_view body = trimBlank(macro->body[0].text);
        if (body.empty() || leadingName(body) != body || !table_->isExpanded(body)) break;
        name = body;
    }
    return name;
}

bool Flattener::addOpenChoices(std::string_view text, std::vector<std::string_view>& names,
                               std::unordered_set<std::string_view>& seen) {
    return visitCalls(text, seen, [&](std::string_view call) {
        const MacroDefinition* macro = definitionOf(call);
        if (isOpenChoice(call)) names.push_back(call);
        if (names.size() > kMaxHeads) return Visited::Found;
        const bool within = std::find(active_.begin(), active_.end(), call) != active_.end();
        return isOpenChoice(call) || within || macro == nullptr || macro->bearsDirectives ? Visited::PassOver
                                                                                          : Visited::Enter;
    });
}

bool Flattener::isHeadChoice(std::string_view name) {
    const auto declares = [&](std::string_view call) {
        const MacroDefinition* macro = table_->find(call);
        return macro != nullptr && macro->declares ? Visited::Found : Visited::Enter;
    };
    const auto choices = choices_.of(name);
    return std::any_of(choices.begin(), choices.end(), [&](const auto& choice) {
        const MacroDefinition& macro = *choice.macro;
        if (macro.declares) return true;
        std::unordered_set<std::string_view> seen;
        return !macro.bearsDirectives && macro.body.size() == 1 && visitCalls(macro.body[0].text, seen, declares);
    });
}

std::string_view Flattener::chosenHeadOf(std::string_view name) {
    if (choices_.isEmpty()) return {};
    if (isOpenChoice(name)) return isHeadChoice(name) ? name : std::string_view();
    const MacroDefinition* macro = definitionOf(name);
    if (macro == nullptr || macro->bearsDirectives || macro->body.empty()) return {};
    const std::string_view last = trimBlank(macro->body.back().text);
    if (last.empty() || last.ends_with(';') || last.ends_with('}')) return {};
    std::vector<std::string_view> names;
    std::unordered_set<std::string_view> seen;
    for (const auto& part : macro->body) addOpenChoices(part.text, names, seen);
    const auto head = std::find_if(names.begin(), names.end(), [&](std::string_view one) { return isHeadChoice(one); });
    return head == names.end() ? std::string_view() : *head;
}

StatementRest Flattener::restOfDeclaration(const CodeLines& lines, Cursor from) {
    std::vector<std::string_view> names;
    std::unordered_set<std::string_view> seen;
    return readStatementRest(lines, from.line, from.column, limits_.maxArgument, [&](std::string_view part) {
        addOpenChoices(part, names, seen);
        std::size_t copies = 1;
        for (const std::string_view name : names) copies = std::min(copies * choices_.of(name).size(), kMaxCopies + 1);
        return copies > kMaxCopies && names.size() > 1;
    });
}

bool Flattener::beginsStatement(const Pending& pending) const {
    std::string_view before = trimBlank(pending.text);
    if (captured_ != nullptr) return false;
    if (before.empty()) {
        before = trimBlank(std::string_view(out_.flat.text));
        while (before.ends_with('\n')) before = trimBlank(before.substr(0, before.size() - 1));
        const auto begin = before.rfind('\n');
        if (trimBlank(before.substr(begin == std::string_view::npos ? 0 : begin + 1)).starts_with('#')) return true;
    }
    return before.empty() || std::string_view(";{})").find(before.back()) != std::string_view::npos;
}

std::string Flattener::takeHead(Pending& pending) {
    const std::size_t end = pending.text.find_last_of(";{}");
    std::string head = end == std::string::npos ? pending.text : pending.text.substr(end + 1);
    pending.text.resize(pending.text.size() - head.size());
    flush(pending);
    return head;
}

void Flattener::expandDeclaration(std::string_view head, const StatementRest& rest, Origin origin, Pending& pending) {
    const std::string before = takeHead(pending);
    const SourceText& source = *choices_.of(head).front().macro->source;
    writeEach(head, origin, [&](const MacroDefinition*) {
        Pending copy{before, origin};
        writeLines(rest.lines, copy, source, false);
        flush(copy);
    });
    endedInDirective_ = true;
}

}  // namespace crevice::cocos
