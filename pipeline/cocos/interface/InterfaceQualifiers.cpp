// What stands in front of a declaration's type: qualifiers, and the numbers of its layout.
#include <algorithm>

#include "cocos/interface/InterfaceReader.h"

namespace crevice::cocos {

bool isInterfaceQualifier(std::string_view word) {
    static constexpr std::string_view kWords[] = {
        "flat",     "smooth",    "noperspective", "centroid", "sample",   "patch",    "invariant",
        "precise",  "highp",     "mediump",       "lowp",     "coherent", "volatile", "restrict",
        "readonly", "writeonly", "const",         "in",       "out",      "uniform",  "buffer"};
    return std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

std::size_t InterfaceReader::behindParens(std::size_t at, std::size_t end) const {
    int depth = 0;
    for (; at < end; ++at) {
        if (tokens_[at].text == "(") ++depth;
        if (tokens_[at].text == ")" && --depth == 0) return at + 1;
    }
    return end;
}

int InterfaceReader::numberOf(std::size_t begin, std::size_t end) const {
    const auto value = constants_.evaluate(tokens_.data() + begin, tokens_.data() + end);
    if (!value || value->value < 0 || value->value > kLargestNumber) return -1;
    return static_cast<int>(value->value);
}

/// `layout(a = 1, b)` from its word to behind its parenthesis: numbers are taken out, the rest stays.
void InterfaceReader::readLayout(std::size_t begin, std::size_t end, InterfaceStatement& where,
                                 InterfaceDeclaration& declaration) const {
    std::string kept;
    std::size_t at = begin + 2;
    while (at + 1 < end) {
        std::size_t last = at;
        int depth = 0;
        while (last + 1 < end && (tokens_[last].text != "," || depth > 0)) {
            if (tokens_[last].text == "(") ++depth;
            if (tokens_[last].text == ")") --depth;
            ++last;
        }
        const std::string_view key = tokens_[at].text;
        int* number = key == "set"                      ? &declaration.literal.set
                      : key == "binding"                ? &declaration.literal.binding
                      : key == "location"               ? &declaration.literal.location
                      : key == "input_attachment_index" ? &declaration.literal.attachment
                                                        : nullptr;
        const int value = number != nullptr && last > at + 2 ? numberOf(at + 2, last) : -1;
        if (value >= 0) {
            *number = value;
        } else if (last > at) {
            const std::size_t from = offset(at), to = offset(last - 1) + tokens_[last - 1].text.size();
            kept += (kept.empty() ? "" : ", ") + stage_.flat.text.substr(from, to - from);
        }
        at = last + 1;
    }
    const std::size_t from = offset(begin);
    where.layouts.push_back({from, offset(end - 1) + 1 - from, std::move(kept)});
}

/// The words around the storage word. `at` begins behind it and ends on the type.
InterfaceStatement InterfaceReader::readQualifiers(const GlslStatement& statement, std::size_t& at, std::size_t end,
                                                   InterfaceDeclaration& declaration) const {
    InterfaceStatement where;
    where.storage = offset(statement.storage);
    where.begin = where.storage;
    const auto read = [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to;) {
            const std::string_view word = tokens_[i].text;
            if (word == "readonly") declaration.readOnly = true;
            if (word == "writeonly") declaration.writeOnly = true;
            if (word == "layout" && i + 1 < to && tokens_[i + 1].text == "(") {
                const std::size_t behind = behindParens(i, to);
                where.begin = std::min(where.begin, offset(i));
                readLayout(i, behind, where, declaration);
                i = behind;
            } else if (isInterfaceQualifier(word)) {
                where.begin = std::min(where.begin, offset(i++));
            } else if (i >= statement.storage) {
                return i;
            } else {
                ++i;  // a macro's call in front of the declaration
            }
        }
        return to;
    };
    read(statement.begin, statement.storage);
    at = read(statement.storage, end);
    return where;
}

}  // namespace crevice::cocos
