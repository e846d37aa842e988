// A buffer with its memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "gfx/Memory.h"
#include "gfx/Vk.h"

namespace crevice {

class Device;

enum class BufferUsage : std::uint32_t {
    None = 0,
    Vertex = 1,
    Index = 2,
    Uniform = 4,
    Storage = 8,
    TransferSource = 16,
    TransferDest = 32,
    Indirect = 64
};
constexpr BufferUsage operator|(BufferUsage a, BufferUsage b) {
    return static_cast<BufferUsage>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr bool hasUsage(BufferUsage set, BufferUsage flag) {
    return (static_cast<std::uint32_t>(set) & static_cast<std::uint32_t>(flag)) != 0;
}

/// Who touches the bytes besides the GPU. Host memory is coherent and stays mapped.
enum class BufferAccess : std::uint8_t { HostWrite, HostRead, DeviceOnly };

struct BufferDesc {
    std::uint64_t size = 0;  ///< Bytes, > 0.
    BufferUsage usage = BufferUsage::None;
    BufferAccess access = BufferAccess::HostWrite;
    std::string name{};
};

class Buffer {
public:
    Buffer() = default;
    Buffer(Device& device, BufferDesc desc);
    /// Makes a buffer and fills it; a DeviceOnly buffer through a staging copy that is waited for.
    Buffer(Device& device, BufferDesc desc, std::span<const std::byte> bytes);

    const BufferDesc& desc() const { return desc_; }
    std::uint64_t size() const { return desc_.size; }
    VkBuffer handle() const { return buffer_.get(); }
    explicit operator bool() const { return static_cast<bool>(buffer_); }

    /// Mapped bytes; empty for DeviceOnly.
    std::span<std::byte> data();
    std::span<const std::byte> data() const;
    /// Copies into mapped memory. offset + bytes must lie inside.
    void write(std::span<const std::byte> bytes, std::uint64_t offset = 0);

private:
    BufferDesc desc_;
    Allocation memory_;  // before the buffer: freed after it
    Unique<VkBuffer> buffer_;
};

}  // namespace crevice
