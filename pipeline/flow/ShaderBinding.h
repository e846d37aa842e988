// Set 1 of one shader with one material: its block values, its textures and the targets it is wired to.
#pragma once

#include <utility>
#include <vector>

#include "flow/FileTextures.h"
#include "flow/FrameProgram.h"
#include "flow/GlobalSet.h"
#include "flow/SceneGpu.h"
#include "flow/TargetPool.h"

namespace crevice {

/// What bindings and pipelines of all stages are made with.
struct BindingContext {
    Device& device;
    DescriptorPool& pool;
    SamplerCache& samplers;
    const DefaultTextures& defaults;
    FileTextures& files;
};

class ShaderBinding {
public:
    ShaderBinding(const BindingContext& context, const EffectVariant& variant, const Material& material);
    ShaderBinding(ShaderBinding&&) = default;
    ShaderBinding& operator=(ShaderBinding&&) = default;

    const SetLayout& setLayout() const { return setLayout_; }
    /// Block values again, after a property changed. The GPU must not be using the set.
    void writeBlocks(const Material& material);
    /// Textures and targets, after the targets were made anew. `depthReadOnly`: targets that the stage tests while it
    /// samples.
    void writeTextures(const BindingContext& context, const std::vector<Wire>& wires, const TargetPool& targets,
                       const std::vector<std::string>& depthReadOnly);
    void writeSceneTextures(const std::vector<std::pair<BindingSlot, TextureRef>>& textures, const SceneGpu& scene);
    void update() { set_.update(); }

    void bind(Commands& commands) const { commands.bindSet(1, set_); }

private:
    SetLayout setLayout_;
    DescriptorSet set_;
    std::vector<std::pair<std::uint32_t, std::uint64_t>> blockOffsets_;  ///< Binding → offset in the buffer.
    Buffer blocks_;
};

}  // namespace crevice
