// Recording: life of the command buffer, order, rendering, binding, drawing. Copies are in CommandsCopy.cpp.
#include "gfx/Commands.h"

#include <cassert>
#include <limits>

#include <fmt/format.h>

#include "core/Error.h"
#include "gfx/Barriers.h"
#include "gfx/Device.h"
#include "gfx/Owned.h"

namespace crevice {

namespace {

VkAttachmentLoadOp toVk(LoadOp op) {
    switch (op) {
        case LoadOp::Load:
            return VK_ATTACHMENT_LOAD_OP_LOAD;
        case LoadOp::Clear:
            return VK_ATTACHMENT_LOAD_OP_CLEAR;
        case LoadOp::Discard:
            return VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    }
    return VK_ATTACHMENT_LOAD_OP_LOAD;
}

VkRenderingAttachmentInfo attachmentInfo(const ColorAttachment& color) {
    auto info = vkStruct<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
    info.imageView = color.texture->attachmentView(color.mip, color.layer);
    info.imageLayout = layoutOf(TextureState::Color);
    info.loadOp = toVk(color.load);
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    info.clearValue.color = clearColorValue(color.texture->format(), color.clear);
    return info;
}

VkRenderingAttachmentInfo attachmentInfo(const DepthAttachment& depth) {
    assert(!depth.readOnly || depth.load == LoadOp::Load);
    auto info = vkStruct<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
    info.imageView = depth.texture->attachmentView(depth.mip, depth.layer);
    info.imageLayout = layoutOf(depth.readOnly ? TextureState::DepthReadOnly : TextureState::Depth);
    info.loadOp = toVk(depth.load);
    // Storing would count as a write, which a read-only attachment must not do.
    info.storeOp = depth.readOnly ? VK_ATTACHMENT_STORE_OP_NONE : VK_ATTACHMENT_STORE_OP_STORE;
    info.clearValue.depthStencil = {depth.clear, 0};
    return info;
}

VkExtent2D areaOf(const RenderingDesc& desc) {
    if (desc.width > 0 && desc.height > 0) return {desc.width, desc.height};
    if (!desc.colors.empty()) {
        const ColorAttachment& first = desc.colors.front();
        return {first.texture->width(first.mip), first.texture->height(first.mip)};
    }
    assert(desc.depth.texture && "rendering without attachments needs a size");
    return {desc.depth.texture->width(desc.depth.mip), desc.depth.texture->height(desc.depth.mip)};
}

}  // namespace

Commands::Commands(Device& device, std::string name) : device_(device), name_(std::move(name)) {
    auto poolInfo = vkStruct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    poolInfo.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    poolInfo.queueFamilyIndex = device.queueFamily();
    VkCommandPool pool = VK_NULL_HANDLE;
    VK_CALL(vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pool));
    pool_ = own<vkDestroyCommandPool, ObjectKind::CommandPool>(device, pool);

    auto info = vkStruct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    info.commandPool = pool;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    VK_CALL(vkAllocateCommandBuffers(device.handle(), &info, &commands_));
    device.setName(VK_OBJECT_TYPE_COMMAND_BUFFER, commands_, name_);

    const auto fenceInfo = vkStruct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    VkFence fence = VK_NULL_HANDLE;
    VK_CALL(vkCreateFence(device.handle(), &fenceInfo, nullptr, &fence));
    fence_ = own<vkDestroyFence, ObjectKind::Fence>(device, fence);
}

Commands::~Commands() = default;

void Commands::begin() {
    // Also drops what was recorded before an exception.
    VK_CALL(vkResetCommandPool(device_.handle(), pool_.get(), 0));
    auto info = vkStruct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    VK_CALL(vkBeginCommandBuffer(commands_, &info));
    pipeline_ = nullptr;
    recording_ = true;
}

void Commands::submitAndWait() {
    assert(recording_);
    recording_ = false;
    VK_CALL(vkEndCommandBuffer(commands_));
    auto buffer = vkStruct<VkCommandBufferSubmitInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO);
    buffer.commandBuffer = commands_;
    auto submit = vkStruct<VkSubmitInfo2>(VK_STRUCTURE_TYPE_SUBMIT_INFO_2);
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &buffer;
    const VkFence fence = fence_.get();
    VkResult result = device_.nextSubmitFault();
    if (result == VK_SUCCESS) result = vkQueueSubmit2(device_.queue(), 1, &submit, fence);
    if (result == VK_SUCCESS) {
        result = vkWaitForFences(device_.handle(), 1, &fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
    }
    if (result == VK_ERROR_DEVICE_LOST) {
        throw RenderError(
            fmt::format("device '{}' was lost while it ran '{}'", device_.deviceName(), name_),
            "the driver reset it, often after a pass that took too long: render fewer pixels with --size, "
            "run again with --validate, or choose another device with --device");
    }
    if (result != VK_SUCCESS) throwVkError(result, "vkQueueSubmit2 and vkWaitForFences");
    VK_CALL(vkResetFences(device_.handle(), 1, &fence));
}

void Commands::barrier(const GpuTexture& texture, TextureState from, TextureState to) {
    const TextureBarrier one{&texture, from, to};
    barriers({&one, 1});
}

