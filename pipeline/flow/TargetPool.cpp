// Makes what the plan says each target is used as; clears once what nobody writes.
#include "flow/TargetPool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "gfx/Device.h"
#include "plan/TargetSize.h"

namespace crevice {

TargetPool::TargetPool(Device& device, const PipelineDesc& desc, const FramePlan& plan, std::set<std::string> stencils)
    : device_(device), desc_(desc), plan_(plan), stencils_(std::move(stencils)) {}

void TargetPool::resize(glm::uvec2 extent) {
    if (extent == extent_) return;
    textures_.clear();  // first: both sizes together might not fit
    extent_ = {0, 0};
    for (const TargetLife& life : plan_.lives) {
        const TargetDesc& target = *desc_.findTarget(life.target);
        textures_.emplace(target.name, makeTexture(target, life, extent));
    }
    extent_ = extent;
    clearUnwritten();
}

void TargetPool::checkFits(glm::uvec2 extent) const {
    const std::uint32_t side = device_.limits().maxImageDimension2D;
    std::uint64_t sum = 0;
    for (const TargetDesc& target : desc_.targets) {
        const glm::uvec3 size = targetExtent(target, extent.x, extent.y);
        if (size.x > side || size.y > side) {
            const bool guarded = desc_.guard > 0 && !target.size;
            Problem problem{Severity::Error, target.where,
                            fmt::format("target '{}' would be {}x{} pixels{}, and '{}' allows {}", target.name, size.x,
                                        size.y, guarded ? " with the guard" : "", device_.deviceName(), side),
                            guarded ? "lower the pipeline's 'guard' or the target's scale, or render smaller"
                                    : "render smaller, or lower the target's scale"};
            if (guarded) problem.remarks.push_back({desc_.guardWhere, guardRemark()});
            throw Error({std::move(problem)});
        }
        sum += targetBytes(target, extent.x, extent.y);
    }
    const std::uint64_t held = bytes();
    const std::uint64_t free =
        device_.heapBytes() -
        std::min(device_.heapBytes(), device_.allocatedBytes() - std::min(device_.allocatedBytes(), held));
    if (sum > free) {
        Problem problem;
        problem.message =
            fmt::format("the targets of pipeline '{}' at {}x{} need {} MiB; '{}' has {} MiB free of {} MiB", desc_.name,
                        extent.x, extent.y, sum >> 20, device_.deviceName(), free >> 20, device_.heapBytes() >> 20);
        problem.help = "render smaller with --size, or scale targets down in the pipeline";
        if (desc_.guard > 0) {
            problem.help = "lower the pipeline's 'guard', " + problem.help;
            problem.remarks.push_back({desc_.guardWhere, guardRemark()});
        }
        throw Error({std::move(problem)});
    }
}

std::string TargetPool::guardRemark() const {
    return fmt::format("the guard renders {} % of the frame's height more on each side", desc_.guard);
}

GpuTexture TargetPool::makeTexture(const TargetDesc& target, const TargetLife& life, glm::uvec2 extent) const {
    const glm::uvec3 size = targetExtent(target, extent.x, extent.y);
    TextureUsage usage = TextureUsage::Sampled | TextureUsage::TransferSource;  // any target can be dumped
    if (life.color) usage |= TextureUsage::Color;
    if (life.depth) usage |= TextureUsage::Depth;
    if (life.storage) usage |= TextureUsage::Storage;
    if (life.transferDest || life.neverWritten) usage |= TextureUsage::TransferDest;
    return GpuTexture(device_, {.format = target.format,
                                .width = size.x,
                                .height = size.y,
                                .mips = target.mips,
                                .layers = target.layers,
                                .stencil = hasStencil(target.name),
                                .usage = usage,
                                .name = target.name});
}

void TargetPool::clearUnwritten() {
    Commands commands(device_, "clear targets");
    commands.begin();
    for (const TargetLife& life : plan_.lives) {
        if (!life.neverWritten) continue;
        const GpuTexture& image = texture(life.target);
        const TargetDesc& target = desc(life.target);
        commands.barrier(image, TextureState::Undefined, TextureState::TransferDest);
        if (formatInfo(target.format).isDepth) {
            commands.clearDepth(image, target.clear.x);
        } else {
            commands.clearColor(image, target.clear);
        }
        commands.barrier(image, TextureState::TransferDest, TextureState::Sampled);
    }
    commands.submitAndWait();
}

const GpuTexture& TargetPool::texture(std::string_view target) const {
    const auto found = textures_.find(target);
    assert(found != textures_.end());
    return found->second;
}

const TargetDesc& TargetPool::desc(std::string_view target) const {
    const TargetDesc* found = desc_.findTarget(target);
    assert(found);
    return *found;
}

std::uint64_t TargetPool::bytes() const {
    std::uint64_t sum = 0;
    for (const auto& [name, texture] : textures_) sum += texture.memoryBytes();
    return sum;
}

}  // namespace crevice
