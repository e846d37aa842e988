// Buffers: Vulkan flags of ours, memory by who touches it.
#include "gfx/Buffer.h"

#include <cassert>
#include <cstring>

#include "gfx/Commands.h"
#include "gfx/Device.h"
#include "gfx/Owned.h"

namespace crevice {

namespace {

VkBufferUsageFlags toVk(BufferUsage usage) {
    VkBufferUsageFlags flags = 0;
    if (hasUsage(usage, BufferUsage::Vertex)) flags |= VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
    if (hasUsage(usage, BufferUsage::Index)) flags |= VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
    if (hasUsage(usage, BufferUsage::Uniform)) flags |= VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    if (hasUsage(usage, BufferUsage::Storage)) flags |= VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    if (hasUsage(usage, BufferUsage::TransferSource)) flags |= VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    if (hasUsage(usage, BufferUsage::TransferDest)) flags |= VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (hasUsage(usage, BufferUsage::Indirect)) flags |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    return flags;
}

MemoryRequest requestFor(const BufferDesc& desc) {
    constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    MemoryRequest request;
    request.name = desc.name.empty() ? "a buffer" : desc.name;
    switch (desc.access) {
        case BufferAccess::HostWrite:
            request.required = kHost;
            // What the GPU reads again and again should be near it; a staging buffer need not.
            if (desc.usage != BufferUsage::TransferSource) request.preferred = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
            break;
        case BufferAccess::HostRead:
            request.required = kHost;
            request.preferred = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
            break;
        case BufferAccess::DeviceOnly:
            request.preferred = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
            break;
    }
    return request;
}

}  // namespace

Buffer::Buffer(Device& device, BufferDesc desc) : desc_(std::move(desc)) {
    assert(desc_.size > 0 && desc_.usage != BufferUsage::None);
    auto info = vkStruct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = desc_.size;
    info.usage = toVk(desc_.usage);
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    VkBuffer buffer = VK_NULL_HANDLE;
    VK_CALL(vkCreateBuffer(device.handle(), &info, nullptr, &buffer));
    buffer_ = own<vkDestroyBuffer, ObjectKind::Buffer>(device, buffer);
    device.setName(VK_OBJECT_TYPE_BUFFER, buffer, desc_.name);

    MemoryRequest request = requestFor(desc_);
    vkGetBufferMemoryRequirements(device.handle(), buffer, &request.requirements);
    memory_ = device.memory().allocate(request);
    VK_CALL(vkBindBufferMemory(device.handle(), buffer, memory_.memory(), memory_.offset()));
}

Buffer::Buffer(Device& device, BufferDesc desc, std::span<const std::byte> bytes)
    : Buffer(device, [&] {
          desc.usage = desc.access == BufferAccess::DeviceOnly ? desc.usage | BufferUsage::TransferDest : desc.usage;
          return std::move(desc);
      }()) {
    assert(bytes.size() <= desc_.size);
    if (memory_.mapped()) {  // shared memory: GPUs in the CPU, lavapipe, resizable BAR
        std::memcpy(memory_.mapped(), bytes.data(), bytes.size());
        return;
    }
    const Buffer staging(device, {.size = bytes.size(), .usage = BufferUsage::TransferSource, .name = "staging"},
                         bytes);
    Commands commands(device, "upload");
    commands.begin();
    commands.copyBuffer(staging, *this, bytes.size());
    commands.memoryBarrier();
    commands.submitAndWait();
}

std::span<std::byte> Buffer::data() {
    if (desc_.access == BufferAccess::DeviceOnly || !memory_.mapped()) return {};
    return {memory_.mapped(), static_cast<std::size_t>(desc_.size)};
}

std::span<const std::byte> Buffer::data() const {
    if (desc_.access == BufferAccess::DeviceOnly || !memory_.mapped()) return {};
    return {memory_.mapped(), static_cast<std::size_t>(desc_.size)};
}

void Buffer::write(std::span<const std::byte> bytes, std::uint64_t offset) {
    assert(desc_.access != BufferAccess::DeviceOnly && offset + bytes.size() <= desc_.size);
    if (!bytes.empty()) std::memcpy(memory_.mapped() + offset, bytes.data(), bytes.size());
}

}  // namespace crevice
