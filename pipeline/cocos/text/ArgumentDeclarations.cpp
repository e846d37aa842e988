// Looks back from each interface word for brackets that are open there.
#include "cocos/text/ArgumentDeclarations.h"

#include <algorithm>

namespace crevice::cocos {
namespace {

constexpr std::size_t kMaxLookedBack = 8u << 20;  ///< Bytes, of a text.

class WordWalk {
public:
    template <class LineOf, class IsCode>
    void walk(std::size_t count, LineOf lineOf, IsCode isCode) {
        for (std::size_t line = 0; line < count && looked_ < kMaxLookedBack; ++line) {
            if (!isCode(line)) continue;
            const std::string_view text = lineOf(line);
            for (std::size_t at = 0; at < text.size() && looked_ < kMaxLookedBack;) {
                std::size_t end = at;
                while (end < text.size() && isNamePart(text[end])) ++end;
                if (isInterfaceWord(text.substr(at, end - at))) lookBack(line, at, lineOf, isCode);
                at = std::max(end, at + 1);
            }
        }
    }

    std::unordered_set<std::string_view> names;

private:
    template <class LineOf, class IsCode>
    void lookBack(std::size_t line, std::size_t at, LineOf lineOf, IsCode isCode) {
        OpenCalls open(names);
        bool reads = open.readBack(lineOf(line).substr(0, at));
        looked_ += at;
        for (std::size_t i = line; reads && i-- > 0 && line - i < kMostCallLines;) {
            if (isCode(i)) reads = open.readBack(lineOf(i));
            looked_ += lineOf(i).size();
        }
    }

    std::size_t looked_ = 0;
};

}  // namespace

std::unordered_set<std::string_view> callsWithDeclarations(const SourceText& source) {
    WordWalk words;
    words.walk(
        source.lines.size(), [&](std::size_t i) { return source.lines[i].text; },
        [&](std::size_t i) { return isCodeLine(source, i); });
    for (const MacroDefinition& macro : source.macros)
        words.walk(
            macro.body.size(), [&](std::size_t i) { return macro.body[i].text; },
            [&](std::size_t i) { return readDirective(macro.body[i].text).kind == LineKind::Code; });
    return std::move(words.names);
}

}  // namespace crevice::cocos
