// First-fit allocation of byte ranges in a block of fixed size; pure arithmetic, no Vulkan.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace crevice {

class RangeAllocator {
public:
    explicit RangeAllocator(std::uint64_t size = 0);

    /// Offset of a free range of `size` > 0 bytes at a multiple of `alignment` (a power of two), or nothing.
    std::optional<std::uint64_t> allocate(std::uint64_t size, std::uint64_t alignment);
    /// Gives back exactly what allocate() returned; neighbours merge.
    void free(std::uint64_t offset, std::uint64_t size);

    bool isEmpty() const { return used_ == 0; }
    std::uint64_t used() const { return used_; }
    std::uint64_t size() const { return size_; }
    /// Number of separate holes: 1 when everything is free.
    std::size_t holeCount() const { return holes_.size(); }

private:
    std::uint64_t size_;
    std::uint64_t used_ = 0;
    std::map<std::uint64_t, std::uint64_t> holes_;  ///< Offset → size, never adjacent to each other.
};

}  // namespace crevice
