// How many Vulkan objects of each kind are alive: equal at frames 3 and 100, or something leaks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace crevice {

enum class ObjectKind : std::uint8_t {
    Image,
    ImageView,
    Buffer,
    Sampler,
    Pipeline,
    PipelineLayout,
    SetLayout,
    DescriptorPool,
    DescriptorSet,
    CommandPool,
    Fence,
    QueryPool,
    Allocation,
    MemoryBlock
};
inline constexpr std::size_t kObjectKindCount = 14;

const char* objectKindName(ObjectKind kind);

struct LiveObjects {
    std::array<std::int64_t, kObjectKindCount> counts{};
    std::uint64_t memoryBytes = 0;  ///< Asked from the driver: whole blocks, not only what is used of them.

    std::int64_t& operator[](ObjectKind kind) { return counts[static_cast<std::size_t>(kind)]; }
    std::int64_t operator[](ObjectKind kind) const { return counts[static_cast<std::size_t>(kind)]; }
    bool operator==(const LiveObjects&) const = default;
    /// "images 3, buffers 1, memory 67108864 bytes"; kinds with none are left out.
    std::string text() const;
};

}  // namespace crevice
