// Pipeline layouts, and the cache that makes a pipeline once per full description.
#include "gfx/Pipeline.h"

#include <cassert>

#include "gfx/Device.h"
#include "gfx/Owned.h"
#include "gfx/PipelineBuild.h"

namespace crevice {

const PipelineLayout& PipelineLayoutCache::get(std::span<const SetLayout* const> sets, PushConstants push) {
    std::vector<std::vector<SetLayoutBinding>> contents;
    std::vector<VkDescriptorSetLayout> handles;
    for (const SetLayout* set : sets) {
        contents.push_back(set->bindings());
        handles.push_back(set->handle());
    }
    for (const auto& layout : layouts_) {
        if (layout->push_ == push && layout->sets_ == contents) return *layout;
    }

    const VkPushConstantRange range{push.stages, 0, push.size};
    auto info = vkStruct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = static_cast<std::uint32_t>(handles.size());
    info.pSetLayouts = handles.data();
    info.pushConstantRangeCount = push.size > 0 ? 1 : 0;
    info.pPushConstantRanges = &range;
    VkPipelineLayout handle = VK_NULL_HANDLE;
    VK_CALL(vkCreatePipelineLayout(device_.handle(), &info, nullptr, &handle));
    auto layout = std::make_unique<PipelineLayout>();
    layout->layout_ = own<vkDestroyPipelineLayout, ObjectKind::PipelineLayout>(device_, handle);
    layout->sets_ = std::move(contents);
    layout->push_ = push;
    return *layouts_.emplace_back(std::move(layout));
}

/// Everything a pipeline depends on, by value. Layouts are compared by address: their cache keeps them unique.
struct PipelineCache::Key {
    std::vector<std::uint32_t> vertex, fragment, compute;
    RenderState state;
    std::vector<VertexBinding> vertexBindings;
    std::vector<VertexAttribute> vertexAttributes;
    std::vector<Format> colorFormats;
    std::optional<Format> depthFormat;
    bool stencil = false;
    const PipelineLayout* layout = nullptr;
    bool operator==(const Key&) const = default;

    /// FNV-1a over the words of the shaders: only picks the bucket.
    std::size_t hash() const {
        std::uint64_t hash = 0xcbf29ce484222325u;
        for (const auto* words : {&vertex, &fragment, &compute}) {
            for (const std::uint32_t word : *words) hash = (hash ^ word) * 0x100000001b3u;
        }
        return static_cast<std::size_t>(hash);
    }
};

struct PipelineCache::Entry {
    Key key;
    Pipeline pipeline;
};

PipelineCache::PipelineCache(Device& device) : device_(device) {}
PipelineCache::~PipelineCache() = default;

const Pipeline* PipelineCache::find(const Key& key) const {
    const auto [first, last] = entries_.equal_range(key.hash());
    for (auto entry = first; entry != last; ++entry) {
        if (entry->second->key == key) return &entry->second->pipeline;
    }
    return nullptr;
}

const Pipeline& PipelineCache::add(Key key, Pipeline pipeline) {
    ++created_;
    const std::size_t hash = key.hash();
    auto entry = std::make_unique<Entry>(Entry{std::move(key), std::move(pipeline)});
    return entries_.emplace(hash, std::move(entry))->second->pipeline;
}

const Pipeline& PipelineCache::get(const GraphicsPipelineDesc& desc) {
    assert(desc.layout && !desc.vertex.empty());
    Key key;
    key.vertex.assign(desc.vertex.begin(), desc.vertex.end());
    key.fragment.assign(desc.fragment.begin(), desc.fragment.end());
    key.state = desc.state;
    key.vertexBindings = desc.vertexBindings;
    key.vertexAttributes = desc.vertexAttributes;
    key.colorFormats = desc.colorFormats;
    key.stencil = desc.stencil;
    key.depthFormat = desc.depthFormat;
    key.layout = desc.layout;
    if (const Pipeline* known = find(key)) return *known;
    return add(std::move(key),
               Pipeline(buildGraphicsPipeline(device_, desc), VK_PIPELINE_BIND_POINT_GRAPHICS, *desc.layout));
}

const Pipeline& PipelineCache::get(const ComputePipelineDesc& desc) {
    assert(desc.layout && !desc.compute.empty());
    Key key;
    key.compute.assign(desc.compute.begin(), desc.compute.end());
    key.layout = desc.layout;
    if (const Pipeline* known = find(key)) return *known;
    return add(std::move(key),
               Pipeline(buildComputePipeline(device_, desc), VK_PIPELINE_BIND_POINT_COMPUTE, *desc.layout));
}

}  // namespace crevice
