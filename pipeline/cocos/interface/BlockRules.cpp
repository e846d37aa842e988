// std140 offsets (OpenGL 4.6 specification, 7.6.2.2) against the tight sum of sizes.
#include "cocos/interface/BlockRules.h"

#include <fmt/format.h>

#include <set>

#include "cocos/interface/GlslTypes.h"

namespace crevice::cocos {
namespace {

struct Extent {
    std::int64_t align = 0, bytes = 0, tight = 0;
};

std::int64_t roundUp(std::int64_t value, std::int64_t step) { return (value + step - 1) / step * step; }

/// Nothing for structs, whose members are not looked at.
Extent extentOf(const InterfaceMember& member) {
    const GlslType* type = findGlslType(member.type);
    if (type == nullptr || type->components == 0) return {};
    const std::int64_t tight =
        std::int64_t(type->components) * type->componentBytes * type->columns * member.size.count;
    const std::int64_t vectorAlign = std::int64_t(type->components == 3 ? 4 : type->components) * type->componentBytes;
    if (!member.size.array && type->columns == 1)
        return {vectorAlign, std::int64_t(type->components) * type->componentBytes, tight};
    const std::int64_t stride = roundUp(vectorAlign, 16);
    return {stride, stride * type->columns * member.size.count, tight};
}

}  // namespace

void checkBlock(const InterfaceDeclaration& block, Problems& problems) {
    if (block.size.array) {
        problems.error(block.where, fmt::format("'{}' is an array of uniform blocks", block.name),
                       "make its members arrays");
        return;
    }
    if (block.builtin != Builtin::None) return;
    std::int64_t offset = 0, tight = 0;
    for (const InterfaceMember& member : block.members) {
        const Extent extent = extentOf(member);
        if (extent.align == 0) return;
        const std::int64_t place = roundUp(offset, extent.align);
        const bool moved = place != tight, hollow = extent.bytes != extent.tight;
        if (moved || hollow) {
            problems.warning(
                member.where,
                fmt::format("'{}' of block '{}' {}", member.name, block.name,
                            moved ? fmt::format("begins at byte {} by std140, but at {} without holes", place, tight)
                                  : "has holes between its elements by std140"),
                "Cocos' runtime knows no holes: order the members from vec4 to float, or use vec4s");
            return;
        }
        offset = place + extent.bytes;
        tight += extent.tight;
    }
}

std::int64_t uniformVectors(const StageInterface& stage) {
    std::int64_t sum = 0;
    std::set<std::string_view> counted;
    for (const InterfaceDeclaration& block : stage.declarations) {
        if (block.kind != InterfaceKind::Block || !counted.insert(block.name).second) continue;
        for (const InterfaceMember& member : block.members) {
            const GlslType* type = findGlslType(member.type);
            if (type == nullptr || !member.size.certain) continue;
            const std::int64_t bytes = std::int64_t(type->components) * type->componentBytes * type->columns;
            sum += (bytes + 15) / 16 * member.size.count;
        }
    }
    return sum;
}

void reportLooseUniform(const SourceLoc& where, Problems& problems) {
    problems.error(where, "a uniform stands outside of a block",
                   "put it in a block: uniform Constants { vec4 name; };");
}

}  // namespace crevice::cocos
