// Blocks of device memory: found by type, made when none has room, returned when the last range is freed.
#include "gfx/Memory.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include <fmt/format.h>

#include "core/Error.h"

namespace crevice {

namespace {

constexpr double kMiB = 1024.0 * 1024.0;

void freeMemory(void* device, VkDeviceMemory memory) { vkFreeMemory(static_cast<VkDevice>(device), memory, nullptr); }

}  // namespace

Allocation::Allocation(MemoryAllocator& owner, MemoryBlock& block, std::uint64_t offset, std::uint64_t size)
    : owner_(&owner), block_(&block), offset_(offset), size_(size) {}

Allocation::Allocation(Allocation&& other) noexcept
    : owner_(std::exchange(other.owner_, nullptr)),
      block_(std::exchange(other.block_, nullptr)),
      offset_(std::exchange(other.offset_, 0)),
      size_(std::exchange(other.size_, 0)) {}

Allocation& Allocation::operator=(Allocation&& other) noexcept {
    if (this != &other) {
        release();
        owner_ = std::exchange(other.owner_, nullptr);
        block_ = std::exchange(other.block_, nullptr);
        offset_ = std::exchange(other.offset_, 0);
        size_ = std::exchange(other.size_, 0);
    }
    return *this;
}

Allocation::~Allocation() { release(); }

VkDeviceMemory Allocation::memory() const { return block_ ? block_->memory.get() : VK_NULL_HANDLE; }

std::byte* Allocation::mapped() const { return block_ && block_->mapped ? block_->mapped + offset_ : nullptr; }

void Allocation::release() {
    if (owner_) std::exchange(owner_, nullptr)->release(*block_, offset_, size_);
}

MemoryAllocator::MemoryAllocator(VkPhysicalDevice physical, VkDevice device, LiveObjects& live, int failAt)
    : device_(device), live_(live), failAt_(failAt) {
    vkGetPhysicalDeviceMemoryProperties(physical, &properties_);
}

Allocation MemoryAllocator::allocate(const MemoryRequest& request) {
    if (calls_++ == failAt_) throwOutOfMemory(request);
    const std::uint32_t type = findType(request);
    const std::uint64_t size = request.requirements.size;
    if (size >= kDedicatedBytes) return takeRange(addBlock(request, type, size, true), 0, size);
    for (MemoryBlock& block : blocks_) {
        if (block.type != type || block.linear != request.linear || block.dedicated) continue;
        const auto offset = block.ranges.allocate(size, request.requirements.alignment);
        if (offset) return takeRange(block, *offset, size);
    }
    return takeRange(addBlock(request, type, kBlockBytes, false), 0, size);
}

/// Counts the range; one at the start of a fresh block is taken from it here.
Allocation MemoryAllocator::takeRange(MemoryBlock& block, std::uint64_t offset, std::uint64_t size) {
    if (block.ranges.isEmpty()) {
        [[maybe_unused]] const auto first = block.ranges.allocate(size, 1);
        assert(first == offset);
    }
    used_ += size;
    ++live_[ObjectKind::Allocation];
    return Allocation(*this, block, offset, size);
}

void MemoryAllocator::release(MemoryBlock& block, std::uint64_t offset, std::uint64_t size) {
    block.ranges.free(offset, size);
    used_ -= size;
    --live_[ObjectKind::Allocation];
    if (!block.ranges.isEmpty()) return;
    live_.memoryBytes -= block.ranges.size();
    --live_[ObjectKind::MemoryBlock];
    blocks_.remove_if([&](const MemoryBlock& candidate) { return &candidate == &block; });
}

std::uint32_t MemoryAllocator::findType(const MemoryRequest& request) const {
    int bestScore = -1;
    std::uint32_t best = 0;
    for (std::uint32_t type = 0; type < properties_.memoryTypeCount; ++type) {
        const VkMemoryPropertyFlags flags = properties_.memoryTypes[type].propertyFlags;
        const bool allowed = (request.requirements.memoryTypeBits >> type & 1) != 0;
        if (!allowed || (flags & request.required) != request.required) continue;
        const int score = std::popcount(flags & request.preferred);
        if (score > bestScore) {
            bestScore = score;
            best = type;
        }
    }
    if (bestScore < 0)
        throw RenderError(fmt::format("the device has no memory of the kind that '{}' needs", request.name));
    return best;
}

MemoryBlock& MemoryAllocator::addBlock(const MemoryRequest& request, std::uint32_t type, std::uint64_t bytes,
                                       bool dedicated) {
    // A heap smaller than eight blocks (a phone's, a test driver's) is not worth a whole block.
    const std::uint64_t heap = properties_.memoryHeaps[properties_.memoryTypes[type].heapIndex].size;
    if (!dedicated) bytes = std::max(std::min(bytes, heap / 8), request.requirements.size);

    auto info = vkStruct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = bytes;
    info.memoryTypeIndex = type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    const VkResult result = vkAllocateMemory(device_, &info, nullptr, &memory);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY) throwOutOfMemory(request);
    VK_CALL(result);

    MemoryBlock block{.memory = {memory, device_, freeMemory},
                      .type = type,
                      .linear = request.linear,
                      .dedicated = dedicated,
                      .mapped = nullptr,
                      .ranges = RangeAllocator(bytes)};
    constexpr VkMemoryPropertyFlags kMappable =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    if (request.linear && (properties_.memoryTypes[type].propertyFlags & kMappable) == kMappable) {
        void* mapped = nullptr;
        VK_CALL(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped));
        block.mapped = static_cast<std::byte*>(mapped);
    }
    live_.memoryBytes += bytes;
    ++live_[ObjectKind::MemoryBlock];
    return blocks_.emplace_back(std::move(block));
}

std::uint64_t MemoryAllocator::heapBytes() const {
    std::uint64_t largest = 0;
    for (std::uint32_t i = 0; i < properties_.memoryHeapCount; ++i) {
        const VkMemoryHeap& heap = properties_.memoryHeaps[i];
        if (heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) largest = std::max(largest, heap.size);
    }
    return largest;
}

void MemoryAllocator::throwOutOfMemory(const MemoryRequest& request) const {
    throw RenderError(
        fmt::format("out of GPU memory: '{}' needs {:.1f} MiB, {:.1f} MiB are in use, the device has {:.0f} MiB",
                    request.name, static_cast<double>(request.requirements.size) / kMiB,
                    static_cast<double>(used_) / kMiB, static_cast<double>(heapBytes()) / kMiB),
        "render fewer pixels with --size, or a smaller scene");
}

}  // namespace crevice
