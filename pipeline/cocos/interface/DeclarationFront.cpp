// Reads lines upwards from the names.
#include "cocos/interface/DeclarationFront.h"

#include <algorithm>

#include "cocos/text/SourceText.h"

namespace crevice::cocos {
namespace {

bool opens(LineKind kind) { return kind == LineKind::If || kind == LineKind::Ifdef || kind == LineKind::Ifndef; }

bool isQualifier(std::string_view word) {
    static constexpr std::string_view kWords[] = {"highp", "mediump",       "lowp",     "precise", "invariant",
                                                  "flat",  "noperspective", "centroid", "sample",  "smooth"};
    return std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

/// The lines of a text above a place, the nearest first.
class LinesAbove {
public:
    LinesAbove(std::string_view text, std::size_t at, std::size_t& budget)
        : text_(text), end_(lineBegin(at)), budget_(budget) {}

    /// False at the text's begin, at a continued line, and when the budget is used up.
    bool next() {
        if (end_ == 0) return false;
        behind = end_;
        begin = lineBegin(end_ - 1);
        line = text_.substr(begin, end_ - 1 - begin);
        end_ = begin;
        if (line.size() >= budget_ || line.ends_with('\\')) return false;
        budget_ -= line.size() + 1;
        kind = readDirective(line).kind;
        return true;
    }
    std::size_t reached() const { return end_; }

    std::string_view line;
    std::size_t begin = 0, behind = 0;
    LineKind kind = LineKind::Code;

private:
    std::size_t lineBegin(std::size_t at) const {
        const std::size_t newline = at == 0 ? std::string_view::npos : text_.rfind('\n', at - 1);
        return newline == std::string_view::npos ? 0 : newline + 1;
    }

    std::string_view text_;
    std::size_t end_;
    std::size_t& budget_;
};

constexpr std::size_t kMostQualifiers = 256;  ///< Bytes; more than there are.

/// The words of a line that are all qualifiers, each with a blank behind it. False when one is none.
bool readQualifiers(std::string_view line, std::string& found) {
    for (std::size_t at = 0; at < line.size();) {
        const std::string_view word = leadingName(line.substr(at));
        if (word.empty() ? line[at] != ' ' && line[at] != '\t' : !isQualifier(word)) return false;
        if (!word.empty()) found.append(word).push_back(' ');
        at += std::max<std::size_t>(1, word.size());
    }
    return true;
}

/// Behind the last statement above, qualifiers alone; else nothing.
std::string qualifiersAbove(LinesAbove& lines) {
    std::string words;
    while (lines.next() && lines.kind == LineKind::Code) {
        const std::size_t ended = lines.line.find_last_of(";{}");
        std::string more;
        if (!readQualifiers(lines.line.substr(ended == std::string_view::npos ? 0 : ended + 1), more)) return {};
        words.insert(0, more);
        if (words.size() > kMostQualifiers) return {};
        if (ended != std::string_view::npos) break;
    }
    return words;
}

std::string wordsInFront(std::string_view text, std::size_t begin, std::size_t& budget) {
    LinesAbove lines(text, begin, budget);
    if (!trimBlank(text.substr(lines.reached(), begin - lines.reached())).empty()) return {};
    int open = 0;
    for (bool first = true; lines.next(); first = false) {
        if (first && (!isConditional(lines.kind) || lines.kind == LineKind::Endif)) return {};
        if (lines.kind == LineKind::Endif) ++open;
        if (opens(lines.kind) && open-- == 0) return qualifiersAbove(lines);
    }
    return {};
}

/// Where a condition opens within the words, the statement begins behind its line.
DeclarationFront findBegin(std::string_view text, const InterfaceStatement& where, std::size_t& budget) {
    const DeclarationFront plain{where.begin, false, {}};
    DeclarationFront front = plain;
    int open = 0;
    for (LinesAbove lines(text, where.firstName, budget); open > 0 || lines.reached() > where.begin;) {
        if (!lines.next()) return plain;
        if (lines.kind == LineKind::Code) {
            const std::size_t own = std::min(lines.behind, std::max(where.begin, lines.begin));
            const std::string_view above = text.substr(lines.begin, own - lines.begin);
            if (open > 0 && above.find_first_of(";{}()=") != std::string_view::npos) return plain;
        } else if (opens(lines.kind) && open == 0) {
            front.begin = lines.behind;
            return front;
        } else if (!isConditional(lines.kind) || (open == 0 && lines.kind != LineKind::Endif)) {
            return plain;
        } else {
            front.conditional = true;
            open += int(lines.kind == LineKind::Endif) - int(opens(lines.kind));
            if (open == 0) front.begin = std::min(front.begin, lines.begin);
        }
    }
    return front;
}

}  // namespace

DeclarationFront findFront(std::string_view text, const InterfaceStatement& where, std::size_t& budget) {
    DeclarationFront front = findBegin(text, where, budget);
    front.words = wordsInFront(text, front.begin, budget);
    return front;
}

}  // namespace crevice::cocos