void Commands::barriers(std::span<const TextureBarrier> barriers) {
    if (barriers.empty()) return;
    std::vector<VkImageMemoryBarrier2> images;
    for (const TextureBarrier& one : barriers) {
        images.push_back(makeBarrier(*one.texture, one.from, one.to, one.firstMip, one.mipCount));
        if (recorded_) recorded_->push_back({one.texture->desc().name, one.from, one.to});
    }
    auto info = vkStruct<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    info.imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size());
    info.pImageMemoryBarriers = images.data();
    vkCmdPipelineBarrier2(commands_, &info);
}

void Commands::memoryBarrier() {
    auto barrier = vkStruct<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT | VK_ACCESS_2_HOST_READ_BIT;
    auto info = vkStruct<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands_, &info);
}

void Commands::beginRendering(const RenderingDesc& desc) {
    std::vector<VkRenderingAttachmentInfo> colors;
    for (const ColorAttachment& color : desc.colors) colors.push_back(attachmentInfo(color));
    const VkExtent2D area = areaOf(desc);
    auto info = vkStruct<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
    info.renderArea = {{0, 0}, area};
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
    info.pColorAttachments = colors.data();
    VkRenderingAttachmentInfo depth{};
    if (desc.depth.texture) {
        depth = attachmentInfo(desc.depth);
        info.pDepthAttachment = &depth;
        if (desc.depth.texture->desc().stencil) info.pStencilAttachment = &depth;
    }
    vkCmdBeginRendering(commands_, &info);
    setViewport(0, 0, static_cast<float>(area.width), static_cast<float>(area.height));
    setScissor(0, 0, area.width, area.height);
}

void Commands::endRendering() { vkCmdEndRendering(commands_); }

void Commands::setViewport(float x, float y, float width, float height) {
    const VkViewport viewport{x, y, width, height, 0, 1};
    vkCmdSetViewport(commands_, 0, 1, &viewport);
}

void Commands::setScissor(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height) {
    const VkRect2D scissor{{x, y}, {width, height}};
    vkCmdSetScissor(commands_, 0, 1, &scissor);
}

void Commands::bindPipeline(const Pipeline& pipeline) {
    pipeline_ = &pipeline;
    vkCmdBindPipeline(commands_, pipeline.bindPoint(), pipeline.handle());
}

void Commands::bindSet(std::uint32_t index, const DescriptorSet& set, std::span<const std::uint32_t> dynamicOffsets) {
    assert(pipeline_);
    bindSet(pipeline_->bindPoint(), pipeline_->layout(), index, set, dynamicOffsets);
}

void Commands::bindSet(VkPipelineBindPoint point, const PipelineLayout& layout, std::uint32_t index,
                       const DescriptorSet& set, std::span<const std::uint32_t> dynamicOffsets) {
    assert(set && !set.hasPendingWrites() && set.isComplete());
    assert(dynamicOffsets.size() == set.dynamicCount() && index < layout.setCount());
    const VkDescriptorSet handle = set.handle();
    vkCmdBindDescriptorSets(commands_, point, layout.handle(), index, 1, &handle,
                            static_cast<std::uint32_t>(dynamicOffsets.size()), dynamicOffsets.data());
}

void Commands::bindVertexBuffer(std::uint32_t binding, const Buffer& buffer, std::uint64_t offset) {
    const VkBuffer handle = buffer.handle();
    vkCmdBindVertexBuffers(commands_, binding, 1, &handle, &offset);
}

void Commands::bindIndexBuffer(const Buffer& buffer, std::uint64_t offset, bool sixteenBit) {
    vkCmdBindIndexBuffer(commands_, buffer.handle(), offset, sixteenBit ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
}

void Commands::pushConstants(std::span<const std::byte> bytes) {
    assert(pipeline_);
    const PushConstants& push = pipeline_->layout().pushConstants();
    assert(bytes.size() <= push.size);
    vkCmdPushConstants(commands_, pipeline_->layout().handle(), push.stages, 0,
                       static_cast<std::uint32_t>(bytes.size()), bytes.data());
}

void Commands::draw(std::uint32_t vertexCount, std::uint32_t instanceCount, std::uint32_t firstVertex,
                    std::uint32_t firstInstance) {
    ++drawCount_;
    vkCmdDraw(commands_, vertexCount, instanceCount, firstVertex, firstInstance);
}

void Commands::drawIndexed(std::uint32_t indexCount, std::uint32_t instanceCount, std::uint32_t firstIndex,
                           std::int32_t vertexOffset, std::uint32_t firstInstance) {
    ++drawCount_;
    vkCmdDrawIndexed(commands_, indexCount, instanceCount, firstIndex, vertexOffset, firstInstance);
}

void Commands::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) { vkCmdDispatch(commands_, x, y, z); }

void Commands::beginLabel(const std::string& name) { device_.beginLabel(commands_, name.c_str()); }
void Commands::endLabel() { device_.endLabel(commands_); }

void Commands::resetTimestamps(const Timestamps& timestamps) {
    vkCmdResetQueryPool(commands_, timestamps.handle(), 0, timestamps.capacity());
}

void Commands::writeTimestamp(const Timestamps& timestamps, std::uint32_t slot) {
    assert(slot < timestamps.capacity());
    if (!timestamps.isSupported()) return;
    vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps.handle(), slot);
}

}  // namespace crevice
