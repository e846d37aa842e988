// Sizes of arrays, members of blocks and structs, and how many locations they take.
#include <algorithm>

#include "cocos/interface/GlslTypes.h"
#include "cocos/interface/InterfaceReader.h"

namespace crevice::cocos {

/// `[N][M]` behind a name or a type. `at` ends behind it.
ArraySize InterfaceReader::readSize(std::size_t& at, std::size_t end) const {
    ArraySize size;
    while (at < end && tokens_[at].text == "[") {
        const std::size_t first = ++at;
        for (int depth = 1; at < end; ++at) {
            if (tokens_[at].text == "[") ++depth;
            if (tokens_[at].text == "]" && --depth == 0) break;
        }
        const auto value = constants_.evaluate(tokens_.data() + first, tokens_.data() + at);
        const bool usable = value && value->value > 0 && value->value < std::numeric_limits<std::int32_t>::max();
        size.array = true;
        size.certain = size.certain && usable && value->certain;
        size.count =
            std::min<std::int64_t>(size.count * (usable ? value->value : 1), std::numeric_limits<std::int32_t>::max());
        if (at < end) ++at;
    }
    return size;
}

std::int64_t InterfaceReader::locationsOf(std::string_view type, const ArraySize& size) const {
    std::int64_t each = 1;
    if (const GlslType* known = findGlslType(type)) {
        each = known->columns * (known->componentBytes == 8 && known->components > 2 ? 2 : 1);
    } else if (const auto it = structs_.find(type); it != structs_.end()) {
        each = it->second;
    }
    return std::min(each * size.count, kMostLocations + 1);
}

std::vector<InterfaceMember> InterfaceReader::readMembers(std::size_t begin, std::size_t end) const {
    std::vector<InterfaceMember> members;
    std::string type;
    ArraySize typeSize;
    for (std::size_t at = begin; at < end;) {
        const std::string_view text = tokens_[at].text;
        if (tokens_[at].directive || text == "," || isInterfaceQualifier(text)) {
            ++at;
        } else if (text == ";") {
            type.clear();
            ++at;
        } else if (text == "layout") {
            at = behindParens(at, end);
        } else if (!tokens_[at].isName()) {
            ++at;
        } else if (type.empty()) {
            type = text;
            typeSize = readSize(++at, end);
        } else {
            const SourceLoc where = place(at);
            ArraySize size = readSize(++at, end);
            if (!size.array) size = typeSize;
            members.push_back({std::string(text), type, size, where});
        }
    }
    return members;
}

void InterfaceReader::readStruct(const GlslStatement& statement) {
    const std::size_t name = skipDirectives(statement.begin + 1, statement.brace);
    if (name >= statement.brace) return;
    std::int64_t sum = 0;
    for (const InterfaceMember& member : readMembers(statement.brace + 1, statement.close))
        sum = std::min(sum + locationsOf(member.type, member.size), kMostLocations + 1);
    structs_[tokens_[name].text] = sum;
}

}  // namespace crevice::cocos
