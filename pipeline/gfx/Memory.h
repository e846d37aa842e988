// Device memory in few big blocks: images and buffers take ranges of 64 MiB blocks, large ones a block of their own.
#pragma once

#include <cstdint>
#include <list>
#include <string>

#include "gfx/LiveObjects.h"
#include "gfx/RangeAllocator.h"
#include "gfx/Vk.h"

namespace crevice {

class MemoryAllocator;
struct MemoryBlock;

/// A range of device memory; gives itself back. Move-only.
class Allocation {
public:
    Allocation() = default;
    Allocation(MemoryAllocator& owner, MemoryBlock& block, std::uint64_t offset, std::uint64_t size);
    Allocation(Allocation&& other) noexcept;
    Allocation& operator=(Allocation&& other) noexcept;
    ~Allocation();

    VkDeviceMemory memory() const;
    std::uint64_t offset() const { return offset_; }
    std::uint64_t size() const { return size_; }
    /// First byte when the memory is host-visible, else null.
    std::byte* mapped() const;

private:
    void release();
    MemoryAllocator* owner_ = nullptr;
    MemoryBlock* block_ = nullptr;
    std::uint64_t offset_ = 0;
    std::uint64_t size_ = 0;
};

/// What memory a resource wants; the first type that has all `required` and most `preferred` flags is taken.
struct MemoryRequest {
    VkMemoryRequirements requirements{};
    VkMemoryPropertyFlags required = 0;
    VkMemoryPropertyFlags preferred = 0;
    bool linear = true;  ///< Buffers. Images live in other blocks, so that bufferImageGranularity never matters.
    std::string name;    ///< For "out of memory" messages.
};

/// A vkAllocateMemory of its own, divided by a RangeAllocator.
struct MemoryBlock {
    Unique<VkDeviceMemory> memory;
    std::uint32_t type = 0;
    bool linear = true;
    bool dedicated = false;
    std::byte* mapped = nullptr;
    RangeAllocator ranges;
};

class MemoryAllocator {
public:
    static constexpr std::uint64_t kBlockBytes = 64u << 20;
    static constexpr std::uint64_t kDedicatedBytes = 16u << 20;  ///< From this size on a resource has its own block.

    /// `failAt`: number of the allocate() call that fails, for tests; -1 = never.
    MemoryAllocator(VkPhysicalDevice physical, VkDevice device, LiveObjects& live, int failAt);

    /// Throws RenderError in words when the device has no memory left.
    Allocation allocate(const MemoryRequest& request);

    /// Tests: the allocate() call with this number, counted from now, fails; -1 = never.
    void failAt(int call) {
        calls_ = 0;
        failAt_ = call;
    }
    std::uint64_t usedBytes() const { return used_; }
    std::uint64_t heapBytes() const;  ///< The largest device-local heap.

private:
    friend class Allocation;
    std::uint32_t findType(const MemoryRequest& request) const;
    MemoryBlock& addBlock(const MemoryRequest& request, std::uint32_t type, std::uint64_t bytes, bool dedicated);
    Allocation takeRange(MemoryBlock& block, std::uint64_t offset, std::uint64_t size);
    void release(MemoryBlock& block, std::uint64_t offset, std::uint64_t size);
    [[noreturn]] void throwOutOfMemory(const MemoryRequest& request) const;

    VkDevice device_;
    LiveObjects& live_;
    VkPhysicalDeviceMemoryProperties properties_{};
    std::list<MemoryBlock> blocks_;  ///< Addresses stay: Allocation points into it.
    std::uint64_t used_ = 0;
    int calls_ = 0;
    int failAt_;
};

}  // namespace crevice
