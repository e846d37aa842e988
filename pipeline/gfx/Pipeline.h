// Pipelines and pipeline layouts from plain descriptions, cached by full comparison.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/Format.h"
#include "core/RenderState.h"
#include "gfx/Descriptors.h"
#include "gfx/Vk.h"

namespace crevice {

class Device;

struct PushConstants {
    std::uint32_t stages = 0;  ///< Vulkan's bits.
    std::uint32_t size = 0;    ///< Bytes from offset 0; 0 = none.
    bool operator==(const PushConstants&) const = default;
};

class PipelineLayout {
public:
    VkPipelineLayout handle() const { return layout_.get(); }
    const PushConstants& pushConstants() const { return push_; }
    std::size_t setCount() const { return sets_.size(); }

private:
    friend class PipelineLayoutCache;
    std::vector<std::vector<SetLayoutBinding>> sets_;  ///< Contents: equal ones are compatible in Vulkan.
    PushConstants push_;
    Unique<VkPipelineLayout> layout_;
};

class PipelineLayoutCache {
public:
    explicit PipelineLayoutCache(Device& device) : device_(device) {}
    /// Set i of the layout is `sets[i]`. The result lives as long as the cache; the set layouts need not.
    const PipelineLayout& get(std::span<const SetLayout* const> sets, PushConstants push = {});
    std::size_t size() const { return layouts_.size(); }

private:
    Device& device_;
    std::vector<std::unique_ptr<PipelineLayout>> layouts_;
};

enum class VertexFormat : std::uint8_t { Float, Float2, Float3, Float4, UByte4Norm, UInt, UInt4 };

struct VertexBinding {
    std::uint32_t binding = 0;
    std::uint32_t stride = 0;
    bool perInstance = false;
    bool operator==(const VertexBinding&) const = default;
};
struct VertexAttribute {
    std::uint32_t location = 0;
    std::uint32_t binding = 0;
    VertexFormat format = VertexFormat::Float3;
    std::uint32_t offset = 0;
    bool operator==(const VertexAttribute&) const = default;
};

struct GraphicsPipelineDesc {
    std::span<const std::uint32_t> vertex;    ///< SPIR-V, entry point "main". Copied where it must outlive the call.
    std::span<const std::uint32_t> fragment;  ///< Empty = depth only.
    RenderState state;
    std::vector<VertexBinding> vertexBindings;
    std::vector<VertexAttribute> vertexAttributes;
    std::vector<Format> colorFormats;
    std::optional<Format> depthFormat;  ///< None = no depth attachment: depth state is ignored.
    bool stencil = false;               ///< The depth attachment has a stencil; without one stencil tests are ignored.
    const PipelineLayout* layout = nullptr;
    std::string name{};  ///< For messages and captures; not part of the key.
};

struct ComputePipelineDesc {
    std::span<const std::uint32_t> compute;
    const PipelineLayout* layout = nullptr;
    std::string name{};
};

class Pipeline {
public:
    Pipeline(Unique<VkPipeline> pipeline, VkPipelineBindPoint point, const PipelineLayout& layout)
        : pipeline_(std::move(pipeline)), point_(point), layout_(&layout) {}
    VkPipeline handle() const { return pipeline_.get(); }
    VkPipelineBindPoint bindPoint() const { return point_; }
    const PipelineLayout& layout() const { return *layout_; }

private:
    Unique<VkPipeline> pipeline_;
    VkPipelineBindPoint point_;
    const PipelineLayout* layout_;
};

/// Look up when a stage is prepared, not per draw: the key holds the whole SPIR-V. Viewport and scissor are dynamic.
class PipelineCache {
public:
    explicit PipelineCache(Device& device);
    ~PipelineCache();
    /// Lives as long as the cache. Throws RenderError when the driver refuses.
    const Pipeline& get(const GraphicsPipelineDesc& desc);
    const Pipeline& get(const ComputePipelineDesc& desc);
    /// Pipelines made by the driver so far, for benches.
    std::size_t createdCount() const { return created_; }

private:
    struct Key;
    struct Entry;
    const Pipeline* find(const Key& key) const;
    const Pipeline& add(Key key, Pipeline pipeline);

    Device& device_;
    std::size_t created_ = 0;
    std::unordered_multimap<std::size_t, std::unique_ptr<Entry>> entries_;
};

}  // namespace crevice
