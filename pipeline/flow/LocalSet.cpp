// A ring of CCLocal slices, and the lights behind it.
#include "flow/LocalSet.h"

#include <fmt/format.h>

#include <cstring>

#include "gfx/Device.h"

namespace crevice {
namespace {

constexpr std::uint32_t kLocalBinding = 0;
constexpr std::uint32_t kForwardLightBinding = 1;
constexpr std::uint64_t kSlice = 256;  // the largest alignment Vulkan allows for dynamic offsets
constexpr std::uint64_t kSlices = 16384;
constexpr std::uint64_t kForwardLightBytes = sizeof(ForwardLightBlock);

}  // namespace

LocalSet::LocalSet(Device& device, DescriptorPool& pool)
    : setLayout_(device,
                 {{.binding = kLocalBinding, .type = DescriptorType::UniformBufferDynamic},
                  {.binding = kForwardLightBinding, .type = DescriptorType::UniformBuffer}},
                 "set 2"),
      ring_(device,
            {.size = kSlices * kSlice + kForwardLightBytes, .usage = BufferUsage::Uniform, .name = "local blocks"}),
      set_(pool.allocate(setLayout_, "local set")) {
    std::memset(ring_.data().data() + kSlices * kSlice, 0, kForwardLightBytes);
    set_.writeUniformBuffer(kLocalBinding, ring_, 0, sizeof(LocalBlock));
    set_.writeUniformBuffer(kForwardLightBinding, ring_, kSlices * kSlice, kForwardLightBytes);
    set_.update();
}

void LocalSet::writeLights(const ForwardLightBlock& lights) {
    ring_.write(std::as_bytes(std::span(&lights, 1)), kSlices * kSlice);
}

void LocalSet::bind(Commands& commands, const glm::mat4& world) {
    if (head_ + kSlice > kSlices * kSlice) {
        throw RenderError(fmt::format("a frame draws more than {} objects whose effect reads 'CCLocal'", kSlices),
                          "take the matrices from a_matWorld0 to a_matWorld2 instead: equal meshes are then one draw");
    }
    LocalBlock block;
    block.world = world;
    block.worldIT = glm::transpose(glm::inverse(world));
    ring_.write(std::as_bytes(std::span(&block, 1)), head_);
    const std::uint32_t offset = static_cast<std::uint32_t>(head_);
    commands.bindSet(2, set_, std::span(&offset, 1));
    head_ += kSlice;
}

}  // namespace crevice
