// Looks ahead over the lines of a call.
#include "cocos/Choices.h"

namespace crevice::cocos {

FoundChoice findChoice(const MacroTable& table, const SourceLines& lines, std::size_t at,
                       const std::vector<std::string_view>& known, std::size_t maxBytes) {
    FoundChoice found;
    if (!table.hasChoices()) return found;
    int open = 0;  // Brackets from the line's first call on.
    for (std::size_t i = at; i < lines.size() && found.looked <= maxBytes; ++i) {
        if (i != at && lines.source.lines[i].kind != LineKind::Code) break;
        const std::string_view text = lines.text(i);
        found.name = table.findChoice(text, known);
        if (!found.name.empty()) break;
        const std::size_t from = i == at ? table.findCall(text, 0) : 0;
        for (const char c : text.substr(std::min(from, text.size()))) open += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (open <= 0) break;
        if (i != at) found.looked += text.size() + 1;
    }
    return found;
}

std::vector<const SourceText*> IncludedTexts::cutTo(std::size_t size) {
    const auto first = order_.begin() + static_cast<std::ptrdiff_t>(size);
    std::vector<const SourceText*> cut(first, order_.end());
    order_.erase(first, order_.end());
    for (const SourceText* text : cut) seen_.erase(text);
    return cut;
}

}  // namespace crevice::cocos
