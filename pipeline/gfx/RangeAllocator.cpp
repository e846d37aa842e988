// First fit over a map of holes.
#include "gfx/RangeAllocator.h"

#include <cassert>

namespace crevice {

RangeAllocator::RangeAllocator(std::uint64_t size) : size_(size) {
    if (size > 0) holes_.emplace(0, size);
}

std::optional<std::uint64_t> RangeAllocator::allocate(std::uint64_t size, std::uint64_t alignment) {
    assert(size > 0 && alignment > 0 && (alignment & (alignment - 1)) == 0);
    for (auto hole = holes_.begin(); hole != holes_.end(); ++hole) {
        const auto [begin, length] = *hole;
        const std::uint64_t offset = (begin + alignment - 1) & ~(alignment - 1);
        const std::uint64_t padding = offset - begin;
        if (padding > length || length - padding < size) continue;
        holes_.erase(hole);
        if (padding > 0) holes_.emplace(begin, padding);
        const std::uint64_t rest = length - padding - size;
        if (rest > 0) holes_.emplace(offset + size, rest);
        used_ += size;
        return offset;
    }
    return std::nullopt;
}

void RangeAllocator::free(std::uint64_t offset, std::uint64_t size) {
    assert(size > 0 && offset + size <= size_ && used_ >= size);
    used_ -= size;
    auto next = holes_.lower_bound(offset);
    assert(next == holes_.end() || offset + size <= next->first);  // else freed twice
    if (next != holes_.begin()) {
        const auto previous = std::prev(next);
        assert(previous->first + previous->second <= offset);
        if (previous->first + previous->second == offset) {
            offset = previous->first;
            size += previous->second;
            holes_.erase(previous);
        }
    }
    if (next != holes_.end() && offset + size == next->first) {
        size += next->second;
        holes_.erase(next);
    }
    holes_.emplace(offset, size);
}

}  // namespace crevice
