// Sparse accessors: their indices must increase and be below the count.
#include <algorithm>
#include <cstdint>
#include <iterator>

#include <fmt/format.h>

#include "scene/GltfLayout.h"

namespace crevice::gltf {

// Runs of one type at addresses that differ by whole elements never overlap: each is prolonged until it meets the next
// and swallows that. So every integer of the file is compared once for each type and remainder.
std::size_t IncreasingRuns::findBreak(const unsigned char* data, int type, std::size_t count) {
    const std::size_t size = componentSize(type);
    const unsigned char* const end = data + count * size;
    Runs& runs = runs_[{type, reinterpret_cast<std::uintptr_t>(data) % size}];
    auto next = runs.upper_bound(data);
    const bool isInside = next != runs.begin() && std::prev(next)->second > data;
    const auto run = isInside ? std::prev(next) : runs.emplace_hint(next, data, data + size);
    const unsigned char*& at = run->second;
    while (at < end) {
        ++visited_;
        if (toInteger(at, type) <= toInteger(at - size, type)) return std::size_t(at - data) / size;
        at += size;
        if (next == runs.end() || next->first >= at) continue;
        at = next->second;  // its first element is the one that was just compared
        next = runs.erase(next);
    }
    return count;
}

void checkSparse(const File& file, std::size_t index, const Elements& indices) {
    const AccessorPart& accessor = file.model.accessors[index];
    const SparsePart& sparse = *accessor.sparse;
    const auto indexAt = [&](std::size_t i) {
        return toInteger(indices.data + i * indices.stride, sparse.indicesType);
    };
    const std::size_t broken = file.increasing.findBreak(indices.data, sparse.indicesType, sparse.count);
    if (broken < sparse.count)
        file.fail("accessors", index,
                  fmt::format("sparse index {} at {} is not above the one before", indexAt(broken), broken));
    if (indexAt(sparse.count - 1) < accessor.count) return;
    std::size_t low = 0, high = sparse.count - 1;  // the first that is too large
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (indexAt(middle) < accessor.count)
            low = middle + 1;
        else
            high = middle;
    }
    file.fail("accessors", index,
              fmt::format("sparse index {} at {} is not below 'count' {}", indexAt(low), low, accessor.count));
}

}  // namespace crevice::gltf
