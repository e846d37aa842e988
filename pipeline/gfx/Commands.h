// A recorder of GPU work: barriers in terms of texture states, rendering, binding, drawing, copies; submit and wait.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "gfx/Buffer.h"
#include "gfx/Descriptors.h"
#include "gfx/Pipeline.h"
#include "gfx/Sampler.h"
#include "gfx/Texture.h"
#include "gfx/Timestamps.h"
#include "gfx/Vk.h"

namespace crevice {

class Device;

/// A move from one state to another. Equal states order a write after a write (or a read) of the same kind.
struct TextureBarrier {
    const GpuTexture* texture = nullptr;
    TextureState from = TextureState::Undefined;  ///< Undefined discards the contents.
    TextureState to = TextureState::Undefined;
    std::uint32_t firstMip = 0;
    std::uint32_t mipCount = 0;  ///< 0 = all from firstMip.
};

/// A barrier as it was recorded, for tests that compare a frame with its plan.
struct RecordedBarrier {
    std::string texture;
    TextureState from = TextureState::Undefined;
    TextureState to = TextureState::Undefined;
    bool operator==(const RecordedBarrier&) const = default;
};

enum class LoadOp : std::uint8_t { Load, Clear, Discard };

struct ColorAttachment {
    const GpuTexture* texture = nullptr;
    LoadOp load = LoadOp::Clear;
    glm::vec4 clear{0};
    std::uint32_t mip = 0, layer = 0;
};
struct DepthAttachment {
    const GpuTexture* texture = nullptr;  ///< Null = none.
    LoadOp load = LoadOp::Clear;
    float clear = 1;
    bool readOnly = false;  ///< State DepthReadOnly (may be sampled at once) instead of Depth; load must be Load.
    std::uint32_t mip = 0, layer = 0;
};
struct RenderingDesc {
    std::vector<ColorAttachment> colors;
    DepthAttachment depth{};
    std::uint32_t width = 0, height = 0;  ///< 0 = those of the first attachment's mip.
};

/// One command buffer with its pool and fence; reusable after submitAndWait(). Records nothing between submit and
/// begin().
class Commands {
public:
    explicit Commands(Device& device, std::string name = "commands");
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    void begin();
    /// Ends, submits and waits. Throws RenderError, in words when the device is lost.
    void submitAndWait();

    // Order and visibility
    void barrier(const GpuTexture& texture, TextureState from, TextureState to);
    void barriers(std::span<const TextureBarrier> barriers);
    /// Everything before is finished and visible to everything after, the host included.
    void memoryBarrier();
    /// Barriers are appended here as they are recorded; null = nowhere.
    void recordBarriersTo(std::vector<RecordedBarrier>* list) { recorded_ = list; }

    // Rendering; also sets viewport and scissor to the whole area.
    void beginRendering(const RenderingDesc& desc);
    void endRendering();
    void setViewport(float x, float y, float width, float height);
    void setScissor(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height);

    // Binding and drawing
    void bindPipeline(const Pipeline& pipeline);
    /// The layout of the pipeline bound last is used; `dynamicOffsets` in the order of binding numbers.
    void bindSet(std::uint32_t index, const DescriptorSet& set, std::span<const std::uint32_t> dynamicOffsets = {});
    /// For sets bound before any pipeline.
    void bindSet(VkPipelineBindPoint point, const PipelineLayout& layout, std::uint32_t index, const DescriptorSet& set,
                 std::span<const std::uint32_t> dynamicOffsets = {});
    void bindVertexBuffer(std::uint32_t binding, const Buffer& buffer, std::uint64_t offset = 0);
    void bindIndexBuffer(const Buffer& buffer, std::uint64_t offset = 0, bool sixteenBit = false);
    void pushConstants(std::span<const std::byte> bytes);
    void draw(std::uint32_t vertexCount, std::uint32_t instanceCount = 1, std::uint32_t firstVertex = 0,
              std::uint32_t firstInstance = 0);
    void drawIndexed(std::uint32_t indexCount, std::uint32_t instanceCount = 1, std::uint32_t firstIndex = 0,
                     std::int32_t vertexOffset = 0, std::uint32_t firstInstance = 0);
    void dispatch(std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
    /// draw() and drawIndexed() since this was made.
    std::uint64_t drawCount() const { return drawCount_; }

    // Clears outside rendering; the texture is in TransferDest.
    void clearColor(const GpuTexture& texture, const glm::vec4& value);
    void clearDepth(const GpuTexture& texture, float value);

    // Copies; textures are in TransferSource / TransferDest.
    void copyTextureToBuffer(const GpuTexture& texture, const Buffer& buffer, std::uint32_t mip = 0,
                             std::uint32_t layer = 0, std::uint64_t bufferOffset = 0);
    void copyBufferToTexture(const Buffer& buffer, const GpuTexture& texture, std::uint32_t mip = 0,
                             std::uint32_t layer = 0, std::uint64_t bufferOffset = 0);
    void copyBuffer(const Buffer& from, const Buffer& to, std::uint64_t bytes, std::uint64_t fromOffset = 0,
                    std::uint64_t toOffset = 0);
    void fillBuffer(const Buffer& buffer, std::uint32_t word);

    // Debugging and time
    void beginLabel(const std::string& name);
    void endLabel();
    /// Once per frame, before the first write.
    void resetTimestamps(const Timestamps& timestamps);
    /// When everything recorded before has finished.
    void writeTimestamp(const Timestamps& timestamps, std::uint32_t slot);

    Device& device() { return device_; }
    VkCommandBuffer handle() const { return commands_; }

private:
    Device& device_;
    std::string name_;
    Unique<VkCommandPool> pool_;
    Unique<VkFence> fence_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    const Pipeline* pipeline_ = nullptr;
    std::vector<RecordedBarrier>* recorded_ = nullptr;
    std::uint64_t drawCount_ = 0;
    bool recording_ = false;
};

}  // namespace crevice
